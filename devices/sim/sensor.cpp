#include "devices/sim/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kSigma = 1.425e-3;   // 1/m, the Kinect's
constexpr double kStep = 2 * kSigma;  // 1/m, inverse depth of one step of disparity
constexpr double kBaseline = 0.075;   // m, from the camera to the projector on its right
// Rounding to whole steps has a deviation of sqrt(1/12); this much before it makes half a step.
const float kBeforeRounding = static_cast<float>(std::sqrt(0.25 - 1.0 / 12));
// What must come back to be seen, of what a white surface that faces the camera sends back, and how
// much that wavers.
constexpr float kFaintest = 0.2F;
constexpr float kFaintestWavers = 0.03F;

// Random numbers are drawn once into a tile that repeats; a frame reads it from an offset of its
// own. Rows are longer than the period by an image's width, so that reading them never wraps.
constexpr int kPeriod = 512;

int row_of(std::uint64_t key, int y) {
  return static_cast<int>((key + static_cast<std::uint64_t>(y)) % kPeriod);
}
int column_of(std::uint64_t key) { return static_cast<int>((key >> 32) % kPeriod); }

cv::Mat with_longer_rows(const cv::Mat& tile, int width) {
  cv::Mat longer;
  cv::copyMakeBorder(tile, longer, 0, 0, 0, width, cv::BORDER_WRAP);
  return longer;
}

// Unit normal and, as in real depth images, alike in neighbouring pixels.
cv::Mat depth_noise_tile(int width, std::uint64_t seed) {
  Random random(seed);
  cv::Mat tile(kPeriod, kPeriod, CV_32F);
  for (int y = 0; y < kPeriod; ++y) {
    for (int x = 0; x < kPeriod; ++x) tile.at<float>(y, x) = static_cast<float>(random.normal());
  }
  cv::Mat wrapped;
  cv::copyMakeBorder(tile, wrapped, 1, 1, 1, 1, cv::BORDER_WRAP);
  const cv::Matx13f taps(0.5F, 1.0F, 0.5F);
  cv::Mat smooth;
  cv::sepFilter2D(wrapped, smooth, CV_32F, taps, taps);
  smooth = smooth(cv::Rect(1, 1, kPeriod, kPeriod));
  smooth = smooth / 1.5;  // the taps' norm, twice: 0.25 + 1 + 0.25
  return with_longer_rows(smooth, width);
}

}  // namespace

DepthSensor::DepthSensor(const SensorDescription& description, double focal, std::uint64_t seed)
    : description_(description), focal_(static_cast<float>(focal)), seed_(seed) {
  if (description_.noise > 0) noise_ = depth_noise_tile(description_.width, seed);
}

cv::Mat DepthSensor::measure(const cv::Mat& exact, const cv::Mat& returned,
                             std::int64_t frame) const {
  if (noise_.empty()) {
    cv::Mat cut = exact.clone();
    cut.setTo(kUnknown, (exact < description_.nearest) | (exact > description_.farthest));
    return cut;
  }
  const std::uint64_t key = mixed(seed_, static_cast<std::uint64_t>(frame));
  cv::Mat measured(exact.size(), CV_32F);
  for (int y = 0; y < exact.rows; ++y)
    measure_row(exact, returned, noise_.ptr<float>(row_of(key, y)) + column_of(key), y, measured);
  return measured;
}

void DepthSensor::measure_row(const cv::Mat& exact, const cv::Mat& returned, const float* noise,
                              int y, cv::Mat& measured) const {
  const int width = exact.cols;
  const float* z = exact.ptr<float>(y);
  const float* above = exact.ptr<float>(std::max(y - 1, 0));
  const float* below = exact.ptr<float>(std::min(y + 1, exact.rows - 1));
  const std::uint8_t* share = returned.ptr<std::uint8_t>(y);
  float* out = measured.ptr<float>(y);
  const float step = static_cast<float>(kStep * description_.noise);
  const float nearest = static_cast<float>(description_.nearest);
  const float farthest = static_cast<float>(description_.farthest);
  for (int x = 0; x < width; ++x) {
    // The steepest slope to a neighbour gives the angle at which light arrives, and edges at once:
    // cos^2 = 1 / (1 + (dz/dx)^2 + (dz/dy)^2).
    const float left = z[std::max(x - 1, 0)];
    const float right = z[std::min(x + 1, width - 1)];
    const float scale = focal_ / z[x];
    const float slope_x = scale * std::max(std::abs(z[x] - left), std::abs(right - z[x]));
    const float slope_y = scale * std::max(std::abs(z[x] - above[x]), std::abs(below[x] - z[x]));
    const float seen = static_cast<float>(share[x]) * (1.0F / 255);
    const float faintest = kFaintest + kFaintestWavers * noise[x];
    const bool bright =
        seen * seen > faintest * faintest * (1 + slope_x * slope_x + slope_y * slope_y);
    const float disparity = 1 / (step * z[x]) + kBeforeRounding * noise[x];
    const float depth = 1 / (step * static_cast<float>(static_cast<int>(disparity + 0.5F)));
    const bool good = bright & (z[x] >= nearest) & (depth <= farthest);
    out[x] = good ? depth : kUnknown;
  }
  // Where the projector's column of a pixel lies behind one of a nearer thing further right, its
  // light does not arrive.
  const float shift = focal_ * static_cast<float>(kBaseline);
  float leftmost = std::numeric_limits<float>::max();
  for (int x = width - 1; x >= 0; --x) {
    const float column = static_cast<float>(x) - shift / z[x];
    if (column >= leftmost) out[x] = kUnknown;
    leftmost = std::min(leftmost, column);
  }
}

ColorSensor::ColorSensor(const SensorDescription& description, std::uint64_t seed)
    : description_(description), seed_(seed) {
  if (description_.noise <= 0 || description_.color_noise <= 0) return;
  Random random(seed);
  cv::Mat tile(kPeriod, 3 * kPeriod, CV_16S);
  for (int y = 0; y < tile.rows; ++y) {
    for (int x = 0; x < tile.cols; ++x) {
      tile.at<std::int16_t>(y, x) = cv::saturate_cast<std::int16_t>(
          std::lround(256 * description_.color_noise * random.normal()));
    }
  }
  noise_ = with_longer_rows(tile, 3 * description_.width);
}

cv::Mat ColorSensor::measure(const cv::Mat& exact, double phase, std::int64_t frame) const {
  if (noise_.empty()) return exact.clone();
  const std::uint64_t key = mixed(seed_, static_cast<std::uint64_t>(frame));
  const double drift = description_.exposure_drift * std::sin(2 * std::numbers::pi * 2 * phase);
  const int gain = static_cast<int>(std::lround(256 * (1 + drift)));
  // A lens and its colour filters spread a point over more than its pixel.
  const cv::Matx13f spread(0.12F, 0.76F, 0.12F);
  cv::Mat through_lens;
  cv::sepFilter2D(exact, through_lens, CV_8U, spread, spread);
  cv::Mat measured(exact.size(), CV_8UC3);
  for (int y = 0; y < exact.rows; ++y) {
    const std::uint8_t* in = through_lens.ptr<std::uint8_t>(y);
    const std::int16_t* noise = noise_.ptr<std::int16_t>(row_of(key, y)) + 3 * column_of(key);
    std::uint8_t* out = measured.ptr<std::uint8_t>(y);
    for (int i = 0; i < 3 * exact.cols; ++i)
      out[i] = static_cast<std::uint8_t>(std::clamp((in[i] * gain + noise[i] + 128) >> 8, 0, 255));
  }
  return measured;
}

}  // namespace armsreach::sim
