// From exact images to what a structured-light camera would have measured. The same seed and frame
// index give the same noise.
#pragma once

#include <cstdint>

#include <opencv2/core/mat.hpp>

#include "devices/sim/noise_tile.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// Depth of a Kinect-like camera. A pattern is projected from beside the camera and its shift, the
// disparity, is measured in whole steps; the depth error is sigma = 1.425e-3 z^2 (z in m) times
// SensorDescription::noise. Source: Khoshelham, Elberink, "Accuracy and resolution of Kinect depth
// data", Sensors 2012, eqs. 9 and 12.
class DepthSensor {
 public:
  // `focal` in px.
  DepthSensor(const SensorDescription& description, double focal, std::uint64_t seed);

  // `exact`: CV_32F m, NaN unknown. `returned`: CV_8U, the share of projected light that the
  // surface sends back, in 255ths. There is no depth outside the range, where the projector's light
  // does not reach, where too little of it comes back: at edges, at grazing angles, from dark and
  // shiny things.
  cv::Mat measure(const cv::Mat& exact, const cv::Mat& returned, std::int64_t frame) const;

 private:
  void measure_row(const cv::Mat& exact, const cv::Mat& returned, const float* noise, int y,
                   cv::Mat& measured) const;

  SensorDescription description_;
  float focal_;
  NoiseTile noise_;  // empty for an exact sensor
};

}  // namespace armsreach::sim
