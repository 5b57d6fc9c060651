// What `armsreach run` (and so `demo`) was asked to do, and doing it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/session/config.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

struct RunOptions {
  std::vector<std::string> sources;  // SPEC, or NAME=SPEC
  std::string rig;
  std::vector<std::string> experience;  // workspace, wearable; empty: what the sensor allows
  std::string camera;
  std::string display = "auto";
  std::string pace = "live";
  std::optional<std::int64_t> frames;
  std::string record;
  std::string screenshots;
  std::string trajectory;
  std::string events;
  std::string stats;
  std::string map;
  std::string session;
  std::string config;
  std::uint64_t seed = 1;
};

Status run(const RunOptions& options);
// The same with a configuration that is already there.
Status run(const RunOptions& options, const Config& config);

}  // namespace armsreach::app
