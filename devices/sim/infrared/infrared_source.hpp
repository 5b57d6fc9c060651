// The infra-red camera of a simulated world as a source like any other: grey frames with the time
// and seed of the world's other sensors, hence of the same hand.
#pragma once

#include <memory>

#include "devices/sim/infrared/infrared_truth.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/world.hpp"
#include "devices/source.hpp"

namespace armsreach::sim {

class InfraredSource : public Source {
 public:
  // Of the last frame that next() gave.
  virtual const InfraredTruth& truth() const = 0;
};

// A world with an infra-red camera and a hand.
std::unique_ptr<InfraredSource> make_infrared_source(const World& world, const SimOptions& options);

}  // namespace armsreach::sim
