// Frames of a TUM recording at a map's size, with their true poses.
#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::test {

struct RecordedView {
  cv::Mat depth;      // CV_32F m
  cv::Mat intensity;  // CV_32F
  Pose world_from_camera;
};

struct RecordedViews {
  Camera camera;
  std::vector<RecordedView> views;
};

// `count` frames, `every` apart, `width` px wide, which divides the recording's own.
RecordedViews recorded_views(const std::filesystem::path& folder, int width, int count, int every);

}  // namespace armsreach::test
