#include "vision/gesture/hand_separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

constexpr int kWidth = 160;       // px, at which colours are parted
constexpr int kClasses = 3;       // wall, hand, and the shadow or the arm
constexpr int kRounds = 12;       // of Lloyd's iteration; it has settled after about eight
constexpr float kLuma = 0.4F;     // brightness counts less than colour: light falls off on a wall
constexpr double kContact = 1.3;  // of a wall, in roots of its area; see HandFinderOptions
constexpr std::size_t kFewest = 60;  // samples

using Color = cv::Vec3f;

// Brightness and the two differences of colour of BT.601.
Color color_of(const cv::Vec3b& pixel) {
  const float b = pixel[0], g = pixel[1], r = pixel[2];
  const float y = 0.114F * b + 0.587F * g + 0.299F * r;
  return {kLuma * y, 0.564F * (b - y), 0.713F * (r - y)};
}

using Centers = std::array<Color, kClasses>;

std::size_t nearest(const Centers& centers, const Color& color) {
  std::size_t best = 0;
  float least = 1e30F;
  for (std::size_t k = 0; k < centers.size(); ++k) {
    const Color difference = color - centers[k];
    const float away = difference.dot(difference);
    if (away < least) least = away, best = k;
  }
  return best;
}

// Begins with the mean, then with a color far from all centres so far: not the farthest, which is
// a highlight.
Centers first_centers(const std::vector<Color>& colors) {
  Color sum(0, 0, 0);
  for (const Color& color : colors) sum += color;
  Centers centers;
  centers.fill(sum * (1.0F / static_cast<float>(colors.size())));
  std::vector<std::pair<float, std::size_t>> away(colors.size());
  for (std::size_t k = 1; k < centers.size(); ++k) {
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const Color difference = colors[i] - centers[nearest(centers, colors[i])];
      away[i] = {difference.dot(difference), i};
    }
    const auto far = away.begin() + static_cast<std::ptrdiff_t>(away.size() * 19 / 20);
    std::nth_element(away.begin(), far, away.end());
    centers[k] = colors[far->second];
  }
  return centers;
}

Centers part(const std::vector<Color>& colors) {
  Centers centers = first_centers(colors);
  for (int round = 0; round < kRounds; ++round) {
    std::array<Color, kClasses> sums{};
    std::array<float, kClasses> counts{};
    for (const Color& color : colors) {
      const std::size_t k = nearest(centers, color);
      sums[k] += color;
      counts[k] += 1;
    }
    for (std::size_t k = 0; k < centers.size(); ++k)
      if (counts[k] > 0) centers[k] = sums[k] * (1 / counts[k]);
  }
  return centers;
}

std::vector<Color> sampled(const cv::Mat& bgr, const cv::Mat& mask) {
  std::vector<Color> colors;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<std::uint8_t>(y, x) != 0) colors.push_back(color_of(bgr.at<cv::Vec3b>(y, x)));
  return colors;
}

}  // namespace

cv::Mat without_walls(const cv::Mat& bgr, const cv::Mat& skin) {
  CV_Assert(bgr.type() == CV_8UC3 && skin.type() == CV_8UC1 && bgr.size() == skin.size());
  const double scale = std::max(1.0, static_cast<double>(bgr.cols) / kWidth);
  const cv::Size size(std::max(1, static_cast<int>(bgr.cols / scale)),
                      std::max(1, static_cast<int>(bgr.rows / scale)));
  cv::Mat small, mask;
  cv::resize(bgr, small, size, 0, 0, cv::INTER_AREA);
  cv::resize(skin, mask, size, 0, 0, cv::INTER_NEAREST);
  const std::vector<Color> colors = sampled(small, mask);
  if (colors.size() < kFewest) return skin.clone();
  const Centers centers = part(colors);

  std::array<double, kClasses> areas{}, contacts{};
  cv::Mat classes(size, CV_8UC1, cv::Scalar(kClasses));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const std::size_t k = nearest(centers, color_of(small.at<cv::Vec3b>(y, x)));
      classes.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(k);
      areas[k] += 1;
      const bool border = x == 0 || y == 0 || x == size.width - 1 || y == size.height - 1;
      contacts[k] += border ? 1 : 0;
    }
  }
  cv::Mat kept(size, CV_8UC1, cv::Scalar(0));
  for (std::size_t k = 0; k < kClasses; ++k)
    if (contacts[k] < kContact * std::sqrt(areas[k]))
      kept.setTo(255, classes == static_cast<int>(k));
  cv::blur(kept, kept, {3, 3});
  kept = kept > 127;
  // Shadows leave thin lines.
  cv::morphologyEx(kept, kept, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  cv::resize(kept, kept, bgr.size(), 0, 0, cv::INTER_LINEAR);
  return (kept > 127) & (skin != 0);
}

}  // namespace armsreach::gesture
