// Direct alignment of a depth and intensity image against a reference view.
//
// Minimises over the camera's motion and a global intensity offset b
//     sum alpha rho(r_D / s_D) + (1 - alpha) rho(r_I / s_I)
// where r_D is the difference of inverse depths (that of depths divided by z^2, to first order),
// r_I that of intensities less b, s their robust standard deviations and rho Tukey's biweight, by
// iteratively reweighted efficient second-order minimisation (each image contributes half of the
// derivatives; Malis 2004). Sources: Damen et al., IROS 2012, section III; Benhimane and Malis,
// IROS 2004; Tykkala, Audras, Comport, ICCVW 2011.
#pragma once

#include <utility>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "vision/alignment/align_kernels.hpp"
#include "vision/alignment/level.hpp"
#include "vision/alignment/robust_scale.hpp"
#include "vision/core/isa.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

struct AlignerOptions {
  double alpha = 0.95;                   // 1: depth only, 0: intensity only
  std::vector<int> iterations = {5, 3};  // at most, from the finest level to coarser ones
};

// Standard deviations of the residuals.
struct ResidualScales {
  double depth = 0;      // 1/m, of inverse depth: k of a sensor with noise k z^2
  double intensity = 0;  // of intensity in 0..1
};

struct AlignmentResult {
  Pose reference_from_camera;
  double intensity_offset = 0;  // the camera's intensity minus the reference's
  ResidualScales scales;        // robustly estimated at the solution; 0: nothing to compare
  double alpha = 0;             // the weight of depth; 0 when the camera has none
  int compared = 0;             // pixels of the camera's finest level with a residual
  int inliers = 0;              // of those, with a weight above zero
  cv::Mat weights;              // see TrackedFrame::weights
  // Inverse covariance of the camera's motion (translation, rotation) on the left of
  // camera_from_reference, as far as residuals are independent.
  Matrix6d information = Matrix6d::Zero();
  // Of all motions the one determined worst: its information beside what noise alone would feign,
  // by giving gradients to a blank wall. About 1 or less where there is nothing to hold on to.
  double observability = 0;
  bool ok = false;  // there were residuals enough to solve for the motion
};

class Aligner {
 public:
  explicit Aligner(AlignerOptions options = {}, Isa isa = best_isa())
      : options_(std::move(options)), kernels_(align_kernels(isa)) {}

  const AlignerOptions& options() const { return options_; }

  // Starts from `start` and the offset of an earlier alignment, if any.
  AlignmentResult align(const Pyramid& camera, const Pyramid& reference, const Pose& start,
                        double intensity_offset = 0);

 private:
  struct Estimate {
    Pose camera_from_reference;
    double intensity_offset = 0;
    Matrix6d information = Matrix6d::Zero();
    Matrix6d feigned_information = Matrix6d::Zero();  // by noise, see observability
  };

  Residuals residuals(const Level& source, const Level& target, const Pose& target_from_source,
                      double intensity_offset);
  ResidualScales scales(const Residuals& residuals, int size, const ResidualScales& pixel_noise);
  Weighting depth_weighting(const ResidualScales& scales) const;
  Weighting intensity_weighting(const ResidualScales& scales) const;
  bool refine(const Level& camera, const Level& reference, int iterations, Estimate& estimate);
  Matrix6d feigned_information(const Residuals& residuals, const Level& reference,
                               const Level& camera, const ResidualScales& noise,
                               const ResidualScales& scales) const;
  void weigh(const Level& camera, const Level& reference, AlignmentResult& result);

  AlignerOptions options_;
  AlignKernels kernels_;
  RobustScale robust_scale_;
  std::vector<float> planes_;  // of the residuals
};

}  // namespace armsreach
