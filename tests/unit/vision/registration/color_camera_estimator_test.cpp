#include "vision/registration/color_camera_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"

namespace armsreach {
namespace {

const Camera kDepth = *test::synthetic_sensor()->depth_camera;

// A colour camera as beside a structured-light sensor: wider, to the right, slightly turned.
ColorCamera beside() {
  ColorCamera color{kDepth, Pose(so3_exp({0, 0, 0.006}), {-0.025, 0.0005, 0})};
  color.camera.fx = color.camera.fy = 0.9 * kDepth.fx;
  color.camera.cx += 3;
  color.camera.cy -= 2;
  return color;
}

// A hand-held sweep over the furniture.
Pose world_from_depth(int view) {
  const double t = 0.3 * view;
  return Pose(so3_exp({0.05 * std::sin(0.9 * t) - 0.1, 0.25 * std::sin(t), 0.03 * std::cos(t)}),
              {0.3 * std::sin(0.7 * t), 0.1 * std::cos(t) - 0.2, 0.3 * std::sin(0.5 * t)});
}

Frame seen(const test::SyntheticRoom& room, const ColorCamera& color, int view) {
  auto depth_sensor = std::make_shared<SensorInfo>(*test::synthetic_sensor());
  auto color_sensor = std::make_shared<SensorInfo>(*depth_sensor);
  color_sensor->depth_camera = color.camera;  // which the room draws through
  Frame frame = *room.frame(depth_sensor, world_from_depth(view), view);
  frame.color =
      room.frame(color_sensor, world_from_depth(view) * color.camera_from_depth.inverse(), view)
          ->color;
  return frame;
}

test::SyntheticRoom noisy_room() {
  test::SyntheticRoom room;
  room.depth_noise = 1.4e-3;  // 1/m, a Kinect's
  room.intensity_noise = 0.01;
  return room;
}

RegistrationOptions every_frame() {
  RegistrationOptions options;
  options.stride = 1;
  return options;
}

RegistrationVerdict verdict_on(const test::SyntheticRoom& room, const ColorCamera& color) {
  ColorCameraEstimator estimator(kDepth, kDepth, every_frame());
  for (int view = 0;; ++view) {
    if (const auto verdict = estimator.add(seen(room, color, view))) return *verdict;
  }
}

// px: where `estimate` puts what is at 0.6 to 3 m all over the depth image, beside the truth; rms.
double misplacement(const ColorCamera& estimate, const ColorCamera& truth) {
  double sum = 0;
  int count = 0;
  for (int y = 20; y < kDepth.height; y += 40) {
    for (int x = 20; x < kDepth.width; x += 40) {
      for (const double z : {0.6, 1.2, 3.0}) {
        const Eigen::Vector3d point = z * unproject(kDepth, Eigen::Vector2d(x, y));
        const auto there = project(truth.camera, truth.camera_from_depth * point);
        const auto here = project(estimate.camera, estimate.camera_from_depth * point);
        sum += (*here - *there).squaredNorm();
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

TEST(ColorCameraEstimator, FindsAColorCameraBesideTheDepthCamera) {
  const RegistrationVerdict verdict = verdict_on(noisy_room(), beside());
  EXPECT_EQ(verdict.registration, Registration::estimated);
  EXPECT_EQ(verdict.frames, 20);
  EXPECT_GT(misplacement({kDepth, {}}, beside()), 15);  // of taking them as registered
  EXPECT_LT(misplacement(verdict.color, beside()), 2);
  EXPECT_LT(verdict.search.uncertainty, 2);
  EXPECT_GT(verdict.search.displacement, 15);
}

double baseline(const ColorCamera& color) { return -color.camera_from_depth.translation().x(); }

// A baseline that is none of the usual ones, seen at 0.5 to 1 m as well as further off.
TEST(ColorCameraEstimator, NearThingsTellTheBaseline) {
  ColorCamera close_by = beside();
  close_by.camera_from_depth = Pose(so3_exp({0, 0, 0.006}), {-0.015, 0, 0});
  const RegistrationVerdict far_only = verdict_on(noisy_room(), close_by);
  test::SyntheticRoom room = noisy_room();
  room.furniture.push_back({{-0.25, -0.3, 0.85}, {-0.12, -0.15, 0.95}});
  room.furniture.push_back({{0.1, -0.2, 0.75}, {0.2, 0.1, 0.85}});
  const RegistrationVerdict near_too = verdict_on(room, close_by);
  ASSERT_EQ(far_only.registration, Registration::estimated);
  ASSERT_EQ(near_too.registration, Registration::estimated);
  EXPECT_GT(far_only.search.nearest, 1.2);
  EXPECT_LT(near_too.search.nearest, 0.6);
  EXPECT_GT(far_only.search.uncertainty_at[0], 2);                    // 2.4 px: 21.5 mm
  EXPECT_LT(near_too.search.uncertainty_at[0], 1);                    // 0.3 px
  EXPECT_NEAR(baseline(near_too.color), baseline(close_by), 0.0015);  // 15.3 mm
}

TEST(ColorCameraEstimator, RecognisesRegisteredImages) {
  const RegistrationVerdict verdict = verdict_on(noisy_room(), {kDepth, {}});
  EXPECT_EQ(verdict.registration, Registration::registered);
  EXPECT_LT(misplacement(verdict.color, {kDepth, {}}), 2);
}

TEST(ColorCameraEstimator, CannotTellWithoutColorEdges) {
  test::SyntheticRoom room = noisy_room();
  room.textured = false;
  EXPECT_EQ(verdict_on(room, beside()).registration, Registration::cannot_tell);
}

TEST(ColorCameraEstimator, CannotTellWithoutContours) {
  test::SyntheticRoom room = noisy_room();
  room.furniture.clear();
  EXPECT_EQ(verdict_on(room, beside()).registration, Registration::cannot_tell);
}

TEST(ColorCameraEstimator, CannotTellWhenDepthAndColorAreOfDifferentPlaces) {
  ColorCameraEstimator estimator(kDepth, kDepth, every_frame());
  std::optional<RegistrationVerdict> verdict;
  for (int view = 0; !verdict; ++view) {
    Frame frame = seen(noisy_room(), beside(), view);
    frame.color = seen(noisy_room(), beside(), view + 37).color;
    verdict = estimator.add(frame);
  }
  EXPECT_EQ(verdict->registration, Registration::cannot_tell);
}

TEST(ColorCameraEstimator, SaysOnceThatItCannotTellAndGoesOn) {
  ColorCameraEstimator estimator(kDepth, kDepth, every_frame());
  test::SyntheticRoom bare = noisy_room();
  bare.furniture.clear();
  std::vector<Registration> said;
  for (int view = 0; view < 80; ++view) {
    const bool at_the_wall = view < 30;
    const auto verdict = estimator.add(seen(at_the_wall ? bare : noisy_room(), beside(), view));
    if (verdict) said.push_back(verdict->registration);
    if (estimator.done()) break;
  }
  EXPECT_EQ(said, (std::vector{Registration::cannot_tell, Registration::estimated}));
  EXPECT_FALSE(estimator.add(seen(noisy_room(), beside(), 80)));
}

TEST(ColorCameraEstimator, PassesOverImagesOfOtherSizes) {
  ColorCameraEstimator estimator(kDepth, kDepth, every_frame());
  Frame frame = seen(noisy_room(), beside(), 0);
  frame.color = frame.color.colRange(0, 320).clone();
  std::optional<RegistrationVerdict> verdict;
  for (int view = 0; !verdict; ++view) verdict = estimator.add(frame);
  EXPECT_EQ(verdict->registration, Registration::cannot_tell);
  EXPECT_FALSE(estimator.add(Frame()));
}

}  // namespace
}  // namespace armsreach
