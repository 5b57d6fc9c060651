// Little-endian numbers on streams.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>

namespace armsreach::mapping {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

template <class T>
requires std::integral<T> || std::floating_point<T>
void write_value(std::ostream& out, T value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  out.write(bytes.data(), bytes.size());
}

template <class T>
requires std::integral<T> || std::floating_point<T> std::optional<T> read_value(std::istream& in) {
  std::array<char, sizeof(T)> bytes;
  if (!in.read(bytes.data(), bytes.size())) return std::nullopt;
  return std::bit_cast<T>(bytes);
}

}  // namespace armsreach::mapping
