// The rig that a command line asks for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "devices/rig.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

struct RigOptions {
  std::vector<std::string> sources;  // SPEC, or NAME=SPEC
  std::string rig;                   // a rig file instead
  std::string camera;                // camera YAML in place of the source's own, or empty
  std::uint64_t seed = 1;            // of simulated sources that are given none
};

Result<std::unique_ptr<Rig>> open_rig(const RigOptions& options);

// Index of the sensor called main, or else of the first one that measures depth, or else 0.
std::size_t main_sensor(const Rig& rig);

// For counts on the command line: what is wrong with the text, or nothing.
std::string at_least_one(const std::string& text);

}  // namespace armsreach::app
