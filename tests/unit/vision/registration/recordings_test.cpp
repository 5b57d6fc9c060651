// Colour cameras of real recordings, beside what is published of them.
#include "tests/support/recordings.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "devices/open.hpp"
#include "devices/sim/sim_source.hpp"
#include "vision/core/registration.hpp"
#include "vision/registration/color_camera_estimator.hpp"

namespace armsreach {
namespace {

struct Seen {
  SensorInfo sensor;
  std::vector<Frame> frames;
};

Seen frames_of(Result<std::unique_ptr<Source>> source, std::size_t count) {
  EXPECT_TRUE(source) << source.error().message();
  Seen seen;
  seen.sensor = *(*source)->sensor();
  while (seen.frames.size() < count) {
    auto frame = (*source)->next();
    EXPECT_TRUE(frame);
    if (!frame || !*frame) break;
    seen.frames.push_back(**frame);
  }
  return seen;
}

// The verdict of one that does not know the colour camera.
std::optional<RegistrationVerdict> verdict_on(const Seen& seen) {
  ColorCameraEstimator estimator(*seen.sensor.depth_camera, *seen.sensor.depth_camera);
  for (const Frame& frame : seen.frames) {
    if (auto verdict = estimator.add(frame)) return verdict;
  }
  return std::nullopt;
}

struct Misplacement {
  double rms = 0, percentile95 = 0;  // px
};

// Of all that was measured, beside where the sensor's own colour camera has it.
Misplacement misplacement(const ColorCamera& estimate, const Seen& seen) {
  std::vector<double> errors;
  double sum = 0;
  for (const Frame& frame : seen.frames) {
    for (int y = 8; y < frame.depth.rows; y += 16) {
      for (int x = 8; x < frame.depth.cols; x += 16) {
        const double z = static_cast<double>(frame.depth.at<float>(y, x));
        if (!(z > 0)) continue;
        const Eigen::Vector3d point =
            z * unproject(*seen.sensor.depth_camera, Eigen::Vector2d(x, y));
        const auto there = project(*seen.sensor.color_camera, seen.sensor.color_from_depth * point);
        const auto here = project(estimate.camera, estimate.camera_from_depth * point);
        if (!here || !there) continue;
        errors.push_back((*here - *there).norm());
        sum += errors.back() * errors.back();
      }
    }
  }
  std::sort(errors.begin(), errors.end());
  return {std::sqrt(sum / static_cast<double>(errors.size())), errors[errors.size() * 95 / 100]};
}

// Depth as a camera elsewhere would have measured it: what was registered no longer is.
Seen with_depth_from(Seen seen, const Camera& camera, const Pose& camera_from_depth) {
  for (Frame& frame : seen.frames) {
    frame.depth =
        registered_depth(frame.depth, *seen.sensor.depth_camera, camera, camera_from_depth);
  }
  seen.sensor.depth_camera = camera;
  seen.sensor.color_from_depth = seen.sensor.color_from_depth * camera_from_depth.inverse();
  return seen;
}

TEST(RegistrationRecordings, RedkitchenIsEstimatedWithinTwoPixels) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  const Seen seen = frames_of(open_source({"tum", path, {}}, {}), 60);
  const auto verdict = verdict_on(seen);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::estimated);
  EXPECT_LE(verdict->frames, 60);
  const Misplacement before = misplacement({*seen.sensor.depth_camera, {}}, seen);
  EXPECT_GT(before.rms, 15);  // 24 px
  const Misplacement after = misplacement(verdict->color, seen);
  EXPECT_LT(after.rms, 2);           // 0.9 px
  EXPECT_LT(after.percentile95, 2);  // 1.3 px
}

TEST(RegistrationRecordings, LivingroomIsRegistered) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const auto verdict = verdict_on(frames_of(open_source({"tum", path, {}}, {}), 60));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::registered);
}

TEST(RegistrationRecordings, LivingroomIsEstimatedWhenDepthIsMeasuredFromElsewhere) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const Seen registered = frames_of(open_source({"tum", path, {}}, {}), 60);
  Camera camera = *registered.sensor.depth_camera;
  camera.fx = camera.fy = 1.1 * camera.fx;
  camera.cx += 3;
  const Seen seen =
      with_depth_from(registered, camera, Pose(so3_exp({0, 0, 0.008}), {0.025, 0, 0}));
  const auto verdict = verdict_on(seen);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::estimated);
  const Misplacement after = misplacement(verdict->color, seen);
  EXPECT_LT(after.rms, 2);           // 0.6 px
  EXPECT_LT(after.percentile95, 2);  // 1.1 px
}

// Registered by its driver to within 3 px, as the estimate has it too.
TEST(RegistrationRecordings, CabinetIsRegistered) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/cabinet");
  const auto verdict = verdict_on(frames_of(open_source({"tum", path, {}}, {}), 60));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::registered);
}

TEST(RegistrationRecordings, TheSimulatedBenchIsRegistered) {
  for (const char* spec : {"sim:bench,noise=none", "sim:bench,noise=kinect"}) {
    const auto verdict =
        verdict_on(frames_of(open_source(*parse_source_spec(spec), {}, sim_source_kinds()), 60));
    ASSERT_TRUE(verdict);
    EXPECT_EQ(verdict->registration, Registration::registered) << spec;
  }
}

}  // namespace
}  // namespace armsreach
