#include "vision/gesture/cast_shadow.hpp"

#include <array>
#include <cstdint>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

constexpr int kLevels = 64;
constexpr int kRowStep = 2;
constexpr int kLevelWidth = 256 / kLevels;
constexpr double kDarkness = 0.55;  // of the bright part's mean, the dark part's at most
constexpr double kParted = 0.65;    // of the variance that lies between the two parts, at least
constexpr double kMostShare = 0.5;  // of the skin

struct Parts {
  int threshold = 0;  // the first level of the bright part
  double dark_share = 0, dark_mean = 0, bright_mean = 0;
  double parted = 0;  // variance between, of all
};

// Otsu's threshold.
Parts part(const std::array<double, kLevels>& histogram) {
  double count = 0, sum = 0, squares = 0;
  for (int level = 0; level < kLevels; ++level) {
    const double n = histogram[static_cast<std::size_t>(level)];
    count += n;
    sum += n * level;
    squares += n * level * level;
  }
  Parts best;
  if (count == 0) return best;
  const double variance = squares / count - (sum / count) * (sum / count);
  double dark = 0, dark_sum = 0;
  for (int level = 0; level + 1 < kLevels; ++level) {
    dark += histogram[static_cast<std::size_t>(level)];
    dark_sum += histogram[static_cast<std::size_t>(level)] * level;
    if (dark == 0 || dark == count || variance <= 0) continue;
    const double share = dark / count;
    const double dark_mean = dark_sum / dark;
    const double bright_mean = (sum - dark_sum) / (count - dark);
    const double apart = bright_mean - dark_mean;
    const double parted = share * (1 - share) * apart * apart / variance;
    if (parted > best.parted) best = {level + 1, share, dark_mean, bright_mean, parted};
  }
  return best;
}

}  // namespace

cv::Mat without_shadow(const cv::Mat& bgr, const cv::Mat& skin) {
  CV_Assert(bgr.type() == CV_8UC3 && skin.type() == CV_8UC1 && bgr.size() == skin.size());
  cv::Mat red;  // the channel in which skin is brightest
  cv::extractChannel(bgr, red, 2);
  std::array<double, kLevels> histogram{};
  for (int y = 0; y < skin.rows; y += kRowStep) {
    const std::uint8_t* on = skin.ptr(y);
    const std::uint8_t* value = red.ptr(y);
    for (int x = 0; x < skin.cols; ++x)
      if (on[x] != 0) histogram[value[x] / kLevelWidth] += 1;
  }
  const Parts parts = part(histogram);
  const bool shadow = parts.parted >= kParted && parts.dark_share <= kMostShare &&
                      parts.dark_mean <= kDarkness * parts.bright_mean;
  if (!shadow) return skin;
  cv::Mat lit = skin.clone();
  lit.setTo(0, red < parts.threshold * kLevelWidth);
  cv::medianBlur(lit, lit, 5);
  return lit;
}

}  // namespace armsreach::gesture
