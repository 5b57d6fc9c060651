// A simulated camera in a simulated world, as a source like any other: "sim:bench,seed=3".
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/open.hpp"
#include "devices/sim/world.hpp"
#include "devices/source.hpp"
#include "vision/core/camera.hpp"

namespace armsreach {

// To be joined with real_source_kinds().
std::vector<SourceKind> sim_source_kinds();

namespace sim {

struct SimOptions {
  std::string sensor_name = "main";
  std::uint64_t seed = 1;
  double speed = 1;                    // how much faster than described the path is walked
  std::optional<std::int64_t> frames;  // once along the path when nothing is said
  bool endless = false;                // round and round a closed path
};

// Colour and depth come registered from one camera; every frame carries its truth
// (devices/truth.hpp). Frame i is at time i / rate; the same world, options and commands to its
// gimbal give the same bits on the same machine.
std::unique_ptr<Source> make_sim_source(const World& world, const SimOptions& options);

// The pinhole camera that a description stands for.
Camera camera_of(const SensorDescription& sensor);

}  // namespace sim
}  // namespace armsreach
