// A graphics context with a world in it; all of it lives on one thread of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "devices/sim/own_thread.hpp"
#include "devices/sim/world.hpp"
#include "devices/sim/world_renderer.hpp"
#include "render/context.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

class Studio {
 public:
  ~Studio();

  // Sets up at the first call. `world_from_thing`: of all things.
  Result<ExactImages> draw(const World& world, const Camera& camera, std::uint64_t seed,
                           const Pose& world_from_camera,
                           const std::vector<Pose>& world_from_thing);

 private:
  Status make(const World& world, const Camera& camera, std::uint64_t seed);

  OwnThread thread_;
  std::unique_ptr<render::Context> context_;
  std::unique_ptr<WorldRenderer> renderer_;
};

}  // namespace armsreach::sim
