#include "devices/sim/depth_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>

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

}  // namespace

DepthSensor::DepthSensor(const SensorDescription& description, double focal, std::uint64_t seed)
    : description_(description), focal_(static_cast<float>(focal)) {
  // As in real depth images, errors are alike in neighbouring pixels.
  if (description_.noise > 0) noise_ = NoiseTile(description_.width, seed, NoiseTile::Kind::smooth);
}

cv::Mat DepthSensor::measure(const cv::Mat& exact, const cv::Mat& returned,
                             std::int64_t frame) const {
  if (noise_.empty()) {
    cv::Mat cut = exact.clone();
    cut.setTo(kUnknown, (exact < description_.nearest) | (exact > description_.farthest));
    return cut;
  }
  cv::Mat measured(exact.size(), CV_32F);
  for (int y = 0; y < exact.rows; ++y)
    measure_row(exact, returned, noise_.row(frame, y), y, measured);
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

}  // namespace armsreach::sim
