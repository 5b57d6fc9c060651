// From exact pictures to what a webcam delivers: exposure that follows the light with a lag and
// drifts, white balance that drifts, the lens's softness, shot and read noise, JPEG.
#pragma once

#include <cstdint>
#include <optional>

#include <opencv2/core/mat.hpp>

#include "devices/sim/noise_tile.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// Light is the square of a picture's values, close to sRGB's curve. Noise is added to light: its
// variance grows with it (shot noise), from a floor (read noise); in the values that makes
// ColorDescription::noise everywhere but in the darkest parts, where it is more.
class ColorSensor {
 public:
  // Pictures of width x height at `rate` Hz.
  ColorSensor(const SensorDescription& description, std::uint64_t seed);

  // `exact`: CV_8UC3. Frames come in order: the exposure of one follows from those before.
  cv::Mat measure(const cv::Mat& exact, double time, std::int64_t frame);

  // Standard deviation, in grey levels, of a picture's value `level` (0 .. 255).
  double noise_at(double level) const;

 private:
  // Of light, blue first.
  cv::Vec3f gains(const cv::Mat& exact, double time);
  void follow(double wanted);  // logarithm of the gain

  ColorDescription description_;
  double interval_;  // s from frame to frame
  std::uint64_t seed_;
  NoiseTile noise_;
  std::optional<double> log_gain_;  // of the next frame
};

}  // namespace armsreach::sim
