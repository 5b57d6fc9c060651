#include "vision/alignment/aligner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "vision/alignment/kernel_arguments.hpp"

namespace armsreach {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kTukey = 4.685;  // cutoff in deviations; 95 % efficient on normal residuals
// Quantisation alone leaves this much, so that exact images do not divide by zero.
constexpr ResidualScales kLeastScales{3e-4, 2e-3};
// Quantised depth may agree exactly on most pixels and differ by a whole step on the rest: the
// scale is at least this times the camera's own noise, about what interpolation leaves of it.
constexpr double kOfPixelNoise = 0.7;
constexpr int kScaleSamples = 1024;  // residuals a median is taken of
constexpr int kNoiseSamples = 256;   // pixels that stand for all where noise is assessed
constexpr int kLeastResiduals = 64;
constexpr double kConverged = 1e-3;  // pixels: a smaller step is the last

using Matrix7d = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using Vector7d = Eigen::Matrix<double, kUnknowns, 1>;

// Of single pixels.
ResidualScales pixel_noise_of(const Level& level) {
  return {std::max(level.depth_noise(), kLeastScales.depth / 10),
          std::max(level.intensity_noise(), kLeastScales.intensity / 10)};
}

int size_of(const Level& level) { return level.stride() * level.height(); }

// The smallest ratio of the two over all motions.
double least_ratio(const Matrix6d& information, const Matrix6d& feigned) {
  const Eigen::LLT<Matrix6d> root(feigned);
  if (root.info() != Eigen::Success) return 0;
  const Matrix6d half = root.matrixL().solve(information);
  const Matrix6d whitened = root.matrixL().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(whitened, Eigen::EigenvaluesOnly);
  return eigen.info() == Eigen::Success ? eigen.eigenvalues()(0) : 0;
}

// The level of a pyramid whose pixels are nearest in size to those of `wanted`.
const Level& level_like(const Pyramid& pyramid, const Level& wanted) {
  int best = 0;
  for (int i = 1; i < pyramid.size(); ++i) {
    const auto mismatch = [&](int level) {
      return std::abs(std::log(pyramid[level].camera().fx / wanted.camera().fx));
    };
    if (mismatch(i) < mismatch(best)) best = i;
  }
  return pyramid[best];
}

struct Step {
  Vector6d motion;
  double intensity_offset;
  Matrix6d information;
};

Step solve(const std::array<double, kSums>& sums) {
  Matrix7d normal;
  int k = 0;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = i; j < kUnknowns; ++j) normal(i, j) = normal(j, i) = sums[k++];
  }
  const Eigen::Map<const Vector7d> gradient(sums.data() + kTriangle);
  const Matrix6d information = normal.topLeftCorner<6, 6>();
  if (!(normal(6, 6) > 0)) normal(6, 6) = 1;  // no intensity at all
  // Keeps directions that nothing determines where they are.
  normal.diagonal() *= 1 + 1e-6;
  const Vector7d step = normal.ldlt().solve(-gradient);
  return {step.head<6>(), step(6), information};
}

}  // namespace

AlignKernels align_kernels(Isa isa) {
#ifdef __x86_64__
  if (isa == Isa::v4) return v4::kAlignKernels;
  if (isa == Isa::v3) return v3::kAlignKernels;
#endif
  static_cast<void>(isa);
  return baseline::kAlignKernels;
}

Residuals Aligner::residuals(const Level& source, const Level& target,
                             const Pose& target_from_source, double intensity_offset) {
  const std::size_t size = size_of(source);
  if (planes_.size() < 9 * size) planes_.resize(9 * size);
  float* plane = planes_.data();
  const auto next = [&] { return std::exchange(plane, plane + size); };
  const Residuals out{next(), next(), next(), next(), next(), next(), next(), next(), next()};
  kernels_.warp(planes(source), planes(target), warp_from(target_from_source, intensity_offset),
                out);
  return out;
}

ResidualScales Aligner::scales(const Residuals& residuals, int size,
                               const ResidualScales& pixel_noise) {
  const int stride = size / kScaleSamples | 1;
  const std::size_t count = size;
  return {
      std::max({kLeastScales.depth, kOfPixelNoise * pixel_noise.depth,
                robust_scale_({residuals.depth, count}, stride).scale}),
      std::max(kLeastScales.intensity, robust_scale_({residuals.intensity, count}, stride).scale)};
}

Weighting Aligner::depth_weighting(const ResidualScales& scales) const {
  return {static_cast<float>(options_.alpha / (scales.depth * scales.depth)),
          static_cast<float>(kTukey * scales.depth)};
}

Weighting Aligner::intensity_weighting(const ResidualScales& scales) const {
  return {static_cast<float>((1 - options_.alpha) / (scales.intensity * scales.intensity)),
          static_cast<float>(kTukey * scales.intensity)};
}

// Noise of variance s^2 in the pixels of both images leaves about s^2 / 2 in the mean of a central
// difference and an interpolated cell's derivative.
Matrix6d Aligner::feigned_information(const Residuals& residuals, const Level& reference,
                                      const Level& camera, const ResidualScales& noise,
                                      const ResidualScales& scales) const {
  const int size = size_of(reference);
  const int stride = size / kNoiseSamples | 1;
  const auto gain = [](double alpha, double noise_scale, double scale) {
    const double ratio = std::min(1.0, noise_scale / scale);
    return alpha * ratio * ratio;
  };
  const double depth_gain = gain(options_.alpha, noise.depth, scales.depth);
  const double intensity_gain = gain(1 - options_.alpha, noise.intensity, scales.intensity);
  Matrix6d sum = Matrix6d::Zero();
  for (int at = 0; at < size; at += stride) {
    const auto depth = static_cast<double>(residuals.depth[at]);
    const auto intensity = static_cast<double>(residuals.intensity[at]);
    const double both = (std::abs(depth) < kTukey * scales.depth ? depth_gain : 0) +
                        (std::abs(intensity) < kTukey * scales.intensity ? intensity_gain : 0);
    if (!(both > 0)) continue;
    const auto x = static_cast<double>(residuals.X[at]);
    const auto y = static_cast<double>(residuals.Y[at]);
    const auto rho = static_cast<double>(residuals.inverse_z[at]);
    Eigen::Matrix<double, 6, 2> by_gradient;  // x and y
    by_gradient << rho, 0, 0, rho, -rho * x, -rho * y, -x * y, -1 - y * y, 1 + x * x, x * y, -y, x;
    sum += both * by_gradient * by_gradient.transpose();
  }
  const double focal_length = camera.camera().fx;
  return 0.5 * stride * focal_length * focal_length * sum;
}

bool Aligner::refine(const Level& camera, const Level& reference, int iterations,
                     Estimate& estimate) {
  const int size = size_of(reference);
  const ResidualScales noise = pixel_noise_of(camera);
  const double converged = kConverged / camera.camera().fx;  // rad, and m at a distance of 1 m
  for (int i = 0; i < iterations; ++i) {
    const Residuals found =
        residuals(reference, camera, estimate.camera_from_reference, estimate.intensity_offset);
    const ResidualScales spread = scales(found, size, noise);
    std::array<double, kSums> sums;
    kernels_.accumulate(found, size, depth_weighting(spread), intensity_weighting(spread),
                        sums.data());
    const Step step = solve(sums);
    if (!step.motion.allFinite()) return false;
    estimate.camera_from_reference = Pose::exp(step.motion) * estimate.camera_from_reference;
    estimate.intensity_offset += step.intensity_offset;
    estimate.information = step.information;
    const bool last = i + 1 == iterations || step.motion.lpNorm<Eigen::Infinity>() < converged;
    if (!last) continue;
    estimate.feigned_information = feigned_information(found, reference, camera, noise, spread);
    break;
  }
  return estimate.camera_from_reference.is_finite();
}

// Weighs the pixels of the camera, or, of a camera without depth, those of the reference, whose
// weights then go where they are seen.
void Aligner::weigh(const Level& camera, const Level& reference, AlignmentResult& result) {
  const Pose& reference_from_camera = result.reference_from_camera;
  const bool own_depth = camera.has_depth();
  const Level& source = own_depth ? camera : reference;
  const int size = size_of(source);
  const Residuals found =
      own_depth
          ? residuals(camera, reference, reference_from_camera, -result.intensity_offset)
          : residuals(reference, camera, reference_from_camera.inverse(), result.intensity_offset);
  result.scales = scales(found, size, pixel_noise_of(camera));
  result.alpha = own_depth ? options_.alpha : 0;
  float* const weights = found.depth_gX;  // no longer needed
  kernels_.weigh(found, size, depth_weighting(result.scales), intensity_weighting(result.scales),
                 weights);
  for (int at = 0; at < size; ++at) {
    result.compared += weights[at] >= 0 ? 1 : 0;
    result.inliers += weights[at] > 0 ? 1 : 0;
  }
  result.weights = cv::Mat(camera.height(), camera.width(), CV_32FC1, cv::Scalar(kNaN));
  if (own_depth) {
    for (int row = 0; row < camera.height(); ++row) {
      std::copy_n(weights + row * camera.stride(), camera.width(), result.weights.ptr<float>(row));
    }
    return;
  }
  result.scales.depth = 0;
  const Camera& model = camera.camera();
  for (int at = 0; at < size; ++at) {
    if (!(weights[at] >= 0)) continue;
    const double u = model.fx * static_cast<double>(found.X[at]) + model.cx;
    const double v = model.fy * static_cast<double>(found.Y[at]) + model.cy;
    result.weights.at<float>(static_cast<int>(std::lround(v)), static_cast<int>(std::lround(u))) =
        weights[at];
  }
}

AlignmentResult Aligner::align(const Pyramid& camera, const Pyramid& reference, const Pose& start,
                               double intensity_offset) {
  Estimate estimate{start.inverse(), intensity_offset, Matrix6d::Zero()};
  bool ok = true;
  const int levels = std::min(static_cast<int>(options_.iterations.size()), camera.size());
  for (int i = levels - 1; ok && i >= 0; --i) {
    ok = refine(camera[i], level_like(reference, camera[i]), options_.iterations[i], estimate);
  }
  AlignmentResult result;
  result.reference_from_camera = estimate.camera_from_reference.inverse();
  result.intensity_offset = estimate.intensity_offset;
  result.information = estimate.information;
  result.observability = least_ratio(estimate.information, estimate.feigned_information);
  if (ok) weigh(camera[0], level_like(reference, camera[0]), result);
  result.ok = ok && result.compared >= kLeastResiduals;
  return result;
}

}  // namespace armsreach
