// A view of the map (or a kept frame) that the tracker aligns the current frame against.
#pragma once

#include <cstdint>
#include <memory>

#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

struct ReferenceView {
  Camera camera;  // pinhole, of the images' size
  Pose world_from_reference;
  cv::Mat depth;            // CV_32F metres along z, NaN unknown
  cv::Mat intensity;        // CV_32F 0..1, NaN unknown
  std::int64_t frame = -1;  // index of the frame it was made after
};
using ReferenceViewPtr = std::shared_ptr<const ReferenceView>;

}  // namespace armsreach
