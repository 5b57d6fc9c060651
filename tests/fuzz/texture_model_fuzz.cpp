#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/gesture/hand_texture.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream in(text);
  const auto model = armsreach::gesture::read_texture_model(in, "fuzz");
  if (!model) return 0;
  std::ostringstream out;
  armsreach::gesture::write_texture_model(out, *model);
  return 0;
}
