#include "vision/mono_slam/image_turn.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <opencv2/imgproc.hpp>

#include "vision/core/pose.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix4d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr int kWidths[] = {80, 160};  // px: a fast turn smears over some px of the second
constexpr double kLeastShared = 0.4;  // of the picture
constexpr double kWorst = 0.02;       // rad, one deviation of a turn that is worth knowing
// Neighbours err together, by noise that was smoothed and by parallax: of so many pixels, one tells
// something new.
constexpr double kAlike = 16;

float at(const cv::Mat& image, float x, float y) {
  const int left = static_cast<int>(x);
  const int top = static_cast<int>(y);
  const float right = x - static_cast<float>(left);
  const float low = y - static_cast<float>(top);
  const float* upper = image.ptr<float>(top) + left;
  const float* lower = image.ptr<float>(top + 1) + left;
  return (1 - low) * ((1 - right) * upper[0] + right * upper[1]) +
         low * ((1 - right) * lower[0] + right * lower[1]);
}

bool inside(const cv::Mat& image, float x, float y) {
  return x >= 0 && y >= 0 && x < static_cast<float>(image.cols - 1) &&
         y < static_cast<float>(image.rows - 1);
}

// Robust: 1.4826 times the median of the absolute values.
double spread(std::vector<float> residuals) {
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end(),
                   [](float a, float b) { return std::abs(a) < std::abs(b); });
  return std::max(1.4826 * static_cast<double>(std::abs(*middle)), 0.3);
}

double tukey(double residual, double sigma) {
  const double share = residual / (4.685 * sigma);
  return std::abs(share) < 1 ? (1 - share * share) * (1 - share * share) : 0;
}

}  // namespace

// Of the picture after: what it shows, where, and how that changes with a turn and with the light.
struct ImageTurnMeter::Pixel {
  Eigen::Vector3f ray;
  float value;
  Eigen::Vector4f by_turn;
};

ImageTurnMeter::ImageTurnMeter(const Camera& camera) {
  for (const int width : kWidths) {
    if (width > camera.width) break;
    Level level;
    level.camera = resized(camera, width, cvRound(1.0 * width * camera.height / camera.width));
    for (int y = 0; y < level.camera.height; ++y) {
      for (int x = 0; x < level.camera.width; ++x) {
        const Vector3d ray = unproject(level.camera, {x, y});
        Eigen::Matrix<double, 2, 3> by_point = Eigen::Matrix<double, 2, 3>::Zero();
        project(level.camera, ray, &by_point);
        level.rays.push_back(ray.cast<float>());
        level.pixel_by_turn.push_back((-by_point * skew(ray)).cast<float>());
      }
    }
    levels_.push_back(std::move(level));
  }
}

void ImageTurnMeter::take(const cv::Mat& grey) {
  for (Level& level : levels_) {
    cv::Mat small;
    cv::resize(grey, small, {level.camera.width, level.camera.height}, 0, 0, cv::INTER_AREA);
    std::swap(level.before, level.after);
    small.convertTo(level.after, CV_32F);
  }
}

std::optional<ImageTurn> ImageTurnMeter::measure(const Quaterniond& expected) const {
  if (levels_.empty() || levels_[0].before.empty()) return std::nullopt;
  std::optional<ImageTurn> turn = ImageTurn{expected};
  for (const Level& level : levels_) {
    turn = refine(level, turn->before_from_after);
    if (!turn) return std::nullopt;
  }
  return turn;
}

std::vector<ImageTurnMeter::Pixel> ImageTurnMeter::pixels_of(const Level& level) {
  std::vector<Pixel> pixels;
  for (int y = 1; y + 1 < level.camera.height; ++y) {
    const float* row = level.after.ptr<float>(y);
    for (int x = 1; x + 1 < level.camera.width; ++x) {
      const auto i = static_cast<std::size_t>(y * level.camera.width + x);
      const Eigen::RowVector2f slope(
          (row[x + 1] - row[x - 1]) / 2,
          (level.after.at<float>(y + 1, x) - level.after.at<float>(y - 1, x)) / 2);
      Pixel pixel{level.rays[i], row[x], {}};
      pixel.by_turn << (slope * level.pixel_by_turn[i]).transpose(), 1;
      pixels.push_back(pixel);
    }
  }
  return pixels;
}

ImageTurnMeter::Overlap ImageTurnMeter::overlap(const Level& level,
                                                const std::vector<Pixel>& pixels,
                                                const Quaterniond& turn, double light) {
  const Eigen::Matrix3f before_from_after = turn.toRotationMatrix().cast<float>();
  Overlap shared;
  for (const Pixel& pixel : pixels) {
    const auto seen = project(level.camera, (before_from_after * pixel.ray).cast<double>());
    if (!seen) continue;
    const Eigen::Vector2f there = seen->cast<float>();
    if (!inside(level.before, there.x(), there.y())) continue;
    shared.residuals.push_back(at(level.before, there.x(), there.y()) - pixel.value -
                               static_cast<float>(light));
    shared.pixels.push_back(&pixel);
  }
  return shared;
}

// The turn and the change of the light that explain the residuals best.
ImageTurnMeter::Step ImageTurnMeter::step(const Overlap& shared) {
  const double sigma = spread(shared.residuals);
  // A weak prior, so that what the pictures say nothing about is uncertain.
  Matrix4d normal = sigma * sigma * Matrix4d::Identity();
  Vector4d right = Vector4d::Zero();
  for (std::size_t i = 0; i < shared.pixels.size(); ++i) {
    const double residual = static_cast<double>(shared.residuals[i]);
    const double weight = tukey(residual, sigma);
    const Vector4d by_turn = shared.pixels[i]->by_turn.cast<double>();
    normal.noalias() += weight * by_turn * by_turn.transpose();
    right += weight * residual * by_turn;
  }
  const Eigen::LDLT<Matrix4d> solver(normal);
  const Matrix4d inverse = solver.solve(Matrix4d::Identity());
  return {solver.solve(right), kAlike * sigma * sigma * inverse.topLeftCorner<3, 3>()};
}

std::optional<ImageTurn> ImageTurnMeter::refine(const Level& level, const Quaterniond& start) {
  constexpr int kIterations = 12;
  constexpr double kStill = 1e-5;  // rad
  const std::vector<Pixel> pixels = pixels_of(level);
  const auto least = static_cast<std::size_t>(kLeastShared * static_cast<double>(pixels.size()));
  ImageTurn out{start};
  double light = 0;
  for (int i = 0; i < kIterations; ++i) {
    const Overlap shared = overlap(level, pixels, out.before_from_after, light);
    if (shared.pixels.size() < least) return std::nullopt;
    const Step change = step(shared);
    if (!change.value.allFinite()) return std::nullopt;
    out.covariance = change.covariance;
    out.before_from_after = out.before_from_after * so3_exp(-change.value.head<3>());
    light += change.value[3];
    if (change.value.head<3>().norm() < kStill) break;
  }
  if (!(out.covariance.trace() < kWorst * kWorst)) return std::nullopt;
  return out;
}

}  // namespace armsreach::mono_slam
