#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/mono_slam/target_yaml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream in(text);
  static_cast<void>(armsreach::mono_slam::read_target_yaml(in, "fuzz"));
  return 0;
}
