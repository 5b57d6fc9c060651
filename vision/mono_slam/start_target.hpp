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
    cv::Mat patch;  // CV_8UC1, square, odd, up to 15: what its point looks like
    Eigen::Vector3d point_in_world;
  };
  std::vector<Mark> marks;  // four or more

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
};

// All marks, matched jointly: each alone resembles many places. Nothing when they are not all
// there.
std::optional<TargetFix> find_marks(const SearchImage& image, const Camera& camera,
                                    const std::vector<StartTarget::Mark>& marks);
std::optional<TargetFix> find_rectangle(const cv::Mat& grey, const Camera& camera,
                                        const StartTarget::Rectangle& rectangle);
// Whichever the target has.
std::optional<TargetFix> find_target(const cv::Mat& grey, const SearchImage& image,
                                     const Camera& camera, const StartTarget& target);

}  // namespace armsreach::mono_slam
