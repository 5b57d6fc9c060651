#include "vision/alignment/robust_scale.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace armsreach {
namespace {

// Thirty-two bins an octave from 2^-24 up: the exponent and five bits of the mantissa.
constexpr int kDroppedBits = 18;
constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(0x1p-24F) >> kDroppedBits;
constexpr std::uint32_t kNotANumber = 0x7f800000U;

double bin_start(int bin) {
  return static_cast<double>(
      std::bit_cast<float>((kFirst + static_cast<std::uint32_t>(bin)) << kDroppedBits));
}

}  // namespace

RobustScale::Estimate RobustScale::operator()(std::span<const float> residuals, int stride) {
  constexpr int kLast = static_cast<int>(std::tuple_size_v<decltype(histogram_)>) - 1;
  histogram_.fill(0);
  int count = 0;
  for (std::size_t i = 0; i < residuals.size(); i += static_cast<std::size_t>(stride)) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(residuals[i]) & 0x7fffffffU;
    if (bits > kNotANumber) continue;
    const int bin = static_cast<int>(bits >> kDroppedBits) - static_cast<int>(kFirst);
    ++histogram_[std::clamp(bin, 0, kLast)];
    ++count;
  }
  if (count == 0) return {};
  int below = 0;
  int bin = 0;
  while (2 * (below + histogram_[bin]) < count) below += histogram_[bin++];
  const double start = bin_start(bin);
  const double end = bin_start(bin + 1);
  const double median = start + (end - start) * (0.5 * count - below) / histogram_[bin];
  return {1.4826 * median, count};
}

}  // namespace armsreach
