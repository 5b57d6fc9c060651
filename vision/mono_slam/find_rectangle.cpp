// A start target that is a black rectangle on white.
#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/mono_slam/start_target.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::vector<Vector2d>;  // four

constexpr double kLeastArea = 400;  // px
constexpr double kLeastSide = 16;   // px
constexpr double kFits = 0.5;       // px rms of the corners
// From farther to the side anything with four corners may be a rectangle of these proportions.
constexpr double kMostTurn = 0.9;  // rad

Corners corners_of(const std::vector<cv::Point>& contour, const cv::Mat& grey) {
  std::vector<cv::Point> quad;
  cv::approxPolyDP(contour, quad, 0.04 * cv::arcLength(contour, true), true);
  if (quad.size() != 4 || !cv::isContourConvex(quad)) return {};
  std::vector<cv::Point2f> exact(quad.begin(), quad.end());
  cv::cornerSubPix(grey, exact, cv::Size(4, 4), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01));
  Corners out;
  for (const cv::Point2f& p : exact) out.emplace_back(p.x, p.y);
  return out;
}

// Evenly dark inside, and much lighter just outside along all four sides: ink on paper.
bool is_ink_on_paper(const cv::Mat& grey, const Corners& corners) {
  constexpr double kStep = 4;  // px to either side of the edge
  constexpr int kContrast = 60;
  constexpr double kEven = 0.35;  // of the contrast, that ink or paper may vary by
  constexpr int kPerSide = 5;
  const Vector2d middle = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  int darkest = 255;
  int least_dark = 0;
  int lightest = 0;
  int least_light = 255;
  const auto level = [&](const Vector2d& p) {
    const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, grey.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, grey.rows - 1);
    return static_cast<int>(grey.at<unsigned char>(y, x));
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d side = corners[(i + 1) % 4] - corners[i];
    if (side.norm() < kLeastSide) return false;
    Vector2d outwards(side.y(), -side.x());
    if (outwards.dot(corners[i] - middle) < 0) outwards = -outwards;
    outwards *= kStep / side.norm();
    for (int k = 0; k < kPerSide; ++k) {
      const Vector2d edge = corners[i] + (0.2 + 0.15 * k) * side;
      const int inside = level(edge - outwards);
      const int outside = level(edge + outwards);
      const int deep = level(0.5 * (edge + middle));
      darkest = std::min({darkest, inside, deep});
      least_dark = std::max({least_dark, inside, deep});
      lightest = std::max(lightest, outside);
      least_light = std::min(least_light, outside);
    }
  }
  const int contrast = least_light - least_dark;
  return contrast > kContrast && least_dark - darkest < kEven * contrast &&
         lightest - least_light < kEven * contrast;
}

// Starts at the corner up and to the left, then clockwise in the image.
Corners upright(Corners corners) {
  const auto turn = [](const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  if (turn(corners[1] - corners[0], corners[2] - corners[1]) < 0) {
    std::reverse(corners.begin(), corners.end());
  }
  const auto first =
      std::min_element(corners.begin(), corners.end(),
                       [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  std::rotate(corners.begin(), first, corners.end());
  return corners;
}

std::vector<SeenPoint> seen_corners(const StartTarget::Rectangle& rectangle,
                                    const Corners& corners) {
  const double x = rectangle.width / 2;
  const double y = rectangle.height / 2;
  return {{Vector3d(x, y, 0), corners[0]},
          {Vector3d(-x, y, 0), corners[1]},
          {Vector3d(-x, -y, 0), corners[2]},
          {Vector3d(x, -y, 0), corners[3]}};
}

bool frontal(const Pose& world_from_camera) {
  const Eigen::Quaterniond facing(0, 0, 0, 1);  // x to the left, y up, z away
  return world_from_camera.rotation().angularDistance(facing) < kMostTurn;
}

std::optional<TargetFix> fix_of(const Camera& camera, const StartTarget::Rectangle& rectangle,
                                const Corners& corners) {
  const std::vector<SeenPoint> points = seen_corners(rectangle, corners);
  std::optional<TargetFix> best;
  for (const Pose& pose : three_point_poses(camera, {points.begin(), points.begin() + 3})) {
    const auto fix = refined_pose(camera, pose, points);
    if (!fix || fix->rms > kFits || !frontal(fix->world_from_camera)) continue;
    if (!best || fix->rms < best->pose.rms) best = TargetFix{*fix, points};
  }
  return best;
}

// A contour has an inner and an outer side: the same rectangle twice.
bool same(const TargetFix& a, const TargetFix& b) {
  return (a.points[0].pixel - b.points[0].pixel).norm() < 3;
}

}  // namespace

std::optional<TargetFix> find_rectangle(const cv::Mat& grey, const Camera& camera,
                                        const StartTarget::Rectangle& rectangle) {
  cv::Mat dark;
  cv::threshold(grey, dark, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(dark, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  std::optional<TargetFix> found;
  for (const auto& contour : contours) {
    if (cv::contourArea(contour) < kLeastArea) continue;
    const Corners corners = corners_of(contour, grey);
    if (corners.empty() || !is_ink_on_paper(grey, corners)) continue;
    auto fix = fix_of(camera, rectangle, upright(corners));
    if (!fix) continue;
    if (found && !same(*found, *fix)) return std::nullopt;
    if (!found || fix->pose.rms < found->pose.rms) found = std::move(fix);
  }
  return found;
}

}  // namespace armsreach::mono_slam
