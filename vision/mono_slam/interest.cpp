#include "vision/mono_slam/interest.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

constexpr int kBlock = 9;  // px over which gradients are gathered

// Uniform below n, the same with every standard library.
int draw(std::mt19937_64* random, int n) {
  return n > 0 ? static_cast<int>((*random)() % static_cast<std::uint64_t>(n)) : 0;
}

cv::Rect emptiest_box(const cv::Mat& grey, const std::vector<Vector2d>& taken,
                      const InterestOptions& options, std::mt19937_64* random) {
  constexpr int kTries = 12;
  const cv::Size size(std::min(options.box_width, grey.cols - 2 * options.border),
                      std::min(options.box_height, grey.rows - 2 * options.border));
  cv::Rect best;
  std::size_t fewest = taken.size() + 1;
  for (int i = 0; i < kTries; ++i) {
    const int x = options.border + draw(random, grey.cols - 2 * options.border - size.width + 1);
    const int y = options.border + draw(random, grey.rows - 2 * options.border - size.height + 1);
    const cv::Rect box(cv::Point(x, y), size);
    const auto inside = std::count_if(taken.begin(), taken.end(), [&](const Vector2d& p) {
      return box.contains(cv::Point(static_cast<int>(p.x()), static_cast<int>(p.y())));
    });
    if (static_cast<std::size_t>(inside) >= fewest) continue;
    fewest = static_cast<std::size_t>(inside);
    best = box;
  }
  return best;
}

}  // namespace

std::optional<Vector2d> interesting_pixel(const cv::Mat& grey, const cv::Mat& allowed,
                                          const std::vector<Vector2d>& taken,
                                          const InterestOptions& options, std::mt19937_64* random) {
  if (grey.cols <= 2 * options.border || grey.rows <= 2 * options.border) return std::nullopt;
  const cv::Rect box = emptiest_box(grey, taken, options, random);
  cv::Mat strength;
  cv::cornerMinEigenVal(grey(box), strength, kBlock, 3);
  // OpenCV adds up, over the block, the squares of 2 / (255 block) of the gradient.
  const double unit = 255.0 * 255.0 / 4;
  std::optional<Vector2d> best;
  double strongest = options.least_strength;
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      const double value = unit * static_cast<double>(strength.at<float>(y, x));
      if (value <= strongest) continue;
      const Vector2d pixel(box.x + x, box.y + y);
      if (!allowed.empty() && !allowed.at<unsigned char>(box.y + y, box.x + x)) continue;
      const bool crowded = std::any_of(taken.begin(), taken.end(), [&](const Vector2d& p) {
        return (p - pixel).norm() < options.spacing;
      });
      if (crowded) continue;
      strongest = value;
      best = pixel;
    }
  }
  return best;
}

}  // namespace armsreach::mono_slam
