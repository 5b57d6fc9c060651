#include "devices/sim/infrared/infrared_sensor.hpp"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

// Of a 1/3 inch sensor with pixels of 6 um.
constexpr float kElectronsPerLevel = 45;
constexpr float kReadNoise = 0.7F;  // grey levels
constexpr float kBlackLevel = 2;
constexpr double kColumnNoise = 0.25;  // grey levels

// Behind a lens for visible light, out of focus at 880 nm, which silicon lets wander besides.
constexpr double kSpread = 0.65;  // px
// Light scattered in the lens: shares, and how far.
constexpr float kGlow = 0.02F;
constexpr float kVeil = 0.006F;

// The lens's cos^4 and lamps that shine forwards with cos^2.
cv::Mat vignetting_of(const Camera& camera) {
  constexpr int kCoarse = 8;  // px; it changes slowly
  const int columns = camera.width / kCoarse + 2;
  const int rows = camera.height / kCoarse + 2;
  cv::Mat coarse(rows, columns, CV_32F);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector3d ray = unproject(camera, kCoarse * Eigen::Vector2d(x, y));
      coarse.at<float>(y, x) = static_cast<float>(std::pow(ray.squaredNorm(), -3));
    }
  }
  cv::Mat fine;
  const double scale = 1.0 / kCoarse;
  cv::warpAffine(coarse, fine, cv::Matx23d(scale, 0, 0, 0, scale, 0), {camera.width, camera.height},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return fine;
}

// Blurred widely, at a fraction of the resolution.
cv::Mat spread_wide(const cv::Mat& light, int fraction, double sigma) {
  cv::Mat small;
  cv::resize(light, small, {light.cols / fraction, light.rows / fraction}, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {}, sigma);
  cv::Mat wide;
  cv::resize(small, wide, light.size(), 0, 0, cv::INTER_LINEAR);
  return wide;
}

cv::Mat through_lens(const cv::Mat& light) {
  cv::Mat sharp;
  cv::GaussianBlur(light, sharp, {}, kSpread);
  return (1 - kGlow - kVeil) * sharp + kGlow * spread_wide(light, 2, 2.5) +
         kVeil * spread_wide(light, 8, 4);
}

}  // namespace

InfraredSensor::InfraredSensor(const Camera& camera, double noise, std::uint64_t seed)
    : noise_scale_(noise),
      noise_(camera.width, seed),
      vignetting_(vignetting_of(camera)),
      column_(static_cast<std::size_t>(camera.width)) {
  Random random(mixed(seed, 1));
  for (float& offset : column_) offset = static_cast<float>(noise * kColumnNoise * random.normal());
}

cv::Mat InfraredSensor::measure(const cv::Mat& light, std::int64_t frame) const {
  const cv::Mat arrived = through_lens(light.mul(vignetting_));
  cv::Mat measured(light.size(), CV_8U);
  const float scale = static_cast<float>(noise_scale_);
  for (int y = 0; y < light.rows; ++y) {
    const float* level = arrived.ptr<float>(y);
    const float* noise = noise_.row(frame, y);
    std::uint8_t* out = measured.ptr<std::uint8_t>(y);
    for (int x = 0; x < light.cols; ++x) {
      // A full well takes no more: what is far above white is white without noise.
      const float held = level[x] > 300 ? 300.0F : level[x];
      const float deviation = std::sqrt(held / kElectronsPerLevel + kReadNoise * kReadNoise);
      const float value =
          kBlackLevel + held + column_[static_cast<std::size_t>(x)] + scale * noise[x] * deviation;
      const float bounded = value < 0 ? 0.0F : value > 255 ? 255.0F : value;
      out[x] = static_cast<std::uint8_t>(bounded + 0.5F);
    }
  }
  return measured;
}

}  // namespace armsreach::sim
