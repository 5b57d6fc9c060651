#include "vision/gesture/wrist_cut.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace armsreach::gesture {
namespace {

// In units of the palm's radius.
constexpr double kShortestArm = 1.6;  // to its end; a wrist is about 1.5 from the palm's middle
constexpr double kWrist = 1.45;       // where the hand is cut
constexpr double kAxisFrom = 1.0;     // the forearm's part that gives its direction
constexpr double kAxisTo = 2.8;

constexpr float kPalmShare = 0.75F;  // of a blob's greatest breadth that a palm has at least

Palm broadest(const cv::Mat& distance, const cv::Rect& within) {
  double radius = 0;
  cv::Point at;
  cv::minMaxLoc(distance(within), nullptr, &radius, nullptr, &at);
  return {at + within.tl(), radius};
}

Eigen::Vector2d vector_from(const cv::Point& point) {
  return {static_cast<double>(point.x), static_cast<double>(point.y)};
}

}  // namespace

Palm find_palm(const cv::Mat& distance, const std::optional<Eigen::Vector2d>& arm_end) {
  const cv::Rect all(0, 0, distance.cols, distance.rows);
  const Palm largest = broadest(distance, all);
  if (!arm_end) return largest;
  const float least = kPalmShare * static_cast<float>(largest.radius);
  double farthest = -1;
  cv::Point at;
  for (int y = 0; y < distance.rows; ++y) {
    const float* row = distance.ptr<float>(y);
    for (int x = 0; x < distance.cols; ++x) {
      if (row[x] < least) continue;
      const double away = (Eigen::Vector2d(x, y) - *arm_end).squaredNorm();
      if (away <= farthest) continue;
      farthest = away;
      at = {x, y};
    }
  }
  const int reach = static_cast<int>(1.5F * distance.at<float>(at));
  return broadest(distance,
                  cv::Rect(at.x - reach, at.y - reach, 2 * reach + 1, 2 * reach + 1) & all);
}

std::optional<WristCut> find_wrist(const cv::Mat& blob, const Palm& palm,
                                   const Eigen::Vector2d& arm_end) {
  const Eigen::Vector2d middle = vector_from(palm.center);
  Eigen::Vector2d to_end = arm_end - middle;
  if (to_end.norm() < kShortestArm * palm.radius) return std::nullopt;
  to_end.normalize();
  Eigen::Vector2d sum(0, 0);
  for (int y = 0; y < blob.rows; ++y) {
    const std::uint8_t* row = blob.ptr(y);
    for (int x = 0; x < blob.cols; ++x) {
      if (row[x] == 0) continue;
      const Eigen::Vector2d from_palm = Eigen::Vector2d(x, y) - middle;
      const double away = from_palm.norm();
      const bool in_ring = away > kAxisFrom * palm.radius && away < kAxisTo * palm.radius;
      if (in_ring && from_palm.dot(to_end) > 0.6 * away) sum += from_palm / away;
    }
  }
  if (sum.norm() == 0) sum = to_end;
  return WristCut{sum.normalized(), kWrist * palm.radius};
}

cv::Mat cut_off(const cv::Mat& blob, const Palm& palm, const WristCut& cut) {
  cv::Mat hand = blob.clone();
  const Eigen::Vector2d middle = vector_from(palm.center);
  for (int y = 0; y < hand.rows; ++y) {
    std::uint8_t* row = hand.ptr(y);
    for (int x = 0; x < hand.cols; ++x) {
      if ((Eigen::Vector2d(x, y) - middle).dot(cut.to_arm) > cut.offset) row[x] = 0;
    }
  }
  // Of an arm bent back past the cut, too: what is left there hangs together with no palm.
  cv::Mat parts;
  cv::connectedComponents(hand, parts, 8, CV_32S);
  const int palm_part = parts.at<int>(palm.center);
  if (palm_part == 0) return hand;  // fingers make a ring, and its middle is no skin
  return parts == palm_part;
}

}  // namespace armsreach::gesture
