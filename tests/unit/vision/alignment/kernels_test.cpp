// The kernels of every instruction-set level, against each other and against numeric derivatives.
#include <array>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "vision/alignment/align_kernels.hpp"
#include "vision/alignment/kernel_arguments.hpp"
#include "vision/alignment/level.hpp"
#include "vision/alignment/level_kernels.hpp"
#include "vision/alignment/registration_kernels.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/pyramid_kernels.hpp"

namespace armsreach {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::vector<Isa> levels() {
  std::vector<Isa> out{Isa::baseline};
  if (best_isa() >= Isa::v3) out.push_back(Isa::v3);
  if (best_isa() >= Isa::v4) out.push_back(Isa::v4);
  return out;
}

// The same bits; NaNs may differ in theirs.
void expect_identical(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = std::memcmp(&a[i], &b[i], sizeof a[i]) == 0;
    ASSERT_TRUE(same || (std::isnan(a[i]) && std::isnan(b[i]))) << i << ": " << a[i] << " " << b[i];
  }
}

struct Warped {
  std::vector<float> data;
  Residuals residuals;
  int size;
};

Warped warped(const AlignKernels& kernels, const Level& source, const Level& target,
              const Pose& pose) {
  const int size = source.stride() * source.height();
  Warped out{std::vector<float>(9 * size), {}, size};
  float* p = out.data.data();
  const auto next = [&] { return std::exchange(p, p + size); };
  out.residuals = {next(), next(), next(), next(), next(), next(), next(), next(), next()};
  kernels.warp(planes(source), planes(target), warp_from(pose, 0), out.residuals);
  return out;
}

// A plane n . p = 1 with an intensity that is affine in the pixel of `camera`; `nearer` is added to
// its inverse depth.
Level plane_seen_from(const Camera& camera, const Pose& camera_from_plane, const Eigen::Vector3d& n,
                      double nearer = 0) {
  const Eigen::Vector3d rotated = camera_from_plane.rotation() * n;
  const Eigen::Vector3d seen = rotated / (1 + rotated.dot(camera_from_plane.translation()));
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  cv::Mat intensity(camera.height, camera.width, CV_32FC1);
  for (int row = 0; row < camera.height; ++row) {
    for (int col = 0; col < camera.width; ++col) {
      const Eigen::Vector3d ray = unproject(camera, Eigen::Vector2d(col, row));
      depth.at<float>(row, col) = static_cast<float>(1 / (seen.dot(ray) + nearer));
      intensity.at<float>(row, col) = static_cast<float>(0.3 + 0.002 * col + 0.003 * row);
    }
  }
  Level level;
  level.assign(camera, depth, intensity);
  return level;
}

Level noise(const Camera& camera, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<float> uniform(0.99F, 1.01F);
  cv::Mat depth(camera.height, camera.width, CV_32FC1);
  cv::Mat intensity(camera.height, camera.width, CV_32FC1);
  for (int row = 0; row < camera.height; ++row) {
    for (int col = 0; col < camera.width; ++col) {
      depth.at<float>(row, col) = random() % 20 == 0 ? kUnknown : 2 * uniform(random);
      intensity.at<float>(row, col) = random() % 20 == 0 ? kUnknown : 0.5F * uniform(random);
    }
  }
  Level level;
  level.assign(camera, depth, intensity);
  return level;
}

const Camera kCamera = pinhole(80, 60, 66, 66, 39.5, 29.5);
const Eigen::Vector3d kPlane(0.1, -0.15, 0.5);

Pose small_motion() {
  Vector6d tangent;
  tangent << 0.02, -0.01, 0.015, 0.01, -0.02, 0.015;
  return Pose::exp(tangent);
}

TEST(AlignKernels, ResidualsVanishAtTheTrueMotion) {
  const Pose motion = small_motion();
  const Level source = plane_seen_from(kCamera, Pose(), kPlane);
  const Level target = plane_seen_from(kCamera, motion, kPlane);
  const Warped at = warped(align_kernels(best_isa()), source, target, motion);
  int known = 0;
  for (int i = 0; i < at.size; ++i) {
    if (std::isnan(at.residuals.depth[i])) continue;
    ++known;
    EXPECT_NEAR(at.residuals.depth[i], 0, 1e-6);  // float rounding of inverse depths near 0.5
  }
  EXPECT_GT(known, 4000);
}

// On a plane, inverse depth is affine and both images' derivatives agree, so that the mean of the
// two is the derivative, also with a constant added, which makes a residual; intensity is made so
// by hand.
TEST(AlignKernels, DerivativesAgreeWithNumericOnes) {
  const Pose motion = small_motion();
  Level source = plane_seen_from(kCamera, Pose(), kPlane);
  for (std::size_t i = 0; i < source.intensity_x.size(); ++i) {
    source.intensity_x[i] = 0.002F;
    source.intensity_y[i] = 0.003F;
  }
  const Level target = plane_seen_from(kCamera, motion, kPlane, 0.01);
  const AlignKernels kernels = align_kernels(best_isa());
  constexpr double kStep = 1e-3;
  for (const int pixel : {20 * 80 + 15, 30 * 80 + 40, 45 * 80 + 60}) {
    for (const bool of_depth : {true, false}) {
      Warped at = warped(kernels, source, target, motion);
      const float residual = of_depth ? at.residuals.depth[pixel] : at.residuals.intensity[pixel];
      ASSERT_FALSE(std::isnan(residual));
      for (int i = 0; i < at.size; ++i) {
        if (i != pixel || !of_depth) at.residuals.depth[i] = kUnknown;
        if (i != pixel || of_depth) at.residuals.intensity[i] = kUnknown;
      }
      // One residual alone, with a weight of 1: the gradient over the residual is its row.
      std::array<double, kSums> sums;
      kernels.accumulate(at.residuals, at.size, {1, 1e6F}, {1, 1e6F}, sums.data());
      for (int k = 0; k < 6; ++k) {
        const double analytic = sums[kTriangle + k] / static_cast<double>(residual);
        Vector6d tangent = Vector6d::Zero();
        std::array<double, 2> moved{};
        for (const int side : {0, 1}) {
          tangent(k) = side == 0 ? -kStep : kStep;
          const Warped beside = warped(kernels, source, target, Pose::exp(tangent) * motion);
          moved[side] = static_cast<double>(of_depth ? beside.residuals.depth[pixel]
                                                     : beside.residuals.intensity[pixel]);
        }
        const double numeric = (moved[1] - moved[0]) / (2 * kStep);
        // Residuals are floats good to 6e-8, so that differences over 2 mm are good to 6e-5.
        EXPECT_NEAR(analytic, numeric, 2e-4 + 2e-3 * std::abs(numeric)) << "parameter " << k;
      }
      EXPECT_NEAR(sums[kTriangle + 6] / static_cast<double>(residual), of_depth ? 0 : -1, 1e-6);
    }
  }
}

TEST(AlignKernels, EveryLevelGivesTheSameBits) {
  const Level source = noise(kCamera, 1);
  const Level target = noise(pinhole(75, 50, 60, 61, 37, 24), 2);  // with padding
  const AlignKernels reference = align_kernels(Isa::baseline);
  const Warped expected = warped(reference, source, target, small_motion());
  const Weighting depth{2, 0.02F};
  const Weighting intensity{1, 0.03F};
  std::array<double, kSums> expected_sums;
  reference.accumulate(expected.residuals, expected.size, depth, intensity, expected_sums.data());
  std::vector<float> expected_weights(expected.size);
  reference.weigh(expected.residuals, expected.size, depth, intensity, expected_weights.data());
  EXPECT_GT(expected_sums[0], 0);
  for (const Isa isa : levels()) {
    const AlignKernels kernels = align_kernels(isa);
    const Warped found = warped(kernels, source, target, small_motion());
    expect_identical(found.data, expected.data);
    std::array<double, kSums> sums;
    kernels.accumulate(found.residuals, found.size, depth, intensity, sums.data());
    for (int k = 0; k < kSums; ++k) EXPECT_EQ(sums[k], expected_sums[k]);
    std::vector<float> weights(found.size);
    kernels.weigh(found.residuals, found.size, depth, intensity, weights.data());
    expect_identical(weights, expected_weights);
  }
}

TEST(AlignKernels, AnOccludedPixelsIntensityCountsForNothing) {
  std::array<float, 16> depth{}, intensity{}, weights{};
  depth[1] = 5;         // another surface
  depth[2] = kUnknown;  // a hole
  depth[3] = kUnknown;
  intensity[3] = kUnknown;
  const Residuals residuals{depth.data(), intensity.data(), nullptr, nullptr, nullptr,
                            nullptr,      nullptr,          nullptr, nullptr};
  align_kernels(best_isa()).weigh(residuals, 16, {1, 1}, {1, 1}, weights.data());
  EXPECT_EQ(weights[0], 1);
  EXPECT_EQ(weights[1], 0);
  EXPECT_EQ(weights[2], 1);
  EXPECT_TRUE(std::isnan(weights[3]));
}

TEST(LevelKernels, EveryLevelGivesTheSameBits) {
  const Level level = noise(kCamera, 3);
  const int size = level.stride() * level.height();
  const int half = Level::padded(40) * 30;
  std::array<std::vector<float>, 4> expected;
  for (const Isa isa : levels()) {
    const LevelKernels kernels = level_kernels(isa);
    std::array<std::vector<float>, 4> found{
        std::vector<float>(size), std::vector<float>(size), std::vector<float>(half),
        std::vector<float>(level.inverse_depth.begin(), level.inverse_depth.begin() + size)};
    kernels.differentiate(level.inverse_depth.data(), 80, 60, level.stride(), 0.01F, 0.02F, 0.005F,
                          found[0].data(), found[1].data());
    kernels.halve(level.inverse_depth.data(), level.stride(), 0.99F, 2, found[2].data(), 40, 30,
                  Level::padded(40));
    kernels.invert(found[3].data(), size);
    if (isa == Isa::baseline) expected = found;
    for (int i = 0; i < 4; ++i) expect_identical(found[i], expected[i]);
  }
}

TEST(PyramidKernels, EveryLevelGivesTheSameBits) {
  std::mt19937_64 random(4);
  std::vector<float> depth(8 * 100);
  for (float& d : depth) {
    d = random() % 7 == 0 ? kUnknown : 1 + 1e-3F * static_cast<float>(random() % 60);
  }
  std::vector<std::uint8_t> image(8 * 300);
  for (std::uint8_t& value : image) value = static_cast<std::uint8_t>(random());
  for (const int factor : {1, 2, 3, 5, 8}) {
    const int width = 100 / factor * factor;
    std::array<std::vector<float>, 2> expected;
    for (const Isa isa : levels()) {
      const PyramidKernels kernels = pyramid_kernels(isa);
      std::array<std::vector<float>, 2> found{std::vector<float>(width / factor),
                                              std::vector<float>(width / factor)};
      std::vector<float> scratch(3 * 100);
      kernels.depth_row(depth.data(), 100, width, factor, 0.01F, scratch.data(), found[0].data());
      std::vector<std::uint16_t> sums(300);
      kernels.intensity_row(image.data(), 300, width, 3, factor, sums.data(), scratch.data(),
                            found[1].data());
      if (isa == Isa::baseline) expected = found;
      for (int i = 0; i < 2; ++i) expect_identical(found[i], expected[i]);
    }
  }
}

TEST(RegistrationKernels, EveryLevelGivesTheSameBits) {
  const Level level = noise(kCamera, 5);
  std::vector<float> depth(75);
  for (int i = 0; i < 75; ++i)
    depth[i] = i % 11 == 0 ? kUnknown : 1 + 0.01F * static_cast<float>(i);
  const RegistrationImage image{level.intensity.data(), 80, 60, level.stride(), 60, 60, 39, 29};
  RegistrationRow row{depth.data(), 75, -0.6F, 0.016F, 0.1F, {}, {-0.02F, 0, 0}};
  for (int i = 0; i < 3; ++i) row.rotation[i][i] = 1;
  std::vector<float> expected;
  for (const Isa isa : levels()) {
    std::vector<float> found(75);
    registration_kernels(isa).look_up_row(row, image, found.data());
    if (isa == Isa::baseline) expected = found;
    expect_identical(found, expected);
  }
}

}  // namespace
}  // namespace armsreach
