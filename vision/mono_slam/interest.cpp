#include "vision/mono_slam/interest.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

constexpr int kReach = 4;  // px around a corner over which gradients are gathered

// Sums of the products of gradients over lines and then columns of (2 kReach + 1) pixels; gradients
// are differences of the pixels to either side, twice those a pixel.
class CornerStrength {
 public:
  CornerStrength(const cv::Mat& grey, const cv::Rect& box) : box_(box) {
    const int wide = box.width + 2 * kReach;
    std::vector<Products> columns(static_cast<std::size_t>(wide));
    for (int y = -kReach; y < kReach; ++y) add_line(grey, y, 1, &columns);
    for (int y = 0; y < box.height; ++y) {
      add_line(grey, y + kReach, 1, &columns);
      Products sum;
      for (int x = 0; x < 2 * kReach; ++x) sum.add(columns[static_cast<std::size_t>(x)], 1);
      for (int x = 0; x < box.width; ++x) {
        sum.add(columns[static_cast<std::size_t>(x + 2 * kReach)], 1);
        strength_.push_back(sum.smaller_eigenvalue());
        sum.add(columns[static_cast<std::size_t>(x)], -1);
      }
      add_line(grey, y - kReach, -1, &columns);
    }
  }

  // The smaller eigenvalue of the mean gradient's square at a pixel of the box.
  double at(int x, int y) const { return strength_[static_cast<std::size_t>(y * box_.width + x)]; }

 private:
  struct Products {
    int xx = 0, xy = 0, yy = 0;
    void add(const Products& other, int sign) {
      xx += sign * other.xx;
      xy += sign * other.xy;
      yy += sign * other.yy;
    }
    double smaller_eigenvalue() const {
      constexpr double kMean = 1.0 / (4 * (2 * kReach + 1) * (2 * kReach + 1));
      const double half_difference = 0.5 * (xx - yy);
      const double root =
          std::sqrt(half_difference * half_difference + static_cast<double>(xy) * xy);
      return kMean * (0.5 * (static_cast<double>(xx) + yy) - root);
    }
  };

  void add_line(const cv::Mat& grey, int y, int sign, std::vector<Products>* columns) const {
    const auto* const line = grey.ptr<unsigned char>(box_.y + y) + box_.x - kReach;
    const auto* const above = grey.ptr<unsigned char>(box_.y + y - 1) + box_.x - kReach;
    const auto* const below = grey.ptr<unsigned char>(box_.y + y + 1) + box_.x - kReach;
    for (int x = 0; x < static_cast<int>(columns->size()); ++x) {
      const int dx = line[x + 1] - line[x - 1];
      const int dy = below[x] - above[x];
      (*columns)[static_cast<std::size_t>(x)].add({dx * dx, dx * dy, dy * dy}, sign);
    }
  }

  cv::Rect box_;
  std::vector<double> strength_;
};

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
  CV_Assert(grey.type() == CV_8UC1 && options.border > kReach);
  if (grey.cols <= 2 * options.border || grey.rows <= 2 * options.border) return std::nullopt;
  const cv::Rect box = emptiest_box(grey, taken, options, random);
  const CornerStrength strength(grey, box);
  std::optional<Vector2d> best;
  double strongest = options.least_strength;
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      const double value = strength.at(x, y);
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
