// One resolution of an image pair, laid out for the aligner.
//
// Depth is kept as inverse depth: it is an affine function of the pixel on every plane, so that
// interpolation and derivatives are exact there, and a sensor whose depth noise is k z^2 has the
// constant noise k in it. Dividing a depth residual by k z^2 is therefore done by the space itself.
#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/alignment/robust_scale.hpp"
#include "vision/core/camera.hpp"

namespace armsreach {

class Level {
 public:
  // Rows are padded with NaN to whole blocks of the kernels.
  static int padded(int width) { return (width + 15) / 16 * 16; }

  // Depth [m] and intensity [0..1], CV_32F with NaN for unknown; either may be empty. `camera` is a
  // pinhole of their size.
  void assign(const Camera& camera, const cv::Mat& depth, const cv::Mat& intensity);
  // Half the finer level's size: inverse depths of a block that lie within 3 % of the nearest, and
  // known intensities, are averaged.
  void assign_half(const Level& finer);

  const Camera& camera() const { return camera_; }
  int width() const { return camera_.width; }
  int height() const { return camera_.height; }
  int stride() const { return padded(camera_.width); }
  bool has_depth() const { return has_depth_; }
  // Relative change of depth from one pixel to the next beyond which it is no surface but an edge.
  float greatest_step() const { return static_cast<float>(kGreatestSlope / camera_.fx); }
  // Relative change of depth from one step to the next beyond which there is an edge or a crease.
  float greatest_bend() const { return static_cast<float>(kGreatestBend / camera_.fx); }

  // Standard deviations of single pixels, robustly estimated.
  double depth_noise() const { return depth_noise_; }          // 1/m, of inverse depth
  double intensity_noise() const { return intensity_noise_; }  // of intensity in 0..1

  // Planes of stride() x height(), NaN where unknown. Gradients are central differences per pixel;
  // those of inverse depth are unknown beside discontinuities and bends.
  std::vector<float> inverse_depth;  // 1/m
  std::vector<float> inverse_depth_x;
  std::vector<float> inverse_depth_y;
  std::vector<float> intensity;
  std::vector<float> intensity_x;
  std::vector<float> intensity_y;

 private:
  // Tangent of the angle, about 65 deg, between a surface's normal and the ray: what is seen at a
  // more grazing angle has more noise than shape. 3 % of depth a pixel at 80x60.
  static constexpr double kGreatestSlope = 2.2;
  // Change of that tangent from one pixel to the next: 1.3 % of depth at 80x60. A pixel beside an
  // edge or a crease is flat itself and has half of the edge's slope: where two images agree there
  // it would testify, wrongly and strongly, that nothing moved.
  static constexpr double kGreatestBend = 0.88;

  void resize(const Camera& camera);
  double pixel_noise(const std::vector<float>& plane);
  void differentiate();

  Camera camera_;
  bool has_depth_ = false;
  double depth_noise_ = 0;
  double intensity_noise_ = 0;
  RobustScale robust_scale_;
  std::vector<float> laplacians_;
};

// The finest level first, each half the size of the one before. Keeps its memory when reassigned.
class Pyramid {
 public:
  // As many levels as were asked for, or fewer of an image too small for them.
  void assign(const Camera& camera, const cv::Mat& depth, const cv::Mat& intensity, int levels);
  int size() const { return static_cast<int>(levels_.size()); }
  const Level& operator[](int level) const { return levels_[level]; }

 private:
  std::vector<Level> levels_;
};

}  // namespace armsreach
