// A plain camera that knows where it is, through the command line: from a start target, from one
// frame of depth, covered, and entered again another day.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/edited_recording.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kMono = "tracking: {method: mono}\n";

struct MonoRun {
  json stats;
  std::vector<json> events;
  std::string trajectory;

  std::vector<std::string> states() const {
    std::vector<std::string> all;
    for (const json& event : events) {
      if (event["type"] == "tracking") all.push_back(event["state"]);
    }
    return all;
  }
};

MonoRun track(const TemporaryFolder& folder, const std::string& source, const std::string& config,
              const std::vector<std::string>& more = {}) {
  write_text(folder / "config.yaml", config);
  std::vector<std::string> arguments{"run",
                                     "--source",
                                     source,
                                     "--experience",
                                     "wearable",
                                     "--pace",
                                     "every-frame",
                                     "--display",
                                     "none",
                                     "--stats",
                                     folder / "s.json",
                                     "--events",
                                     folder / "e.jsonl",
                                     "--trajectory",
                                     folder / "t.txt",
                                     "--config",
                                     folder / "config.yaml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult run = run_armsreach(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  MonoRun out;
  if (run.exit_code != 0) return out;
  out.stats = json::parse(read_text(folder / "s.json"));
  out.trajectory = read_text(folder / "t.txt");
  std::istringstream lines(read_text(folder / "e.jsonl"));
  for (std::string line; std::getline(lines, line);) out.events.push_back(json::parse(line));
  return out;
}

bool has_fault(const MonoRun& run, const std::string& text) {
  return std::any_of(run.events.begin(), run.events.end(), [&](const json& event) {
    return event["type"] == "fault" &&
           event["message"].get<std::string>().find(text) != std::string::npos;
  });
}

// The desk's frames from `begin` to `end`, black from `cover` for a second, with or without its
// target.
fs::path part_of_desk(const fs::path& desk, const fs::path& folder, int begin, int end, int cover,
                      bool with_target) {
  fs::create_directories(folder / "frames");
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(desk / "frames")) frames.push_back(entry.path());
  std::sort(frames.begin(), frames.end());
  for (int i = begin; i < end; ++i) {
    const fs::path& frame = frames[static_cast<std::size_t>(i)];
    if (cover >= 0 && i >= cover && i < cover + 30) {
      const cv::Mat image = cv::imread(frame, cv::IMREAD_GRAYSCALE);
      cv::imwrite(folder / "frames" / frame.filename(),
                  cv::Mat(image.size(), CV_8UC1, cv::Scalar(4)));
    } else {
      fs::create_symlink(frame, folder / "frames" / frame.filename());
    }
  }
  for (const auto& entry : fs::directory_iterator(desk)) {
    const bool of_target = entry.path().filename() != "camera.yaml";
    if (entry.is_regular_file() && (with_target || !of_target))
      fs::create_symlink(entry.path(), folder / entry.path().filename());
  }
  return folder;
}

TEST(EndToEndMono, TheDeskIsTrackedFromItsTarget) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  const MonoRun run = track(folder, "images:" + desk.string(), "");
  EXPECT_THAT(run.states(), ElementsAre("tracking"));
  EXPECT_EQ(run.stats["tracked_frames"], 320);
  const json& mono = run.stats["mono_slam"];
  EXPECT_EQ(mono["scale"], "target");
  EXPECT_LT(mono["innovation_px"]["median"], 0.7);
  EXPECT_LT(mono["innovation_px"]["p90"], 1.6);
  EXPECT_LT(mono["residual_px"]["median"], 0.3);
  EXPECT_GE(mono["mapped"]["last"], 25);
  EXPECT_GT(mono["p_trace"], 0);
  EXPECT_FALSE(has_fault(run, "scale"));
}

// The desk's target is in none of the simulated worlds.
TEST(EndToEndMono, NothingStartsOnATargetThatIsNotThere) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  for (const char* world : {"bench", "kitchen-table", "near", "packaging", "assembly"}) {
    const MonoRun run = track(
        folder, std::string("sim:") + world + ",frames=20,seed=1",
        std::string(kMono) + "mono_slam: {target: " + (desk / "target.yaml").string() + "}\n");
    EXPECT_EQ(run.stats["tracked_frames"], 0) << world;
  }
}

// Against the simulator's truth, up to a similarity: a depth frame gives the scale.
TEST(EndToEndMono, OnTheBenchItIsRightToACentimetre) {
  const TemporaryFolder folder;
  const std::string bench = "sim:bench,frames=90,seed=1";
  const MonoRun run = track(folder, bench, kMono);
  EXPECT_EQ(run.stats["tracked_frames"], 90);
  EXPECT_EQ(run.stats["mono_slam"]["scale"], "depth");
  ASSERT_EQ(run_armsreach({"record", "--source", bench, "--out", folder / "truth"}).exit_code, 0);
  const ProgramResult evaluated =
      run_armsreach({"evaluate", "trajectory", "--estimate", folder / "t.txt", "--truth",
                     folder / "truth/groundtruth.txt", "--scale", "--json", folder / "a.json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.output;
  EXPECT_LT(json::parse(read_text(folder / "a.json"))["ate_rmse"], 0.01);
}

TEST(EndToEndMono, TheTargetMayBeForgotten) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  const MonoRun run = track(folder, "images:" + desk.string(),
                            "mono_slam: {forget_start_target_at: 60, new_points: particles}\n");
  EXPECT_THAT(run.states(), ElementsAre("tracking"));
}

TEST(EndToEndMono, AScheduleChangesNothing) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  std::vector<std::string> trajectories;
  for (const char* config : {"threads: true\n", "threads: false\n"}) {
    const TemporaryFolder folder;
    trajectories.push_back(
        track(folder, "images:" + desk.string(), config, {"--frames", "90"}).trajectory);
  }
  EXPECT_FALSE(trajectories[0].empty());
  EXPECT_EQ(trajectories[0], trajectories[1]);
}

TEST(EndToEndMono, CoveredForASecondItSaysLostAndComesBack) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  const fs::path covered = part_of_desk(desk, folder / "covered", 0, 240, 120, true);
  const MonoRun run = track(folder, "images:" + covered.string(), "");
  EXPECT_THAT(run.states(), ElementsAre("tracking", "lost", "relocalised", "tracking"));
  EXPECT_EQ(run.stats["mono_slam"]["times_lost"], 1);
}

TEST(EndToEndMono, TheMapIsEnteredAgainAnotherDayWithoutTheTarget) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  const std::string session = folder / "session";
  const fs::path first = part_of_desk(desk, folder / "first", 0, 200, -1, true);
  track(folder, "images:" + first.string(), "", {"--session", session});
  ASSERT_TRUE(fs::exists(folder / "session" / "sparse_map.bin"));
  const fs::path again = part_of_desk(desk, folder / "again", 150, 250, -1, false);
  const MonoRun run = track(folder, "images:" + again.string(), "", {"--session", session});
  EXPECT_THAT(run.states(), ElementsAre("relocalised", "tracking"));
  EXPECT_EQ(run.stats["mono_slam"]["scale"], "map");
  EXPECT_GE(run.stats["tracked_frames"], 95);
}

TEST(EndToEndMono, WithoutTargetOrDepthTheScaleIsSaidToBeStated) {
  ARMSREACH_RECORDING_OR_SKIP(desk, "mono/desk");
  const TemporaryFolder folder;
  const fs::path plain = part_of_desk(desk, folder / "plain", 0, 30, -1, false);
  const MonoRun run =
      track(folder, "images:" + plain.string(), "mono_slam: {stated_distance: 0.7}\n");
  EXPECT_TRUE(has_fault(run, "stated, not measured: what is seen first is 0.7 m away"));
  EXPECT_EQ(run.stats["mono_slam"]["scale"], "stated");
}

TEST(EndToEndMono, OneFrameOfDepthGivesTheScaleAndLaterOnesNothing) {
  ARMSREACH_RECORDING_OR_SKIP(kitchen, "rgbd/redkitchen");
  const TemporaryFolder folder;
  const MonoRun with = track(folder, "tum:" + kitchen.string(), kMono, {"--frames", "121"});
  EXPECT_EQ(with.stats["mono_slam"]["scale"], "depth");
  const ProgramResult evaluated =
      run_armsreach({"evaluate", "trajectory", "--estimate", folder / "t.txt", "--truth",
                     kitchen / "groundtruth.txt", "--scale", "--json", folder / "a.json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.output;
  const json errors = json::parse(read_text(folder / "a.json"));
  EXPECT_LT(errors["ate_rmse"], 0.015);

  edit_recording(kitchen, folder / "blind",
                 [](int frame) { return frame == 0 ? FrameEdit::keep : FrameEdit::blind_depth; });
  const MonoRun blind =
      track(folder, "tum:" + (folder / "blind").string(), kMono, {"--frames", "121"});
  EXPECT_FALSE(with.trajectory.empty());
  EXPECT_EQ(with.trajectory, blind.trajectory);
}

// A worn camera on its gimbal. At a hundredth of its speed the wearer stands still.
std::string worn(const std::string& world, int frames, const std::string& speed = "1") {
  return "sim:" + world +
         ",mount=shoulder,gimbal=yes,lens=80,width=320,height=240,seed=1,speed=" + speed +
         ",frames=" + std::to_string(frames);
}

std::vector<json> gaze_events(const MonoRun& run) {
  std::vector<json> out = run.events;
  std::erase_if(out, [](const json& event) { return event["type"] != "gaze"; });
  return out;
}

std::vector<std::string> modes(const std::vector<json>& gaze) {
  std::vector<std::string> out;
  for (const json& event : gaze) out.push_back(event["mode"]);
  return out;
}

TEST(EndToEndMono, TheGazeLeapsToAPlaceInTheWorldByWhatTheCameraSees) {
  const TemporaryFolder folder;
  const MonoRun run =
      track(folder, worn("gaze-sway", 60), "gaze: {mode: saccade, target: [1, 0, 1.5]}\n");
  EXPECT_THAT(modes(gaze_events(run)), ElementsAre("saccade", "fixate"));
  EXPECT_THAT(run.states(), ElementsAre("tracking"));
}

TEST(EndToEndMono, TheGazeLeapsToAnInsertedObject) {
  const TemporaryFolder folder;
  const MonoRun run = track(folder, worn("gaze-room", 40, "0.01"),
                            "gaze: {mode: saccade, target: 'object:1'}\n"
                            "actions: [{frame: 12, click: [250, 118], insert: teapot}]\n");
  std::vector<json> inserted = run.events;
  std::erase_if(inserted, [](const json& event) { return event["type"] != "insert"; });
  ASSERT_EQ(inserted.size(), 1U);
  const std::vector<double> place = inserted[0]["world_from_object"]["translation"];
  const std::vector<json> gaze = gaze_events(run);
  ASSERT_THAT(modes(gaze), ElementsAre("saccade", "fixate"));
  EXPECT_EQ(gaze[0]["target"], "object:1");
  EXPECT_GT(gaze[0]["t"], inserted[0]["t"]);
  // The world is the first camera's: what is to its right is to the right of the gimbal's zero. A
  // degree and a half for what the wearer sways all the same.
  const double pan = std::atan2(place[0], place[2]);
  EXPECT_GT(pan, 0.1);
  EXPECT_NEAR(gaze[1]["pan"], pan, 0.026);
}

TEST(EndToEndMono, TheGazeHoldsAPointOfTheMap) {
  for (const char* mode : {"saccade", "fixate"}) {
    const TemporaryFolder folder;
    const MonoRun run = track(folder, worn("gaze-room", 25, "0.01"),
                              std::string("gaze: {mode: ") + mode + ", target: 'point:4'}\n");
    const std::vector<json> gaze = gaze_events(run);
    ASSERT_FALSE(gaze.empty());
    EXPECT_EQ(gaze[0]["mode"], mode);
    EXPECT_EQ(gaze[0]["target"], "point:4");
    EXPECT_EQ(gaze.back()["mode"], "fixate");
    const double way = std::hypot(gaze[0]["pan"].get<double>(), gaze[0]["tilt"].get<double>());
    EXPECT_GT(way, 0.05) << "no point is in the very middle";
    EXPECT_LT(way, 0.9) << "it is in the first picture";
  }
}

TEST(EndToEndMono, APointThatIsNotMappedIsWaitedFor) {
  const TemporaryFolder folder;
  const MonoRun run =
      track(folder, worn("gaze-room", 8), "gaze: {mode: saccade, target: 'point:4711'}\n");
  EXPECT_THAT(gaze_events(run), ElementsAre());
}

// Degrees by which the camera has turned from the 20th to the last frame.
double turned(const std::string& trajectory) {
  std::istringstream lines(trajectory);
  std::vector<Eigen::Quaterniond> rotations;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    double t, x, y, z, qx, qy, qz, qw;
    if (fields >> t >> x >> y >> z >> qx >> qy >> qz >> qw) rotations.emplace_back(qw, qx, qy, qz);
  }
  EXPECT_GT(rotations.size(), 20U);
  if (rotations.size() <= 20) return 0;
  return rotations[20].angularDistance(rotations.back()) * 180 / std::numbers::pi;
}

TEST(EndToEndMono, TheGazeIsHeldAgainstTheWearersTurning) {
  const TemporaryFolder folder;
  const MonoRun held = track(folder, worn("gaze-room", 50), "gaze: {mode: stabilise}\n");
  EXPECT_THAT(modes(gaze_events(held)), ElementsAre("fixate"));
  const MonoRun free =
      track(folder, worn("gaze-room", 50), std::string(kMono) + "gaze: {mode: rest}\n");
  EXPECT_GT(turned(free.trajectory), 1.5);
  // Commands are a tenth of a second late, and so is what they answer.
  EXPECT_LT(turned(held.trajectory), 0.6 * turned(free.trajectory));
}

TEST(EndToEndMono, WhatCannotBeIsRefused) {
  const TemporaryFolder folder;
  write_text(folder / "mono.yaml", kMono);
  write_text(folder / "target.yaml",
             "mono_slam: {target: nowhere.yaml}\ntracking: {method: mono}\n");
  write_text(folder / "key.yaml", "mono_slam: {visible: 3}\n");
  const auto refused = [&](const std::string& config, const std::string& experience) {
    const ProgramResult run =
        run_armsreach({"run", "--source", "sim:bench,frames=2", "--experience", experience,
                       "--display", "none", "--config", folder / config});
    EXPECT_EQ(run.exit_code, 2) << run.output;
    return run.output;
  };
  cv::imwrite(folder / "0.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)));
  write_text(folder / "camera.yaml",
             "image_width: 32\nimage_height: 24\ncamera_matrix: {rows: 3, cols: 3, data: [30, 0, "
             "15.5, 0, 30, 11.5, 0, 0, 1]}\ndistortion_model: plumb_bob\n"
             "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n");
  const ProgramResult sizes = run_armsreach(
      {"run", "--source", "images:" + fs::path(folder / "0.png").parent_path().string(), "--camera",
       folder / "camera.yaml", "--display", "none"});
  EXPECT_EQ(sizes.exit_code, 2) << sizes.output;
  EXPECT_THAT(sizes.output, HasSubstr("64x48, its camera 32x24"));
  EXPECT_THAT(refused("mono.yaml", "workspace"), HasSubstr("not for the workspace"));
  EXPECT_THAT(refused("target.yaml", "wearable"), HasSubstr("nowhere.yaml"));
  EXPECT_THAT(refused("key.yaml", "wearable"), HasSubstr("visible_points"));
}

}  // namespace
}  // namespace armsreach::test
