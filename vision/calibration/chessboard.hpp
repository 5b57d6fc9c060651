// A printed chessboard and its inner corners in an image.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace armsreach::calibration {

struct Chessboard {
  int columns = 9;        // inner corners along the longer side
  int rows = 6;           // and along the other
  double square = 0.025;  // m, side of a square

  int corners() const { return columns * rows; }
};

// Row by row in the board's plane, z = 0, the first corner at the origin; m.
std::vector<cv::Point3f> points_on_board(const Chessboard& board);

// Inner corners row by row, to a few hundredths of a pixel; nothing unless all of them are seen.
// `image` is CV_8UC1 or CV_8UC3 BGR.
using Corners = std::vector<cv::Point2f>;
std::optional<Corners> find_chessboard(const cv::Mat& image, const Chessboard& board);

}  // namespace armsreach::calibration
