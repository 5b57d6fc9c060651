#include "vision/calibration/chessboard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace armsreach::calibration {
namespace {

// Shortest distance between neighbours, px: the window of the sub-pixel search must not reach the
// next corner.
float closest_neighbours(const Corners& corners, int columns) {
  float closest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool row_ends = (i + 1) % static_cast<std::size_t>(columns) == 0;
    const std::size_t below = i + static_cast<std::size_t>(columns);
    const auto distance = [&](std::size_t j) {
      return std::hypot(corners[i].x - corners[j].x, corners[i].y - corners[j].y);
    };
    if (!row_ends) closest = std::min(closest, distance(i + 1));
    if (below < corners.size()) closest = std::min(closest, distance(below));
  }
  return closest;
}

}  // namespace

std::vector<cv::Point3f> points_on_board(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  points.reserve(static_cast<std::size_t>(board.corners()));
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      points.emplace_back(static_cast<float>(column * board.square),
                          static_cast<float>(row * board.square), 0.0F);
    }
  }
  return points;
}

std::optional<Corners> find_chessboard(const cv::Mat& image, const Chessboard& board) {
  cv::Mat grey = image;
  if (image.channels() == 3) cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  Corners corners;
  const int flags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(grey, {board.columns, board.rows}, corners, flags)) return {};
  const int half = std::clamp(static_cast<int>(closest_neighbours(corners, board.columns) / 2) - 1,
                              2, 11);  // px, half the window
  const cv::TermCriteria until(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 0.005);
  cv::cornerSubPix(grey, corners, {half, half}, {-1, -1}, until);
  return corners;
}

}  // namespace armsreach::calibration
