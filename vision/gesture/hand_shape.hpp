// Hands in a mask of skin: blobs of plausible size, cut from their forearms.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

namespace armsreach::gesture {

struct HandFinderOptions {
  int most_hands = 2;
  double least_area = 0.008;  // of a hand without forearm, of the image
  // Of one that had to be parted from a wall.
  double least_area_alone = 0.05;
  double most_area = 0.45;
  // How much of its outline a blob has on the image's border, in units of the root of its own
  // area: a forearm that comes into the image is narrower, a wall broader.
  double most_contact = 1.8;
  // Less is where a hand cut out of an image just touches the border: no arm is as narrow.
  double least_contact = 0.25;
  double most_area_inside = 0.7;  // of a hand that keeps clear of the border, as in a cut-out image
};

// Pixels are those of the image; a hand may be looked at in a smaller copy of it.
struct HandShape {
  cv::Mat mask;                       // CV_8UC1, 255 on the hand without its forearm; a crop, and
  Eigen::Vector2d mask_origin{0, 0};  // where the middle of its first pixel is in the image,
  double mask_scale = 1;              // px of the image a pixel of it
  Eigen::Vector2d center{0, 0};       // centroid
  double area = 0;                    // px^2
  std::optional<Eigen::Vector2d>
      to_arm;  // unit, from the middle of the palm; nothing where no arm was seen
};

// One blob, and the hands it may be: which end of an arm in the middle of the image is the hand is
// not for its outline alone to say.
struct HandBlob {
  std::vector<HandShape> readings;  // at least one
  std::vector<cv::Point> outline;   // closed, with the forearm
  double contact = 0;               // px of it on the image's border
  bool plausible = true;            // by area and contact
};

class HandFinder {
 public:
  explicit HandFinder(const HandFinderOptions& options = {}) : options_(options) {}

  // `mask`: CV_8UC1, 0 off the skin. The largest blobs first.
  std::vector<HandBlob> find(const cv::Mat& mask) const;

  const HandFinderOptions& options() const { return options_; }

 private:
  HandFinderOptions options_;
};

}  // namespace armsreach::gesture
