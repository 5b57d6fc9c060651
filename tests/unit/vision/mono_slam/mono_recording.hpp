// Grey recordings in memory, and what MonoSlam makes of them.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/trajectory.hpp"
#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::mono_slam::test {

struct MonoRecording {
  Camera camera;
  std::vector<cv::Mat> frames;  // 30 Hz
  std::optional<StartTarget> target;
  cv::Mat first_depth;  // of the grey camera
  Trajectory truth;     // of the grey camera

  Timestamp time(std::size_t frame) const {
    return timestamp_from_seconds(static_cast<double>(frame) / 30);
  }
};

MonoRecording read_desk(const std::filesystem::path& folder);
// Colour frames of a TUM recording as 320x240 grey.
MonoRecording read_rgbd(const std::filesystem::path& folder, std::size_t frames);

struct Summary {
  std::vector<MonoResult> results;
  std::vector<double> innovations;  // px, of all measurements
  std::vector<double> residuals;
  int lost = 0;  // frames
  Trajectory estimate;
};
// `edit` may change what is given of a frame, or leave the frame out by returning false.
using Edit = std::function<bool(std::size_t frame, MonoInput* input)>;
Summary run(const MonoRecording& recording, const MonoSlamOptions& options,
            const Edit& edit = nullptr);

// The value below which the share lies.
double quantile(std::vector<double> values, double share);

}  // namespace armsreach::mono_slam::test
