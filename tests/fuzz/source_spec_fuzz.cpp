#include <cstddef>
#include <cstdint>
#include <string>

#include "devices/source.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto spec = armsreach::parse_source_spec(text)) {
    // What was accepted keeps its meaning when written out.
    const auto again = armsreach::parse_source_spec(armsreach::text_of(*spec));
    if (!again || again->options != spec->options || again->place != spec->place) __builtin_trap();
    static_cast<void>(armsreach::number_option(*spec, "rate", 30, 0, 1000));
  }
  return 0;
}
