// Where a hand ends and its forearm begins, in the mask of one blob.
#pragma once

#include <optional>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

struct Palm {
  cv::Point center{0, 0};
  double radius = 0;  // px, of the largest circle inside
};

// `distance`: CV_32F, to the nearest pixel off the blob. The palm is where the blob is broad, as
// far as can be from `arm_end`; without one, where it is broadest.
Palm find_palm(const cv::Mat& distance, const std::optional<Eigen::Vector2d>& arm_end);

struct WristCut {
  Eigen::Vector2d to_arm{0, 0};  // unit
  double offset = 0;             // px from the palm's middle along it
};

// Nothing where the arm's end is hardly beyond the palm.
std::optional<WristCut> find_wrist(const cv::Mat& blob, const Palm& palm,
                                   const Eigen::Vector2d& arm_end);

// The blob without what lies beyond the cut.
cv::Mat cut_off(const cv::Mat& blob, const Palm& palm, const WristCut& cut);

}  // namespace armsreach::gesture
