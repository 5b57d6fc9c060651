#include "vision/alignment/aligner.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"
#include "vision/alignment/frame_reducer.hpp"

namespace armsreach {
namespace {

using test::SyntheticRoom;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Looking down at the table, with the cupboard at the right.
const Pose kStart(so3_exp({-0.25, 0.1, 0}), Eigen::Vector3d(0, -0.5, 0.3));

Pose motion() {
  Vector6d tangent;
  tangent << 0.012, -0.008, 0.01, 0.006, 0.01, -0.005;
  return Pose::exp(tangent);
}

struct View {
  Camera camera;
  cv::Mat depth, intensity;
  Pyramid pyramid(int levels) const {
    Pyramid out;
    out.assign(camera, depth, intensity, levels);
    return out;
  }
};

View view(const SyntheticRoom& room, const Pose& world_from_camera, int width = 80,
          std::int64_t index = 0) {
  const FramePtr frame = room.frame(test::synthetic_sensor(), world_from_camera, index);
  const FrameReducer reducer(frame->sensor, width);
  ReducedFrame reduced = reducer.reduce(*frame);
  return {reducer.camera(), reduced.depth, reduced.intensity};
}

struct Error {
  double metres, radians;
};
Error error(const Pose& found, const Pose& truth) {
  const Vector6d difference = (truth.inverse() * found).log();
  return {difference.head<3>().norm(), difference.tail<3>().norm()};
}

AlignmentResult aligned(const View& camera, const View& reference, double alpha,
                        std::vector<int> iterations = {10, 5}) {
  const int levels = static_cast<int>(iterations.size());
  Aligner aligner({.alpha = alpha, .iterations = std::move(iterations)});
  return aligner.align(camera.pyramid(levels), reference.pyramid(levels), Pose());
}

TEST(Aligner, FindsTheMotionFromDepthIntensityOrBoth) {
  const SyntheticRoom room;
  for (const int width : {80, 160}) {
    const View reference = view(room, kStart, width);
    const View camera = view(room, kStart * motion(), width);
    for (const double alpha : {0.0, 0.5, 0.95, 1.0}) {
      const AlignmentResult result = aligned(camera, reference, alpha, {15, 5, 5});
      ASSERT_TRUE(result.ok);
      const Error off = error(result.reference_from_camera, motion());
      // Depth is exact but for the pixels beside edges, which average over part of their block;
      // linear interpolation of waves of 9 pixels (at 80) is off by up to a twentieth of a pixel.
      const double pixel = 80.0 / width;
      EXPECT_LT(off.metres, (alpha == 0 ? 1.2e-3 : 2e-4) * pixel) << width << ", alpha " << alpha;
      EXPECT_LT(off.radians, (alpha == 0 ? 5e-4 : 2e-4) * pixel) << width << ", alpha " << alpha;
      if (width == 160 && alpha == 0.95) {
        EXPECT_LT(off.metres, 1e-4);
      }
      EXPECT_GT(result.inliers, 0.8 * result.compared);
      EXPECT_GT(result.observability, 1.5);
    }
  }
}

TEST(Aligner, FindsTheIntensityOffset) {
  const SyntheticRoom room;
  SyntheticRoom brighter;
  brighter.brightness = 0.08;
  const View reference = view(room, kStart);
  const View camera = view(brighter, kStart * motion());
  for (const double alpha : {0.0, 0.95}) {
    const AlignmentResult result = aligned(camera, reference, alpha);
    EXPECT_NEAR(result.intensity_offset, 0.08, 0.002) << alpha;  // half a grey level
    EXPECT_LT(error(result.reference_from_camera, motion()).metres, 1.2e-3) << alpha;
  }
}

TEST(Aligner, BearsHoles) {
  const SyntheticRoom room;
  View reference = view(room, kStart);
  View camera = view(room, kStart * motion());
  reference.depth(cv::Rect(10, 10, 12, 12)).setTo(kUnknown);
  reference.intensity(cv::Rect(50, 5, 9, 20)).setTo(kUnknown);
  camera.depth(cv::Rect(40, 20, 15, 25)).setTo(kUnknown);
  camera.intensity(cv::Rect(0, 30, 20, 20)).setTo(kUnknown);
  const AlignmentResult result = aligned(camera, reference, 0.95);
  EXPECT_LT(error(result.reference_from_camera, motion()).metres, 3e-4);
}

TEST(Aligner, WeighsOutWhatTheReferenceDoesNotHave) {
  const SyntheticRoom room;
  SyntheticRoom visited;
  visited.furniture.push_back({{-0.35, -0.45, 1.0}, {-0.1, -0.2, 1.1}});
  const View reference = view(room, kStart);
  const View camera = view(visited, kStart * motion());
  const View without = view(room, kStart * motion());
  const AlignmentResult result = aligned(camera, reference, 0.95);
  EXPECT_LT(error(result.reference_from_camera, motion()).metres, 3e-4);
  int visitor = 0, visitor_left = 0, rest = 0, rest_left = 0;
  for (int row = 0; row < 60; ++row) {
    for (int col = 0; col < 80; ++col) {
      const float weight = result.weights.at<float>(row, col);
      if (!(weight >= 0)) continue;
      const bool other =
          std::abs(camera.depth.at<float>(row, col) - without.depth.at<float>(row, col)) > 0.05F;
      ++(other ? visitor : rest);
      if (weight > 0) ++(other ? visitor_left : rest_left);
    }
  }
  ASSERT_GT(visitor, 100);
  EXPECT_LT(visitor_left, 0.05 * visitor);  // blocks on its outline
  EXPECT_GT(rest_left, 0.9 * rest);
}

TEST(Aligner, TracksACameraWithoutDepthAgainstAViewThatHasIt) {
  const SyntheticRoom room;
  const View reference = view(room, kStart);
  View camera = view(room, kStart * motion());
  camera.depth.release();
  for (const double alpha : {0.0, 0.95}) {
    const AlignmentResult result = aligned(camera, reference, alpha);
    ASSERT_TRUE(result.ok);
    EXPECT_LT(error(result.reference_from_camera, motion()).metres, 1.2e-3) << alpha;
    EXPECT_EQ(result.weights.size(), camera.intensity.size());
    EXPECT_GT(result.inliers, 3000);
  }
}

TEST(Aligner, TheReferenceMayBeOfAnotherCamera) {
  const SyntheticRoom room;
  auto wide = std::make_shared<SensorInfo>(*test::synthetic_sensor());
  wide->depth_camera = wide->color_camera = pinhole(720, 560, 480, 470, 350, 290);
  const FramePtr frame = room.frame(wide, kStart);
  const FrameReducer reducer(wide, 80);
  const ReducedFrame reduced = reducer.reduce(*frame);
  const View reference{reducer.camera(), reduced.depth, reduced.intensity};
  for (const int width : {80, 160}) {
    const View camera = view(room, kStart * motion(), width);
    const AlignmentResult result = aligned(camera, reference, 0.95);
    // Blocks of different pixels beside every edge: 4.4 mm at 80, 0.6 mm at 160.
    EXPECT_LT(error(result.reference_from_camera, motion()).metres, width == 80 ? 6e-3 : 1e-3);
  }
}

TEST(Aligner, IsDeterministicAndKeepsNothingBetweenCalls) {
  SyntheticRoom room;
  room.depth_noise = 1.4e-3;
  const Pyramid reference = view(room, kStart).pyramid(2);
  const Pyramid camera = view(room, kStart * motion(), 80, 1).pyramid(2);
  const Pyramid other = view(room, kStart * motion() * motion(), 160, 2).pyramid(2);
  Aligner aligner;
  const Eigen::Matrix4d first =
      aligner.align(camera, reference, Pose()).reference_from_camera.matrix();
  aligner.align(other, reference, Pose());
  EXPECT_EQ(aligner.align(camera, reference, Pose()).reference_from_camera.matrix(), first);
  Aligner portable({}, Isa::baseline);
  EXPECT_EQ(portable.align(camera, reference, Pose()).reference_from_camera.matrix(), first);
}

TEST(Aligner, SaysWhenThereIsNothingToCompare) {
  const SyntheticRoom room;
  const View reference = view(room, kStart);
  View blind = reference;
  blind.depth = cv::Mat(60, 80, CV_32FC1, cv::Scalar(kUnknown));
  blind.intensity = blind.depth.clone();
  EXPECT_FALSE(aligned(blind, reference, 0.95).ok);
  EXPECT_FALSE(aligned(reference, blind, 0.95).ok);
}

TEST(Aligner, ABlankWallIsNotObservable) {
  SyntheticRoom room;
  room.furniture.clear();
  room.textured = false;
  room.intensity_noise = 0.01;
  const Pose close(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 2.3));
  for (const double noise : {1.4e-3, 8e-3}) {
    room.depth_noise = noise;
    const View reference = view(room, close);
    const View camera = view(room, close * motion(), 80, 1);
    for (const double alpha : {0.0, 0.95, 1.0}) {
      EXPECT_LT(aligned(camera, reference, alpha).observability, 1) << noise << " " << alpha;
    }
  }
}

}  // namespace
}  // namespace armsreach
