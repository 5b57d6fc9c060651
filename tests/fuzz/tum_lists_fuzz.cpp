#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "devices/tum_lists.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::istringstream color_text(text);
  std::istringstream depth_text(text.substr(size / 2));
  std::istringstream pairs_text(text);
  static_cast<void>(armsreach::read_tum_associations(pairs_text, "fuzz"));
  const auto color = armsreach::read_tum_list(color_text, "fuzz");
  const auto depth = armsreach::read_tum_list(depth_text, "fuzz");
  if (color && depth) static_cast<void>(armsreach::associate(*color, *depth));
  return 0;
}
