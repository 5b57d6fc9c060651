// A recording that does not state its colour camera: noticed, estimated, said and used.
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// The same recording without its camera_color.yaml.
void copy_unstated(const fs::path& recording, const fs::path& copy) {
  fs::create_directory(copy);
  for (const auto& entry : fs::directory_iterator(recording)) {
    if (entry.path().filename() == "camera_color.yaml") continue;
    fs::create_symlink(entry.path(), copy / entry.path().filename());
  }
}

struct Outcome {
  std::string trajectory, events;
  double ate = 0;  // m
};

Outcome played(const fs::path& recording, const fs::path& truth, const std::string& config = "") {
  TemporaryFolder folder;
  write_text(folder / "config.yaml", config);
  const ProgramResult result =
      run_armsreach({"run", "--source", "tum:" + recording.string(), "--pace", "every-frame",
                     "--display", "none", "--frames", "121", "--config", folder / "config.yaml",
                     "--trajectory", folder / "t.txt", "--events", folder / "e.jsonl"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const ProgramResult evaluated =
      run_armsreach({"evaluate", "trajectory", "--estimate", folder / "t.txt", "--truth", truth,
                     "--json", folder / "ate.json"});
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.output;
  return {read_text(folder / "t.txt"), read_text(folder / "e.jsonl"),
          json::parse(read_text(folder / "ate.json"))["ate_rmse"]};
}

// What was said of the registration, if anything.
std::optional<json> registration_fault(const Outcome& outcome) {
  std::istringstream lines(outcome.events);
  for (std::string line; std::getline(lines, line);) {
    json event = json::parse(line);
    if (event["type"] == "fault" && event["component"] == "registration") return event;
  }
  return std::nullopt;
}

TEST(EndToEndRegistration, AnUnstatedColorCameraIsFoundSaidAndUsed) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  TemporaryFolder folder;
  copy_unstated(path, folder / "unstated");
  const fs::path truth = path / "groundtruth.txt";
  const Outcome unstated = played(folder / "unstated", truth);
  const auto fault = registration_fault(unstated);
  ASSERT_TRUE(fault);
  EXPECT_THAT((*fault)["message"], HasSubstr("not registered"));
  EXPECT_LE((*fault)["t"], 2.1);  // s: 60 frames, and the lag

  const Outcome stated = played(path, truth);
  EXPECT_FALSE(registration_fault(stated));
  EXPECT_NEAR(unstated.ate, stated.ate, 0.001);  // 1.1 cm both

  // The remedy holds the file to write; with it nothing is left to say.
  const std::string remedy = (*fault)["remedy"];
  write_text(folder / "unstated" / "camera_color.yaml", remedy.substr(remedy.find('\n') + 1));
  const Outcome remedied = played(folder / "unstated", truth);
  EXPECT_FALSE(registration_fault(remedied));
  EXPECT_NEAR(remedied.ate, stated.ate, 0.001);
}

TEST(EndToEndRegistration, IsTheSameInTurnsAndInThreads) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  TemporaryFolder folder;
  copy_unstated(path, folder / "unstated");
  const Outcome threads = played(folder / "unstated", path / "groundtruth.txt");
  const Outcome turns = played(folder / "unstated", path / "groundtruth.txt", "threads: false\n");
  EXPECT_EQ(threads.events, turns.events);
  EXPECT_EQ(threads.trajectory, turns.trajectory);
}

TEST(EndToEndRegistration, NothingIsSaidOfRegisteredImages) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  EXPECT_FALSE(registration_fault(played(path, path / "groundtruth.txt")));
}

}  // namespace
}  // namespace armsreach::test
