#include "vision/mono_slam/start_target.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A mark's places are sought loosely; together they must be good.
constexpr double kLeastScore = 0.75;
constexpr int kMostPlaces = 12;
constexpr double kLeastMeanScore = 0.88;
constexpr double kNear = 4;    // px, of a mark from where the others put it
constexpr double kFits = 1.0;  // px rms of all
// Patches are pictures of a target that is looked at frontally: from farther to the side they would
// not have matched.
constexpr double kMostTurn = 1.05;  // rad

struct MarkPlaces {
  std::vector<Match> matches;
};

std::optional<Vector2d> seen_at(const Camera& camera, const Pose& world_from_camera,
                                const Vector3d& point_in_world) {
  return project(camera, world_from_camera.inverse() * point_in_world);
}

bool frontal(const Pose& world_from_camera) {
  const Eigen::Quaterniond upright(0, 0, 0, 1);  // x to the left, y up, z away
  return world_from_camera.rotation().angularDistance(upright) < kMostTurn;
}

struct Found {
  double score = 0;  // sum over the marks
  PoseFix pose;
  std::vector<SeenPoint> points;
};

// The best joint placement when the first three marks lie at these places.
void complete(const Camera& camera, const std::vector<StartTarget::Mark>& marks,
              const std::vector<MarkPlaces>& places, const std::array<std::size_t, 3>& chosen,
              Found* best) {
  std::vector<SeenPoint> points;
  double score = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Match& match = places[i].matches[chosen[i]];
    points.push_back({marks[i].point_in_world, match.pixel});
    score += match.score;
  }
  for (const Pose& pose : three_point_poses(camera, points)) {
    std::vector<SeenPoint> all = points;
    double sum = score;
    for (std::size_t i = 3; i < marks.size(); ++i) {
      const auto expected = seen_at(camera, pose, marks[i].point_in_world);
      if (!expected) break;
      const Match* nearest = nullptr;
      for (const Match& match : places[i].matches) {
        if ((match.pixel - *expected).norm() > kNear) continue;
        if (!nearest || match.score > nearest->score) nearest = &match;
      }
      if (!nearest) break;
      all.push_back({marks[i].point_in_world, nearest->pixel});
      sum += nearest->score;
    }
    if (all.size() < marks.size() || sum <= best->score) continue;
    const auto fix = refined_pose(camera, pose, all);
    if (fix && fix->rms < kFits && frontal(fix->world_from_camera)) *best = {sum, *fix, all};
  }
}

std::vector<Vector2d> corners_of(const std::vector<cv::Point>& contour, const cv::Mat& grey) {
  std::vector<cv::Point> quad;
  cv::approxPolyDP(contour, quad, 0.04 * cv::arcLength(contour, true), true);
  if (quad.size() != 4 || !cv::isContourConvex(quad)) return {};
  std::vector<cv::Point2f> exact(quad.begin(), quad.end());
  cv::cornerSubPix(grey, exact, cv::Size(4, 4), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 30, 0.01));
  std::vector<Vector2d> out;
  for (const cv::Point2f& p : exact) out.emplace_back(p.x, p.y);
  return out;
}

// Dark inside, and much lighter just outside all four sides.
bool is_dark_on_light(const cv::Mat& grey, const std::vector<Vector2d>& corners) {
  constexpr double kStep = 4;  // px to either side of the edge
  constexpr int kContrast = 60;
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& c : corners) middle += c / 4;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d edge = 0.5 * (corners[i] + corners[(i + 1) % 4]);
    const Vector2d outwards = (edge - middle).normalized() * kStep;
    const auto level = [&](const Vector2d& p) {
      const int x = std::clamp(static_cast<int>(std::lround(p.x())), 0, grey.cols - 1);
      const int y = std::clamp(static_cast<int>(std::lround(p.y())), 0, grey.rows - 1);
      return static_cast<int>(grey.at<unsigned char>(y, x));
    };
    if (level(edge + outwards) - level(edge - outwards) < kContrast) return false;
  }
  return true;
}

// Starts at the corner up and to the left, then clockwise in the image.
std::vector<Vector2d> upright(std::vector<Vector2d> corners) {
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

}  // namespace

std::optional<TargetFix> find_marks(const SearchImage& image, const Camera& camera,
                                    const std::vector<StartTarget::Mark>& marks) {
  if (marks.size() < 4) return std::nullopt;
  const Region all = everywhere(image.full().width, image.full().height);
  std::vector<MarkPlaces> places;
  for (const StartTarget::Mark& mark : marks) {
    places.push_back({search_all(image, template_of(mark.patch), all, kLeastScore, kMostPlaces)});
    if (places.back().matches.empty()) return std::nullopt;
  }
  Found best;
  for (std::size_t i = 0; i < places[0].matches.size(); ++i) {
    for (std::size_t j = 0; j < places[1].matches.size(); ++j) {
      for (std::size_t k = 0; k < places[2].matches.size(); ++k) {
        complete(camera, marks, places, {i, j, k}, &best);
      }
    }
  }
  if (best.score < kLeastMeanScore * static_cast<double>(marks.size())) return std::nullopt;
  return TargetFix{best.pose, best.points};
}

std::optional<TargetFix> find_rectangle(const cv::Mat& grey, const Camera& camera,
                                        const StartTarget::Rectangle& rectangle) {
  constexpr double kLeastArea = 400;  // px
  cv::Mat dark;
  cv::threshold(grey, dark, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(dark, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
  const double x = rectangle.width / 2;
  const double y = rectangle.height / 2;
  const std::array<Vector3d, 4> in_world{Vector3d(x, y, 0), Vector3d(-x, y, 0), Vector3d(-x, -y, 0),
                                         Vector3d(x, -y, 0)};
  std::optional<TargetFix> best;
  for (const auto& contour : contours) {
    if (cv::contourArea(contour) < kLeastArea) continue;
    std::vector<Vector2d> corners = corners_of(contour, grey);
    if (corners.empty() || !is_dark_on_light(grey, corners)) continue;
    corners = upright(corners);
    std::vector<SeenPoint> points;
    for (std::size_t i = 0; i < 4; ++i) points.push_back({in_world[i], corners[i]});
    for (const Pose& pose : three_point_poses(camera, {points.begin(), points.begin() + 3})) {
      const auto fix = refined_pose(camera, pose, points);
      if (fix && fix->rms < kFits && (!best || fix->rms < best->pose.rms)) {
        best = TargetFix{*fix, points};
      }
    }
  }
  return best;
}

std::optional<TargetFix> find_target(const cv::Mat& grey, const SearchImage& image,
                                     const Camera& camera, const StartTarget& target) {
  if (!target.marks.empty()) return find_marks(image, camera, target.marks);
  if (target.rectangle) return find_rectangle(grey, camera, *target.rectangle);
  return std::nullopt;
}

}  // namespace armsreach::mono_slam
