#include "devices/sim/color_sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr double kReadNoise = 6;          // electrons
constexpr double kWantedLevel = 118;      // mean of a well exposed picture
const double kLargestGain = std::log(4);  // two stops either way

// Electrons that make a pixel white. In values, the square root of light, shot noise is
// 127.5 / sqrt(electrons) everywhere.
double full_well(double noise) { return 127.5 * 127.5 / (noise * noise); }

// A wave between -1 and 1 of no obvious period.
double slow_wave(std::uint64_t seed, double time) {
  Random random(seed);
  double sum = 0;
  for (const double seconds : {7.0, 11.0, 23.0}) {
    const double phase = random.uniform(0, 2 * std::numbers::pi);
    sum += std::sin(2 * std::numbers::pi * time / seconds + phase) / 3;
  }
  return sum;
}

// value = 255 sqrt(light) with light's variance shot * light + read.
void expose_row(const std::uint8_t* exact, const float* noise, const std::array<float, 3>& gain,
                float shot, float read, int count, std::uint8_t* measured) {
  for (int i = 0; i < count; i += 3) {
    for (int c = 0; c < 3; ++c) {
      const float value = static_cast<float>(exact[i + c]) * (1.0F / 255);
      const float light = gain[static_cast<std::size_t>(c)] * value * value;
      const float noisy = light + noise[i + c] * std::sqrt(shot * light + read);
      const float bounded = noisy < 0 ? 0.0F : noisy > 1 ? 1.0F : noisy;
      measured[i + c] = static_cast<std::uint8_t>(255 * std::sqrt(bounded) + 0.5F);
    }
  }
}

cv::Mat through_lens(const cv::Mat& exact, double sharpness) {
  if (sharpness >= 1) return exact;
  const float side = static_cast<float>(0.5 * (1 - sharpness));
  const cv::Matx13f spread(side, static_cast<float>(sharpness), side);
  cv::Mat soft;
  cv::sepFilter2D(exact, soft, CV_8U, spread, spread);
  return soft;
}

cv::Mat through_jpeg(const cv::Mat& image, int quality) {
  std::vector<std::uint8_t> file;
  cv::imencode(".jpg", image, file, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(file, cv::IMREAD_COLOR);
}

}  // namespace

ColorSensor::ColorSensor(const SensorDescription& description, std::uint64_t seed)
    : description_(description.color), interval_(1 / description.rate), seed_(seed) {
  if (description_.noise > 0) noise_ = NoiseTile(3 * description.width, seed);
}

double ColorSensor::noise_at(double level) const {
  if (noise_.empty()) return 0;
  const double well = full_well(description_.noise);
  const double light = level * level / (255 * 255);
  const double read = kReadNoise / well;
  return 127.5 * std::sqrt((light / well + read * read) / light);
}

void ColorSensor::follow(double wanted) {
  const double bounded = std::clamp(wanted, -kLargestGain, kLargestGain);
  const double before = log_gain_.value_or(bounded);
  log_gain_ = before + (1 - std::exp(-interval_ / description_.exposure_lag)) * (bounded - before);
}

cv::Vec3f ColorSensor::gains(const cv::Mat& exact, double time) {
  double gain = 1 + description_.exposure_drift * slow_wave(mixed(seed_, 1), time);
  if (description_.exposure_lag > 0) {
    const cv::Scalar mean = cv::mean(exact);
    const double level = std::max(1.0, (mean[0] + mean[1] + mean[2]) / 3);
    const double wanted = 2 * std::log(kWantedLevel / level);
    if (!log_gain_) follow(wanted);  // it had settled before the first frame
    gain *= std::exp(*log_gain_);
    follow(wanted);
  }
  const double warmth = description_.white_balance_drift * slow_wave(mixed(seed_, 2), time);
  return {static_cast<float>(gain * (1 - warmth)), static_cast<float>(gain),
          static_cast<float>(gain * (1 + warmth))};
}

cv::Mat ColorSensor::measure(const cv::Mat& exact, double time, std::int64_t frame) {
  const cv::Vec3f gain = gains(exact, time);
  const cv::Mat soft = through_lens(exact, description_.sharpness);
  cv::Mat measured(exact.size(), CV_8UC3);
  const int count = 3 * exact.cols;
  const std::vector<float> silence(noise_.empty() ? static_cast<std::size_t>(count) : 0);
  const double shot = noise_.empty() ? 0 : 1 / full_well(description_.noise);
  const double read = kReadNoise * kReadNoise * shot * shot;
  for (int y = 0; y < exact.rows; ++y) {
    expose_row(soft.ptr<std::uint8_t>(y), noise_.empty() ? silence.data() : noise_.row(frame, y),
               {gain[0], gain[1], gain[2]}, static_cast<float>(shot), static_cast<float>(read),
               count, measured.ptr<std::uint8_t>(y));
  }
  return description_.jpeg_quality > 0 ? through_jpeg(measured, description_.jpeg_quality)
                                       : measured;
}

}  // namespace armsreach::sim
