#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/firmata.hpp"

// The first byte says into what pieces the rest is cut: a line gives them as it likes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t piece = std::size_t{1} + data[0];
  std::span<const std::uint8_t> rest(data + 1, size - 1);
  armsreach::firmata::Reader reader;
  while (!rest.empty()) {
    const auto bytes = rest.first(std::min(piece, rest.size()));
    static_cast<void>(reader.take(bytes));
    rest = rest.subspan(bytes.size());
  }
  return 0;
}
