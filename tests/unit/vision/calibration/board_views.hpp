// Views of a chessboard by a known camera.
#pragma once

#include <optional>
#include <random>
#include <vector>

#include "vision/calibration/chessboard.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::test {

// Corners as the camera sees them; nothing when one is outside the image.
inline std::optional<calibration::Corners> seen_board(const Camera& camera,
                                                      const calibration::Chessboard& board,
                                                      const Pose& camera_from_board) {
  calibration::Corners corners;
  for (const cv::Point3f& p : points_on_board(board)) {
    const auto pixel =
        project(camera, camera_from_board * Eigen::Vector3f(p.x, p.y, p.z).cast<double>());
    if (!pixel || !camera.contains(*pixel)) return std::nullopt;
    corners.emplace_back(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()));
  }
  return corners;
}

// The board's middle at (x, y) of the image plane [m at 1 m], `depth` away, tilted.
inline Pose board_pose(const calibration::Chessboard& board, double x, double y, double depth,
                       const Eigen::Vector3d& tilt) {
  const Eigen::Vector3d middle((board.columns - 1) * board.square / 2,
                               (board.rows - 1) * board.square / 2, 0);
  const Eigen::Quaterniond rotation = so3_exp(tilt);
  return {rotation, Eigen::Vector3d(x * depth, y * depth, depth) - rotation * middle};
}

// `count` whole views with corners off by a normal error [px].
inline std::vector<calibration::Corners> board_views(const Camera& camera,
                                                     const calibration::Chessboard& board,
                                                     int count, double error, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> across(-0.35, 0.35);
  std::uniform_real_distribution<double> depth(0.3, 0.6);
  std::uniform_real_distribution<double> tilt(-0.6, 0.6);
  std::normal_distribution<float> noise(0, static_cast<float>(error));
  std::vector<calibration::Corners> views;
  while (static_cast<int>(views.size()) < count) {
    const double x = across(random);
    const double y = across(random);
    const double z = depth(random);
    const Eigen::Vector3d turn(tilt(random), tilt(random), tilt(random));
    auto corners = seen_board(camera, board, board_pose(board, x, y, z, turn));
    if (!corners) continue;
    for (cv::Point2f& corner : *corners) corner += cv::Point2f(noise(random), noise(random));
    views.push_back(*std::move(corners));
  }
  return views;
}

}  // namespace armsreach::test
