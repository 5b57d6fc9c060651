// Colour cameras of real recordings, beside the ones they come with.
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

// The verdict of one that does not know the colour camera, from frame `first` on.
std::optional<RegistrationVerdict> verdict_on(const Seen& seen, std::size_t first = 0) {
  ColorCameraEstimator estimator(*seen.sensor.depth_camera, *seen.sensor.depth_camera);
  for (std::size_t i = first; i < seen.frames.size(); ++i) {
    if (auto verdict = estimator.add(seen.frames[i])) return verdict;
  }
  return std::nullopt;
}

constexpr std::size_t kFitted = 60;  // frames that a verdict takes at most

struct Misplacement {
  double rms = 0, percentile95 = 0;  // px
};

// Of all that was measured in frames other than those fitted, which begin at `first`, beside where
// the sensor's own colour camera has it.
Misplacement misplacement(const ColorCamera& estimate, const Seen& seen, std::size_t first = 0) {
  std::vector<double> errors;
  double sum = 0;
  for (std::size_t i = 0; i < seen.frames.size(); ++i) {
    if (i >= first && i < first + kFitted) continue;
    const Frame& frame = seen.frames[i];
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

// px rms: the same of a scene that is all at a depth of `z` (m), where the colour image shows it.
double misplacement_at(double z, const ColorCamera& estimate, const SensorInfo& sensor) {
  const Camera& depth = *sensor.depth_camera;
  const cv::Rect2d shown(0, 0, depth.width, depth.height);
  double sum = 0;
  int count = 0;
  for (int y = 20; y < depth.height; y += 40) {
    for (int x = 20; x < depth.width; x += 40) {
      const Eigen::Vector3d point = z * unproject(depth, Eigen::Vector2d(x, y));
      const auto there = project(*sensor.color_camera, sensor.color_from_depth * point);
      const auto here = project(estimate.camera, estimate.camera_from_depth * point);
      if (!here || !there || !shown.contains({there->x(), there->y()})) continue;
      sum += (*here - *there).squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// From arm's length to across a room, whatever depths the contours were at.
double worst_misplacement(const ColorCamera& estimate, const SensorInfo& sensor) {
  double worst = 0;
  for (const double z : {0.5, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0}) {
    worst = std::max(worst, misplacement_at(z, estimate, sensor));
  }
  return worst;
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

// The recording's own calibration is itself from depth borders and colour edges, of all its frames;
// it is good to about a pixel.
TEST(RegistrationRecordings, RedkitchenIsEstimatedWithinTwoPixelsAtAnyDepth) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  const Seen seen = frames_of(open_source({"tum", path, {}}, {}), 200);
  const Misplacement before = misplacement({*seen.sensor.depth_camera, {}}, seen);
  EXPECT_GT(before.rms, 15);  // 25 px
  for (const std::size_t first : {0U, 70U, 140U}) {
    const auto verdict = verdict_on(seen, first);
    ASSERT_TRUE(verdict) << first;
    EXPECT_EQ(verdict->registration, Registration::estimated) << first;
    EXPECT_LE(verdict->frames, kFitted);
    const Misplacement after = misplacement(verdict->color, seen, first);
    EXPECT_LT(after.rms, 2) << first;                                        // 0.5 to 1.2 px
    EXPECT_LT(after.percentile95, 2) << first;                               // 0.8 to 1.3 px
    EXPECT_LT(worst_misplacement(verdict->color, seen.sensor), 2) << first;  // 0.6 to 1.3 px
  }
}

TEST(RegistrationRecordings, LivingroomIsRegistered) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const auto verdict = verdict_on(frames_of(open_source({"tum", path, {}}, {}), 60));
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::registered);
}

// Livingroom with its depth measured from `baseline` metres beside, through another lens.
Seen livingroom_from_beside(const Seen& registered, double baseline) {
  Camera camera = *registered.sensor.depth_camera;
  camera.fx = camera.fy = 1.1 * camera.fx;
  camera.cx += 3;
  return with_depth_from(registered, camera, Pose(so3_exp({0, 0, 0.008}), {baseline, 0, 0}));
}

TEST(RegistrationRecordings, LivingroomIsEstimatedWhenDepthIsMeasuredFromElsewhere) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const Seen seen =
      livingroom_from_beside(frames_of(open_source({"tum", path, {}}, {}), 100), 0.025);
  const auto verdict = verdict_on(seen);
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->registration, Registration::estimated);
  const Misplacement after = misplacement(verdict->color, seen);
  EXPECT_LT(after.rms, 2);                                        // 0.2 px
  EXPECT_LT(after.percentile95, 2);                               // 0.3 px
  EXPECT_LT(worst_misplacement(verdict->color, seen.sensor), 2);  // 1.3 px, at 0.5 m
}

// Contours at 1.3 to 1.9 m do not tell such baselines from the usual one. They are right where
// there are contours, and elsewhere within what is said of them.
TEST(RegistrationRecordings, AnUnusualBaselineIsWithinTheUncertainty) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const Seen registered = frames_of(open_source({"tum", path, {}}, {}), kFitted);
  for (const double baseline : {0.015, 0.032, -0.02}) {
    const Seen seen = livingroom_from_beside(registered, baseline);
    const auto verdict = verdict_on(seen);
    ASSERT_TRUE(verdict);
    EXPECT_EQ(verdict->registration, Registration::estimated);
    EXPECT_LT(misplacement_at(1.5, verdict->color, seen.sensor), 1) << baseline;  // 0.3 px
    EXPECT_GT(verdict->search.uncertainty_at[0], 2);
    for (std::size_t i = 0; i < kUncertaintyDepths.size(); ++i) {
      const double off = misplacement_at(kUncertaintyDepths[i], verdict->color, seen.sensor);
      // 1.4, 2.1 and 1.4 standard deviations at 0.5 m.
      EXPECT_LT(off, 2.5 * verdict->search.uncertainty_at[i])
          << baseline << " m, at " << kUncertaintyDepths[i] << " m";
    }
  }
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
