#include "vision/gesture/reach.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

// Shares of the image's width: depth is missing about as far as the second from the edge of what is
// far, and what is near keeps the first.
constexpr double kFarEdge = 0.02;
constexpr double kNearEdge = 0.005;

// `mask` with every part made larger by a share of its width on all sides.
cv::Mat grown(const cv::Mat& mask, double share) {
  const int radius = std::max(1, cvRound(share * mask.cols));
  cv::Mat larger;
  cv::dilate(mask, larger,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * radius + 1, 2 * radius + 1}));
  return larger;
}

}  // namespace

cv::Mat within_reach(const cv::Mat& skin, const cv::Mat& depth, double reach) {
  const cv::Mat far = depth > reach;
  const cv::Mat near = depth <= reach;
  cv::Mat gone = far | (grown(far, kFarEdge) & ~grown(near, kNearEdge));
  if (gone.size() != skin.size()) cv::resize(gone, gone, skin.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat left = skin.clone();
  left.setTo(0, gone);
  return left;
}

}  // namespace armsreach::gesture
