// A camera that is lost and found again, and worlds that are entered another day, through the
// command line.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/edited_recording.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"
#include "vision/core/trajectory.hpp"

namespace armsreach::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;

// Runs every frame without drawing; `more` are further arguments.
void track(const TemporaryFolder& folder, const std::string& source,
           const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {
      "run",          "--source",       source,     "--display",       "none",
      "--trajectory", folder / "t.txt", "--events", folder / "e.jsonl"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  if (std::find(more.begin(), more.end(), "--pace") == more.end()) {
    arguments.insert(arguments.end(), {"--pace", "every-frame"});
  }
  const ProgramResult run = run_armsreach(arguments);
  ASSERT_EQ(run.exit_code, 0) << run.output;
}

std::vector<std::string> tracking_states(const TemporaryFolder& folder) {
  std::vector<std::string> states;
  std::istringstream lines(read_text(folder / "e.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    const json event = json::parse(line);
    if (event["type"] == "tracking") states.push_back(event["state"]);
  }
  return states;
}

Trajectory read_poses(const std::filesystem::path& path) {
  std::ifstream in(path);
  return *read_tum_trajectory(in, path);
}

struct Accuracy {
  double ate = 0;  // m
  double coverage = 0;
};

Accuracy accuracy(const TemporaryFolder& folder, const std::filesystem::path& truth) {
  const ProgramResult evaluated =
      run_armsreach({"evaluate", "trajectory", "--estimate", folder / "t.txt", "--truth", truth,
                     "--json", folder / "a.json"});
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.output;
  const json errors = json::parse(read_text(folder / "a.json"));
  return {errors["ate_rmse"], errors["coverage"]};
}

// Covered for a second and carried on meanwhile; what was mapped before is what it must find.
TEST(EndToEndFoundAgain, ACameraThatWasCoveredAndMoved) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  TemporaryFolder folder;
  edit_recording(path, folder / "covered", [](int frame) {
    if (frame >= 100 && frame < 130) return FrameEdit::cover;
    return frame >= 130 && frame < 160 ? FrameEdit::leave_out : FrameEdit::keep;
  });
  const Trajectory truth = read_poses(path / "groundtruth.txt");
  ASSERT_GT((truth[160].world_from_camera.translation() - truth[99].world_from_camera.translation())
                .norm(),
            0.3);
  track(folder, "tum:" + (folder / "covered").string());
  EXPECT_THAT(tracking_states(folder),
              ElementsAre("initialising", "tracking", "lost", "relocalised", "tracking"));
  const Accuracy found = accuracy(folder, path / "groundtruth.txt");
  EXPECT_LT(found.ate, 0.025);
  EXPECT_GT(found.coverage, 0.65);  // of 200 frames: 140 could be seen
}

TEST(EndToEndFoundAgain, ASessionIsEnteredFromAnotherPlaceWithItsObjects) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  TemporaryFolder folder;
  write_text(folder / "c.yaml", "actions: [{frame: 15, click: [420, 215], insert: teapot}]\n");
  const std::string session = folder / "session";
  track(folder, "tum:" + path.string(),
        {"--frames", "130", "--session", session, "--config", folder / "c.yaml"});
  const std::string objects = read_text(folder / "session" / "objects.json");
  EXPECT_THAT(objects, ::testing::HasSubstr("teapot"));

  edit_recording(path, folder / "later",
                 [](int frame) { return frame < 100 ? FrameEdit::leave_out : FrameEdit::keep; });
  track(folder, "tum:" + (folder / "later").string(), {"--session", session});
  EXPECT_THAT(tracking_states(folder), ElementsAre("lost", "relocalised", "tracking"));
  // In the first day's world, whose origin is its first camera, not in one of its own.
  const Trajectory truth = read_poses(path / "groundtruth.txt");
  const Trajectory found = read_poses(folder / "t.txt");
  ASSERT_GT(found.size(), 90U);  // of 100 frames
  const Pose expected = truth[0].world_from_camera.inverse() * *pose_at(truth, found.front().time);
  const Pose moved = expected.inverse() * found.front().world_from_camera;
  EXPECT_LT(moved.translation().norm(), 0.05);
  EXPECT_EQ(read_text(folder / "session" / "objects.json"), objects);
}

// alpha = 0: intensity alone, against the map that a depth camera left.
TEST(EndToEndFoundAgain, AColourCameraIsTrackedInASavedMap) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TemporaryFolder folder;
  track(folder, "tum:" + path.string(), {"--map", folder / "m.ot"});
  const std::string map = read_text(folder / "m.ot");
  write_text(folder / "c.yaml", "tracking: {alpha: 0}\n");
  const std::vector<std::string> colour_only = {"--map", folder / "m.ot", "--config",
                                                folder / "c.yaml"};
  std::vector<std::string> with_camera = colour_only;
  with_camera.insert(with_camera.end(), {"--camera", path / "camera.yaml"});
  track(folder, "images:" + (path / "rgb").string(), with_camera);
  const Accuracy pictures = accuracy(folder, path / "groundtruth.txt");
  EXPECT_EQ(pictures.coverage, 1.0);
  EXPECT_LT(pictures.ate, 0.02);
  EXPECT_EQ(read_text(folder / "m.ot"), map) << "a camera without depth maps nothing";
}

// A colour camera adds nothing to the map, but a person may still stand things in it.
TEST(EndToEndFoundAgain, ObjectsOfASessionThatMappedNothingAreKept) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TemporaryFolder folder;
  const std::string session = folder / "session";
  track(folder, "tum:" + path.string(), {"--frames", "30", "--session", session});
  const std::string map = read_text(folder / "session" / "map.ot");
  write_text(folder / "c.yaml",
             "tracking: {alpha: 0}\n"
             "actions: [{frame: 15, click: [440, 430], insert: cube}]\n");
  track(folder, "images:" + (path / "rgb").string(),
        {"--camera", path / "camera.yaml", "--frames", "30", "--session", session, "--config",
         folder / "c.yaml"});
  EXPECT_THAT(read_text(folder / "session" / "objects.json"), ::testing::HasSubstr("cube"));
  EXPECT_EQ(read_text(folder / "session" / "map.ot"), map);
}

// As depth cameras begin: a projector warms up, an exposure settles.
TEST(EndToEndFoundAgain, ACameraThatIsBlindAtFirstBeginsWhereItSees) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  for (const char* pace : {"every-frame", "live"}) {
    for (const int blind : {1, 10}) {
      TemporaryFolder folder;
      edit_recording(path, folder / "blind", [&](int frame) {
        return frame < blind ? FrameEdit::blind_depth : FrameEdit::keep;
      });
      track(folder, "tum:" + (folder / "blind").string(), {"--pace", pace, "--frames", "40"});
      EXPECT_THAT(tracking_states(folder), ElementsAre("initialising", "tracking"))
          << pace << blind;
      const Trajectory found = read_poses(folder / "t.txt");
      EXPECT_LE(found.size(), 40U - static_cast<std::size_t>(blind)) << "no pose while blind";
      EXPECT_GE(found.size(), 30U - static_cast<std::size_t>(blind));  // live may skip some
    }
  }
}

TEST(EndToEndFoundAgain, WhatWasNotAddedToIsNotSaved) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TemporaryFolder folder;
  track(folder, "images:" + (path / "rgb").string(), {"--frames", "5", "--map", folder / "m.ot"});
  EXPECT_FALSE(std::filesystem::exists(folder / "m.ot"));
  EXPECT_THAT(read_text(folder / "e.jsonl"), ::testing::HasSubstr("only in a map"));
  EXPECT_THAT(read_text(folder / "e.jsonl"), ::testing::HasSubstr("it is not saved"));
  EXPECT_EQ(read_text(folder / "t.txt"), "");
}

TEST(EndToEndFoundAgain, AMapThatCannotBeSavedIsToldBeforeTheRun) {
  TemporaryFolder folder;
  const std::string map = folder / "none" / "m.ot";
  const ProgramResult run =
      run_armsreach({"run", "--source", "sim:bench", "--display", "none", "--frames", "3", "--map",
                     map, "--stats", folder / "s.json"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, ::testing::HasSubstr(map + ": cannot be written"));
  EXPECT_FALSE(std::filesystem::exists(folder / "s.json")) << "it ran";
}

TEST(EndToEndFoundAgain, AMapOfAnotherPlaceIsNotBelieved) {
  ARMSREACH_RECORDING_OR_SKIP(livingroom, "rgbd/livingroom");
  ARMSREACH_RECORDING_OR_SKIP(kitchen, "rgbd/redkitchen");
  TemporaryFolder folder;
  track(folder, "tum:" + livingroom.string(), {"--frames", "30", "--session", folder / "s"});
  const std::string map = read_text(folder / "s" / "map.ot");
  track(folder, "tum:" + kitchen.string(), {"--frames", "30", "--session", folder / "s"});
  EXPECT_THAT(tracking_states(folder), ElementsAre("lost"));
  EXPECT_EQ(read_text(folder / "s" / "map.ot"), map) << "nothing may be mapped while lost";
}

}  // namespace
}  // namespace armsreach::test
