// How far a camera has turned from one picture to the next, whatever the two show: all pixels of
// both are laid onto each other. That works where single points cannot be recognised, in pictures
// smeared by a fast turn. Source: Baker, Matthews, "Lucas-Kanade 20 years on", IJCV 2004 (inverse
// compositional, with Tukey's weights).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"

namespace armsreach::mono_slam {

struct ImageTurn {
  // Of the camera's axes. A camera that moves besides seems to turn by the parallax.
  Eigen::Quaterniond before_from_after = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // about the axes after, rad^2
};

class ImageTurnMeter {
 public:
  explicit ImageTurnMeter(const Camera& camera);

  // CV_8UC1 of the camera's size: the picture after; what was that becomes the one before.
  void take(const cv::Mat& grey);

  // Nothing before there are two pictures, where they share too little, and where what they share
  // says too little. `expected` must be within about two degrees.
  std::optional<ImageTurn> measure(const Eigen::Quaterniond& expected) const;

 private:
  using Turn = Eigen::Matrix<float, 2, 3>;
  // The pictures at one resolution.
  struct Level {
    Camera camera;
    std::vector<Eigen::Vector3f> rays;  // of each pixel
    std::vector<Turn> pixel_by_turn;    // of a point that turns about the camera, px / rad
    cv::Mat before;                     // CV_32F, or empty
    cv::Mat after;
  };
  struct Pixel;
  // What both pictures show under some turn, and by how much it differs.
  struct Overlap {
    std::vector<const Pixel*> pixels;
    std::vector<float> residuals;
  };
  struct Step {
    Eigen::Vector4d value;  // a turn, and a change of the light
    Eigen::Matrix3d covariance;
  };
  static std::vector<Pixel> pixels_of(const Level& level);
  static Overlap overlap(const Level& level, const std::vector<Pixel>& pixels,
                         const Eigen::Quaterniond& turn, double light);
  static Step step(const Overlap& shared);
  static std::optional<ImageTurn> refine(const Level& level, const Eigen::Quaterniond& start);

  std::vector<Level> levels_;  // coarse to fine
};

}  // namespace armsreach::mono_slam
