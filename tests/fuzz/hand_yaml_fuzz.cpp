#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "devices/sim/hand_yaml.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream in(text);
  static_cast<void>(armsreach::sim::read_hand_script(in, "fuzz"));
  return 0;
}
