// Little-endian numbers on streams.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <istream>
#include <ostream>
#include <type_traits>

namespace armsreach {

static_assert(std::endian::native == std::endian::little, "files are little-endian");

// What has no bytes but its numbers': a number, an array of whole ones.
template <class T>
concept Stored = std::floating_point<T> || std::has_unique_object_representations_v<T>;

template <Stored T>
void write_value(std::ostream& out, const T& value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  out.write(bytes.data(), bytes.size());
}

template <class Vector>
void write_values(std::ostream& out, const Vector& values) {
  for (const auto& value : values) write_value(out, value);
}

// Reads values until the stream fails, and zeros from then on: many are read before ok() is asked.
class ValueReader {
 public:
  explicit ValueReader(std::istream& in) : in_(in) {}
  bool ok() const { return in_.good(); }

  template <Stored T>
  T get() {
    std::array<char, sizeof(T)> bytes;
    return in_.read(bytes.data(), bytes.size()) ? std::bit_cast<T>(bytes) : T{};
  }
  // A vector of as many numbers as its type says.
  template <class Vector>
  Vector get_values() {
    Vector values;
    for (auto& value : values) value = get<std::remove_reference_t<decltype(value)>>();
    return values;
  }

 private:
  std::istream& in_;
};

}  // namespace armsreach
