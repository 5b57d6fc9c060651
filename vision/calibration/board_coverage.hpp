// Which views of a board a calibration has, and which it still needs: a camera is only known where
// the board was seen, and its focal length only from tilted boards.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "vision/calibration/chessboard.hpp"

namespace armsreach::calibration {

// How a board lies in the image, each 0..1.
struct BoardPlace {
  double x = 0;     // of its middle, left to right
  double y = 0;     // top to bottom
  double size = 0;  // square root of the share of the image it fills
  double tilt = 0;  // perspective: 0 seen straight on, 1 foreshortened by half or more
};

class BoardCoverage {
 public:
  BoardCoverage(const Chessboard& board, cv::Size image) : board_(board), image_(image) {}

  // Whether this view tells something that those taken so far do not.
  bool adds(const Corners& corners) const;
  void take(const Corners& corners);

  int views() const { return static_cast<int>(places_.size()); }
  // Of what a calibration should have, 0..1: across, down, near and far, tilted.
  std::array<double, 4> progress() const;
  bool complete() const;
  // What to do with the board next, in words; "" when complete.
  std::string advice() const;

 private:
  BoardPlace place_of(const Corners& corners) const;

  Chessboard board_;
  cv::Size image_;
  std::vector<BoardPlace> places_;
};

}  // namespace armsreach::calibration
