// The MonoSLAM desk sequence: started on its target, and then without it.
#include <algorithm>
#include <numeric>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"
#include "tests/unit/vision/mono_slam/mono_recording.hpp"
#include "vision/mono_slam/search.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using test::MonoRecording;
using test::quantile;
using test::Summary;

MonoSlamOptions options_for(const MonoRecording& desk, std::uint64_t seed) {
  MonoSlamOptions options;
  options.target = desk.target;
  options.seed = seed;
  return options;
}

int mapped(const MonoResult& result) {
  int count = 0;
  for (const MapPoint& point : result.points) {
    if (point.kind == PointKind::position && !point.of_target) ++count;
  }
  return count;
}

void expect_whole(const Summary& summary) {
  EXPECT_EQ(summary.lost, 0);
  EXPECT_LT(quantile(summary.innovations, 0.5), 0.4);
  EXPECT_LT(quantile(summary.innovations, 0.9), 1.2);
  EXPECT_LT(quantile(summary.residuals, 0.5), 0.2);
  // The map is full after two seconds.
  for (std::size_t i = 60; i < summary.results.size(); ++i) {
    EXPECT_GE(summary.results[i].visible, 30) << i;
    EXPECT_EQ(summary.results[i].state, TrackingState::tracking) << i;
  }
  EXPECT_GE(mapped(summary.results.back()), 25);
}

TEST(Desk, IsTrackedFromItsTarget) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Summary summary = test::run(desk, options_for(desk, seed));
    ASSERT_EQ(summary.results[0].state, TrackingState::tracking);
    EXPECT_EQ(summary.results[0].scale, ScaleFrom::target);
    expect_whole(summary);
  }
}

TEST(Desk, IsTrackedWithParticlesToo) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  MonoSlamOptions options = options_for(desk, 1);
  options.new_points = NewPoints::particles;
  const Summary summary = test::run(desk, options);
  EXPECT_EQ(summary.lost, 0);
  EXPECT_GE(mapped(summary.results.back()), 25);
}

// How far the target's corners are from where the pose says, measured by their own patches.
std::vector<double> corner_errors(const MonoRecording& desk, const Summary& summary,
                                  std::size_t first) {
  std::vector<Patch> corners;
  std::vector<double> errors;
  const Pose start = summary.results[0].world_from_camera;
  for (const StartTarget::Mark& mark : desk.target->marks) {
    const Vector2d pixel = *project(desk.camera, start.inverse() * mark.point_in_world);
    corners.push_back(patch_at(desk.frames[0], pixel, 15, desk.camera, start));
    corners.back().normal_in_world = -Eigen::Vector3d::UnitZ();
  }
  for (std::size_t i = first; i < summary.results.size(); ++i) {
    SearchImage image;
    image.set(desk.frames[i]);
    const Pose& pose = summary.results[i].world_from_camera;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector3d& point = desk.target->marks[k].point_in_world;
      const auto expected = project(desk.camera, pose.inverse() * point);
      if (!expected) continue;
      const Template pattern = warped(corners[k], warp(corners[k], point, desk.camera, pose));
      const auto match = search_exhaustively(
          image, pattern, square(*expected - pattern.pixel_from_centre, 12), 0.85);
      if (match) errors.push_back((match->pixel - *expected).norm());
    }
  }
  return errors;
}

TEST(Desk, IsTrackedWithoutItsTarget) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    MonoSlamOptions options = options_for(desk, seed);
    options.forget_start_target_at = 60;
    const Summary summary = test::run(desk, options);
    EXPECT_EQ(summary.lost, 0);
    for (const MapPoint& point : summary.results[60].points) EXPECT_FALSE(point.of_target);
    const auto errors = corner_errors(desk, summary, 60);
    // All four are in view nearly all the time.
    ASSERT_GT(errors.size(), 900U);
    EXPECT_LT(
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size()),
        1.2);
    EXPECT_LT(quantile(errors, 0.95), 3.0);
  }
}

TEST(Desk, EverySecondFrameIsEnough) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Summary summary = test::run(desk, options_for(desk, seed),
                                      [](std::size_t frame, MonoInput*) { return frame % 2 == 0; });
    EXPECT_EQ(summary.lost, 0);
    EXPECT_EQ(summary.estimate.size(), summary.results.size());
  }
}

// Six frames are missing and nobody says so: the camera has jumped.
TEST(Desk, SurvivesAJerk) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  MonoRecording desk = test::read_desk(folder);
  for (const std::ptrdiff_t at : {100, 150, 200, 250}) {
    desk.frames.erase(desk.frames.begin() + at, desk.frames.begin() + at + 6);
  }
  EXPECT_EQ(test::run(desk, options_for(desk, 1)).lost, 0);
}

TEST(Desk, CoveredForASecondItSaysLostAndComesBack) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Summary summary =
        test::run(desk, options_for(desk, seed), [](std::size_t frame, MonoInput* input) {
          if (frame >= 150 && frame < 180) input->grey = cv::Mat::zeros(240, 320, CV_8UC1);
          return true;
        });
    EXPECT_EQ(summary.results[165].state, TrackingState::lost);
    const auto found =
        std::find_if(summary.results.begin() + 150, summary.results.end(),
                     [](const MonoResult& r) { return r.state == TrackingState::relocalised; });
    ASSERT_NE(found, summary.results.end());
    EXPECT_LT(found - summary.results.begin(), 190);
    const auto errors = corner_errors(desk, summary, 190);
    EXPECT_LT(quantile(errors, 0.95), 2.0);
  }
}

// The map of the first half is saved and entered again in its middle.
TEST(Desk, ASavedMapIsEnteredAgain) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const MonoRecording desk = test::read_desk(folder);
  MonoSlam first(desk.camera, options_for(desk, 1));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < 160; ++i) {
    MonoInput input;
    input.time = desk.time(i);
    input.grey = desk.frames[i];
    poses.push_back(first.step(input).world_from_camera);
  }
  std::stringstream file;
  write_sparse_map(file, first.map());
  const auto map = read_sparse_map(file, "map");
  ASSERT_TRUE(map) << map.error().message();

  MonoSlam again(desk.camera, MonoSlamOptions());
  again.enter(*map);
  int entered = -1;
  for (std::size_t i = 60; i < 160; ++i) {
    MonoInput input;
    input.time = desk.time(i);
    input.grey = desk.frames[i];
    const MonoResult result = again.step(input);
    EXPECT_EQ(result.scale, ScaleFrom::map);
    if (result.state == TrackingState::relocalised && entered < 0) entered = static_cast<int>(i);
    if (entered < 0 || static_cast<int>(i) <= entered) continue;
    EXPECT_EQ(result.state, TrackingState::tracking) << i;
    // In the same world: both sessions agree on where the camera is.
    const Pose apart = poses[i].inverse() * result.world_from_camera;
    // A shift to the side and a turn look nearly alike, so both differ by some centimetres.
    EXPECT_LT(apart.translation().norm(), 0.05) << i;
  }
  EXPECT_GE(entered, 60);
  EXPECT_LE(entered, 90);
}

TEST(Desk, TheSameSeedGivesTheSameBits) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  MonoRecording desk = test::read_desk(folder);
  desk.frames.resize(100);
  const Summary one = test::run(desk, options_for(desk, 3));
  const Summary two = test::run(desk, options_for(desk, 3));
  const Summary other = test::run(desk, options_for(desk, 4));
  EXPECT_EQ(one.estimate.back().world_from_camera.matrix(),
            two.estimate.back().world_from_camera.matrix());
  EXPECT_NE(one.estimate.back().world_from_camera.matrix(),
            other.estimate.back().world_from_camera.matrix());
}

// Without target and depth the scale is somebody's word, and the result says so.
TEST(Desk, StartsAtAStatedScale) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  MonoRecording desk = test::read_desk(folder);
  MonoSlamOptions options;
  options.stated_distance = 0.8;
  const Summary summary = test::run(desk, options);
  EXPECT_EQ(summary.lost, 0);
  EXPECT_EQ(summary.results.back().scale, ScaleFrom::stated);
  // The same path as from the target, up to a scale that is right to a factor of two.
  const Summary known = test::run(desk, options_for(desk, 1));
  const auto errors = trajectory_errors(summary.estimate, known.estimate, true);
  ASSERT_TRUE(errors);
  EXPECT_LT(errors->ate_rmse, 0.05);
  EXPECT_GT(errors->alignment.scale, 0.5);
  EXPECT_LT(errors->alignment.scale, 2.0);
}

}  // namespace
}  // namespace armsreach::mono_slam
