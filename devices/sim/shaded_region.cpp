#include "devices/sim/shaded_region.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace armsreach::sim {
namespace {

constexpr int kCell = 8;           // px along a side of the cells that outlines are filled in
constexpr double kNearest = 0.05;  // m before the camera: what is nearer may be anywhere
constexpr double kLongest = 4.0;   // m that shadows are followed
constexpr double kFarOff = 1e4;    // px; outlines go no farther out of the picture

class Region {
 public:
  Region(const Camera& camera, const Pose& world_from_camera)
      : camera_(camera), camera_from_world_(world_from_camera.inverse()) {}

  // Fills the outline of what lies between these points.
  void fill(const std::vector<Eigen::Vector3d>& points, cv::Mat& cells) const {
    std::vector<cv::Point> seen;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d at = camera_from_world_ * point;
      if (at.z() < kNearest) {
        cells.setTo(255);
        return;
      }
      const auto cell = [](double pixel) {
        return static_cast<int>(std::floor((std::clamp(pixel, -kFarOff, kFarOff) + 0.5) / kCell));
      };
      seen.emplace_back(cell(camera_.fx * at.x() / at.z() + camera_.cx),
                        cell(camera_.fy * at.y() / at.z() + camera_.cy));
    }
    std::vector<cv::Point> outline;
    cv::convexHull(seen, outline);
    cv::fillConvexPoly(cells, outline, cv::Scalar(255));
  }

 private:
  const Camera& camera_;
  Pose camera_from_world_;
};

// A box and its shadow down to a height.
std::vector<Eigen::Vector3d> swept(const Corners& corners, double down_to,
                                   const Eigen::Vector3d& towards_light) {
  std::vector<Eigen::Vector3d> points(corners.begin(), corners.end());
  for (const Eigen::Vector3d& corner : corners) {
    const double height = std::max(0.0, corner.z() - down_to);
    const double way = std::min(kLongest, height / std::max(1e-3, towards_light.z()));
    points.emplace_back(corner - way * towards_light);
  }
  return points;
}

// Bands of a few rows of cells, each from the first to the last that is marked.
std::vector<cv::Rect> rows_of(const cv::Mat& cells) {
  constexpr int kRows = 4;
  std::vector<cv::Rect> rectangles;
  for (int y = 0; y < cells.rows; y += kRows) {
    const int rows = std::min(kRows, cells.rows - y);
    const cv::Rect marked = cv::boundingRect(cells.rowRange(y, y + rows));
    if (marked.empty()) continue;
    rectangles.emplace_back(kCell * marked.x, kCell * y, kCell * marked.width, kCell * rows);
  }
  return rectangles;
}

}  // namespace

Corners corners_of(const Eigen::AlignedBox3d& box) {
  Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
  return corners;
}

std::vector<cv::Rect> shaded_rectangles(const Camera& camera, const Pose& world_from_camera,
                                        const std::vector<Corners>& shading,
                                        const std::vector<Eigen::AlignedBox3d>& still,
                                        const Eigen::Vector3d& towards_light) {
  const Region region(camera, world_from_camera);
  const cv::Size size((camera.width + kCell - 1) / kCell, (camera.height + kCell - 1) / kCell);
  cv::Mat all = cv::Mat::zeros(size, CV_8U);
  for (const Eigen::AlignedBox3d& box : still) {
    const Corners corners = corners_of(box);
    cv::Mat place = cv::Mat::zeros(size, CV_8U);
    region.fill({corners.begin(), corners.end()}, place);
    cv::Mat shaded = cv::Mat::zeros(size, CV_8U);
    for (const Corners& one : shading)
      region.fill(swept(one, box.min().z(), towards_light), shaded);
    all |= place & shaded;
  }
  // Corners were taken for their cells' middles.
  cv::dilate(all, all, cv::Mat());
  return rows_of(all);
}

}  // namespace armsreach::sim
