// A gimbal as it moved when a recording was made. It cannot be moved otherwise, and says so once.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "devices/gimbal.hpp"

namespace armsreach {

// `states`: its gimbal.txt.
Result<std::unique_ptr<Gimbal>> open_recorded_gimbal(const std::string& name,
                                                     const GimbalModel& model,
                                                     const std::filesystem::path& states);

}  // namespace armsreach
