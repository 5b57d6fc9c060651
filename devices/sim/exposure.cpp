#include "devices/sim/exposure.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::sim {

double picture_motion(const cv::Mat& depth, const Camera& camera, const Pose& second_from_first) {
  constexpr int kGrid = 16;  // px
  double largest = 0;
  for (int y = kGrid / 2; y < depth.rows; y += kGrid) {
    for (int x = kGrid / 2; x < depth.cols; x += kGrid) {
      const double z = static_cast<double>(depth.at<float>(y, x));
      if (std::isnan(z)) continue;
      const Eigen::Vector2d pixel(x, y);
      const auto moved = project(camera, second_from_first * (z * unproject(camera, pixel)));
      if (moved) largest = std::max(largest, (*moved - pixel).norm());
    }
  }
  return largest;
}

double picture_motion(const Camera& camera, const Eigen::Vector3d& first,
                      const Eigen::Vector3d& second) {
  const auto before = project(camera, first);
  const auto after = project(camera, second);
  return before && after ? (*after - *before).norm() : 0;
}

std::vector<double> exposure_moments(double duration, double motion) {
  constexpr double kStep = 1.5;  // px from one moment to the next: the lens smooths as much
  constexpr double kMost = 16;
  const double pairs = std::ceil((std::clamp(motion, kStep, kMost) / kStep - 1) / 2);
  const int count = 1 + 2 * static_cast<int>(pairs);
  std::vector<double> moments;
  for (int i = 0; i < count; ++i) moments.push_back(duration * ((i + 0.5) / count - 0.5));
  return moments;
}

void LightSum::add(const cv::Mat& picture) {
  if (count_++ == 0) sum_ = cv::Mat::zeros(picture.size(), CV_32SC3);
  for (int y = 0; y < picture.rows; ++y) {
    const std::uint8_t* in = picture.ptr<std::uint8_t>(y);
    int* sum = sum_.ptr<int>(y);
    for (int i = 0; i < 3 * picture.cols; ++i) sum[i] += in[i] * in[i];
  }
}

cv::Mat LightSum::mean() const {
  cv::Mat mean(sum_.size(), CV_8UC3);
  const float scale = 1.0F / static_cast<float>(count_);
  for (int y = 0; y < mean.rows; ++y) {
    const int* sum = sum_.ptr<int>(y);
    std::uint8_t* out = mean.ptr<std::uint8_t>(y);
    for (int i = 0; i < 3 * mean.cols; ++i)
      out[i] = static_cast<std::uint8_t>(std::sqrt(scale * static_cast<float>(sum[i])) + 0.5F);
  }
  return mean;
}

Result<ExactImages> exposed(ExactImages middle, double duration, double motion,
                            const std::function<Result<ExactImages>(double moment)>& draw) {
  const std::vector<double> moments = exposure_moments(duration, motion);
  if (moments.size() == 1) return middle;
  LightSum light;
  for (const double moment : moments) {
    if (moment == 0) {
      light.add(middle.color);
      continue;
    }
    auto drawn = draw(moment);
    if (!drawn) return drawn;
    light.add(drawn->color);
  }
  middle.color = light.mean();
  return middle;
}

}  // namespace armsreach::sim
