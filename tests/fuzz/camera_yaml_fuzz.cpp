#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/core/camera_yaml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream in(text);
  if (const auto file = armsreach::read_camera_yaml(in, "fuzz")) {
    // What was accepted can be written and is accepted again.
    std::stringstream copy;
    armsreach::write_camera_yaml(copy, *file);
    if (!armsreach::read_camera_yaml(copy, "copy")) __builtin_trap();
  }
  return 0;
}
