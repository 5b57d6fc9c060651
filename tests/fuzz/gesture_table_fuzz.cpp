#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/gesture/gesture_table.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream in(text);
  static_cast<void>(armsreach::gesture::read_gesture_table(in, "fuzz"));
  return 0;
}
