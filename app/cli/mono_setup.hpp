// What a run needs to track a plain camera: options, and the start target from its files.
#pragma once

#include <cstdint>
#include <string>

#include "app/pipelines/mono_stage.hpp"
#include "app/session/config.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

// The target.yaml that lies in a recording's folder; "" where there is none.
std::string target_of_source(const std::string& source);

// `target_file` may be empty.
Result<MonoSetup> make_mono_setup(const MonoSlamConfig& config, const std::string& target_file,
                                  std::uint64_t seed);

}  // namespace armsreach::app
