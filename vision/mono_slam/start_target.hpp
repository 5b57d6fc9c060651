// The thing of known size that a session starts on, and finding it.
//
// World axes of a target that is looked at upright: x to the left, y up, z away.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/mono_slam/pose_from_points.hpp"
#include "vision/mono_slam/search_image.hpp"

namespace armsreach::mono_slam {

struct StartTarget {
  struct Mark {
    cv::Mat patch;  // CV_8UC1, square, odd, up to 15: what its point looks like from the front
    Eigen::Vector3d point_in_world;
  };
  std::vector<Mark> marks;  // four or more, not all on a line

  // Or a black rectangle on white, around the world's origin in the plane z = 0; m.
  struct Rectangle {
    double width;
    double height;
  };
  std::optional<Rectangle> rectangle;
};

struct TargetFix {
  PoseFix pose;
  std::vector<SeenPoint> points;  // the marks, or the rectangle's corners
  bool certain = false;           // nothing else looks like this; otherwise ask a second frame
};

// All marks, matched jointly: each alone resembles many places. Nothing when they are not all
// there, do not look as the pose says, or might as well lie elsewhere.
std::optional<TargetFix> find_marks(const SearchImage& image, const Camera& camera,
                                    const std::vector<StartTarget::Mark>& marks);
// Nothing when it is not there, or two things in the image might be it.
std::optional<TargetFix> find_rectangle(const cv::Mat& grey, const Camera& camera,
                                        const StartTarget::Rectangle& rectangle);

// How far the camera may be from where the fix has it, in the direction known least; m.
double position_sigma(const TargetFix& fix);

enum class TargetSight {
  nothing,
  too_far,  // seen, but the camera's position would be known too badly to start from
  once,     // to be confirmed by the next frame
  found,
};

// Looks for a target, frame by frame, until it can be started from.
class TargetWatch {
 public:
  explicit TargetWatch(StartTarget target) : target_(std::move(target)) {}

  TargetSight look(const cv::Mat& grey, const SearchImage& image, const Camera& camera);
  const TargetFix& fix() const { return *last_; }  // unless nothing was seen

 private:
  StartTarget target_;
  std::optional<TargetFix> last_;  // of the frame before; then of this one
};

}  // namespace armsreach::mono_slam
