#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/mono_slam/sparse_map.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  std::istringstream in(bytes);
  static_cast<void>(armsreach::mono_slam::read_sparse_map(in, "fuzz"));
  return 0;
}
