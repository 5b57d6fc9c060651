// Whole runs through the command line: bit-identical, files complete, accuracy on real recordings.
#include <cstdlib>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>

#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::test {
namespace {

using nlohmann::json;

json json_from_file(const std::filesystem::path& path) { return json::parse(read_text(path)); }

// Runs a source without drawing and evaluates its trajectory against `truth`.
json tracked(const TemporaryFolder& folder, const std::string& source, const std::string& truth,
             const std::string& config, const std::string& recording = "") {
  write_text(folder / "config.yaml", config);
  const ProgramResult run = run_armsreach(
      {"run", "--source", source, "--pace", "every-frame", "--display", "none", "--config",
       folder / "config.yaml", "--trajectory", folder / "t.txt", "--stats", folder / "s.json"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  std::vector<std::string> evaluate = {"evaluate", "trajectory", "--estimate", folder / "t.txt",
                                       "--truth",  truth,        "--json",     folder / "e.json"};
  if (!recording.empty()) evaluate.insert(evaluate.end(), {"--recording", recording});
  const ProgramResult evaluated = run_armsreach(evaluate);
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.output;
  return json_from_file(folder / "e.json");
}

TEST(EndToEndRun, ASimulatedRunWritesEverything) {
  TemporaryFolder folder;
  const ProgramResult run = run_armsreach({"run",
                                           "--source",
                                           "sim:bench",
                                           "--pace",
                                           "every-frame",
                                           "--display",
                                           "egl",
                                           "--frames",
                                           "45",
                                           "--record",
                                           folder / "film.mp4",
                                           "--screenshots",
                                           folder / "shots",
                                           "--trajectory",
                                           folder / "t.txt",
                                           "--events",
                                           folder / "e.jsonl",
                                           "--stats",
                                           folder / "s.json",
                                           "--map",
                                           folder / "map.ot"});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const json stats = json_from_file(folder / "s.json");
  EXPECT_EQ(stats["frames"], 45);
  EXPECT_EQ(stats["tracked_frames"], 45);
  for (const char* stage : {"capture", "tracking", "mapping", "composing", "drawing"}) {
    EXPECT_EQ(stats["stages"][stage]["frames"], 45) << stage;
    EXPECT_EQ(stats["stages"][stage]["drops"], 0) << stage;
    EXPECT_EQ(stats["stages"][stage]["faults"], 0) << stage;
  }
  cv::VideoCapture film(folder / "film.mp4");
  int frames = 0;
  for (cv::Mat image; film.read(image);) ++frames;
  EXPECT_EQ(frames, 45);
  for (const char* shot : {"frame_000000.png", "frame_000030.png", "frame_000044.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "shots" / shot)) << shot;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "map.ot"));
}

TEST(EndToEndRun, TheEndOfASourceIsNotCountedAsAFrame) {
  const TemporaryFolder folder;
  const ProgramResult run =
      run_armsreach({"run", "--source", "sim:bench,frames=6", "--pace", "every-frame", "--display",
                     "none", "--stats", folder / "s.json"});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_EQ(json_from_file(folder / "s.json")["stages"]["capture"]["frames"], 6);
}

TEST(EndToEndRun, ThreadedTurnsAndRepeatsAreBitIdentical) {
  std::vector<std::string> trajectories;
  std::vector<std::string> events;
  for (const char* threads : {"true", "false", "true"}) {
    TemporaryFolder folder;
    write_text(folder / "config.yaml",
               std::string("threads: ") + threads +
                   "\nactions: [{frame: 20, click: [450, 290], insert: teapot}]\n");
    const ProgramResult run =
        run_armsreach({"run", "--source", "sim:bench,noise=kinect", "--pace", "every-frame",
                       "--display", "none", "--frames", "60", "--config", folder / "config.yaml",
                       "--trajectory", folder / "t.txt", "--events", folder / "e.jsonl"});
    ASSERT_EQ(run.exit_code, 0) << run.output;
    trajectories.push_back(read_text(folder / "t.txt"));
    events.push_back(read_text(folder / "e.jsonl"));
  }
  EXPECT_FALSE(trajectories[0].empty());
  EXPECT_THAT(events[0], ::testing::HasSubstr("\"insert\""));
  EXPECT_EQ(trajectories[0], trajectories[1]);
  EXPECT_EQ(trajectories[0], trajectories[2]);
  EXPECT_EQ(events[0], events[1]);
  EXPECT_EQ(events[0], events[2]);
}

// A window in a display of its own; both paces must come to their end.
TEST(EndToEndRun, AWindowOpensAndEnds) {
  if (std::system("command -v xvfb-run >/dev/null") != 0)
    GTEST_SKIP() << "xvfb-run is not installed";
  for (const char* pace : {"live", "every-frame"}) {
    const std::string command =
        "timeout 300 xvfb-run -a " ARMSREACH_BINARY_DIR
        "/armsreach run --source sim:bench --display window --frames 8 --pace " +
        std::string(pace) + " >/dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << pace;
  }
}

TEST(EndToEndRun, AnInterruptEndsInOrder) {
  TemporaryFolder folder;
  const std::string events = folder / "e.jsonl";
  const std::string command =
      ARMSREACH_BINARY_DIR "/armsreach run --source sim:bench --display egl --record " +
      (folder / "film.mp4").string() + " --stats " + (folder / "s.json").string() + " --events " +
      events + " >/dev/null 2>&1 & for i in $(seq 600); do grep -qs tracking " + events +
      " && break; sleep 0.1; done; kill -INT $!; wait $!";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_GT(json_from_file(folder / "s.json")["frames"], 0);
  cv::VideoCapture film(folder / "film.mp4");
  cv::Mat image;
  EXPECT_TRUE(film.read(image));
}

// The bounds are what cv::rgbd's RgbdOdometry reaches at 640x480 on the same frames.
TEST(EndToEndRun, RedkitchenIsTrackedInEveryFrame) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  TemporaryFolder folder;
  const json errors = tracked(folder, "tum:" + path.string(), path / "groundtruth.txt", "", path);
  EXPECT_EQ(errors["coverage"], 1.0);
  EXPECT_LE(errors["ate_rmse"], 0.0199);
  EXPECT_LE(errors["reprojected_depth"], 2.9e-3);  // 1/m
}

TEST(EndToEndRun, LivingroomNeedsItsMap) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TemporaryFolder folder;
  const std::string source = "tum:" + path.string();
  const json with = tracked(folder, source, path / "groundtruth.txt", "");
  EXPECT_EQ(with["coverage"], 1.0);
  EXPECT_LE(with["ate_rmse"], 0.0075);
  const json without =
      tracked(folder, source, path / "groundtruth.txt", "mapping: {enabled: false}\n");
  EXPECT_GT(without["ate_rmse"], 3 * with["ate_rmse"].get<double>());
}

TEST(EndToEndRun, ABrokenFrameIsAFaultAndTheRunGoesOn) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  TemporaryFolder folder;
  std::filesystem::copy(path, folder / "copy", std::filesystem::copy_options::recursive);
  const auto victim = folder / "copy" / "depth" / "0.333333.png";
  std::filesystem::permissions(victim, std::filesystem::perms::owner_all);
  write_text(victim, read_text(victim).substr(0, 2000));
  const ProgramResult run = run_armsreach(
      {"run", "--source", "tum:" + (folder / "copy").string(), "--pace", "every-frame", "--display",
       "none", "--frames", "30", "--events", folder / "e.jsonl", "--stats", folder / "s.json"});
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(read_text(folder / "e.jsonl"), ::testing::HasSubstr("0.333333.png"));
  EXPECT_EQ(json_from_file(folder / "s.json")["tracked_frames"], 30);
}

}  // namespace
}  // namespace armsreach::test
