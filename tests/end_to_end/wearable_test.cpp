// The wearable experience through the command line: gestures of a simulated hand in their order,
// the same in any schedule, on plain cameras, with a gimbal, and with images that have no colour.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/program.hpp"

namespace armsreach::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::vector<json> events_of(const std::filesystem::path& file, const std::string& type) {
  std::istringstream lines(read_text(file));
  std::vector<json> events;
  for (std::string line; std::getline(lines, line);) {
    json event = json::parse(line);
    if (event["type"] == type) events.push_back(std::move(event));
  }
  return events;
}

// Faults of the hands; images without a calibration are a fault of their own.
std::vector<json> hands_faults(const std::filesystem::path& file) {
  std::vector<json> faults = events_of(file, "fault");
  std::erase_if(faults, [](const json& fault) { return fault["component"] != "hands"; });
  return faults;
}

std::vector<std::string> run_of(const TemporaryFolder& folder, const std::string& source,
                                const std::string& experience) {
  return {"run",
          "--source",
          source,
          "--experience",
          experience,
          "--pace",
          "every-frame",
          "--display",
          "none",
          "--events",
          folder / "e.jsonl",
          "--stats",
          folder / "s.json"};
}

TEST(EndToEndWearable, AScriptedHandIsUnderstoodInOrderAndInsertsWhereItPoints) {
  const TemporaryFolder folder;
  const ProgramResult run = run_armsreach(
      run_of(folder, "sim-hand:sim:bench,script=gestures,frames=200", "wearable,workspace"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  std::vector<std::string> told;
  for (const json& event : events_of(folder / "e.jsonl", "gesture")) {
    if (!event["name"].is_null()) told.push_back(event["name"]);
  }
  // What comes in between, on the way from one posture to the next, is not for this test.
  told.erase(std::unique(told.begin(), told.end()), told.end());
  EXPECT_THAT(told, ::testing::IsSupersetOf({"point", "L", "open", "fist", "grasp"}));
  const auto first = [&told](const std::string& name) {
    return std::find(told.begin(), told.end(), name);
  };
  EXPECT_LT(first("point"), first("L"));
  EXPECT_LT(first("L"), first("fist"));
  EXPECT_LT(first("fist"), first("grasp"));
  EXPECT_EQ(events_of(folder / "e.jsonl", "insert").size(), 1U);
  EXPECT_EQ(events_of(folder / "e.jsonl", "accept").size(), 1U);
  const json stats = json::parse(read_text(folder / "s.json"));
  EXPECT_EQ(stats["stages"]["hands"]["frames"], 200);
  EXPECT_EQ(stats["stages"]["hands"]["faults"], 0);
}

// What a run over a worn camera on a gimbal leaves: its events and the last picture.
struct GazeRun {
  std::string events;
  cv::Mat picture;
};

constexpr const char* kPointingHand = R"(hands:
  - {side: right, frame: camera, keys: [
      {t: 0, pose: point, at: [-0.1, -0.03, 0.42], turn_deg: [0, 180, -12]},
      {t: 3, pose: point, at: [-0.1, -0.03, 0.42], turn_deg: [0, 180, -12]}]}
)";

GazeRun gaze_run(const std::string& mode, const std::string& threads) {
  const TemporaryFolder folder;
  write_text(folder / "config.yaml", "threads: " + threads + "\ngesture: {skin: simulated}\n" +
                                         "gaze: {mode: " + mode + "}\n");
  write_text(folder / "hand.yaml", kPointingHand);
  std::vector<std::string> arguments =
      run_of(folder,
             "sim-hand:sim:gaze-room,mount=shoulder,gimbal=yes,frames=45,script=" +
                 (folder / "hand.yaml").string(),
             "wearable");
  *std::find(arguments.begin(), arguments.end(), "none") = "osmesa";
  arguments.insert(arguments.end(), {"--config", folder / "config.yaml", "--screenshots",
                                     (folder / "pictures").string()});
  const ProgramResult run = run_armsreach(arguments);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  return {read_text(folder / "e.jsonl"), cv::imread(folder / "pictures/frame_000044.png")};
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  // Messages are in the lower half.
  return cv::norm(a.rowRange(0, a.rows / 2), b.rowRange(0, b.rows / 2), cv::NORM_L1) /
         static_cast<double>(a.total());
}

// With a gimbal the camera itself moves by what was seen: the loop is closed in lock-step.
TEST(EndToEndWearable, ThreadedTurnsAndRepeatsAreBitIdentical) {
  const GazeRun first = gaze_run("follow", "true");
  ASSERT_FALSE(first.picture.empty());
  EXPECT_THAT(first.events, HasSubstr("\"gaze\""));
  for (const char* threads : {"false", "true"}) {
    const GazeRun again = gaze_run("follow", threads);
    EXPECT_EQ(again.events, first.events);
    ASSERT_EQ(again.picture.size(), first.picture.size());
    EXPECT_EQ(difference(again.picture, first.picture), 0);
  }
  // The camera has turned: one at rest sees something else. The same noise is in both.
  const GazeRun resting = gaze_run("rest", "true");
  ASSERT_EQ(resting.picture.size(), first.picture.size());
  EXPECT_GT(difference(resting.picture, first.picture), 1);
}

TEST(EndToEndWearable, LookingWithoutAGimbalIsAFault) {
  const TemporaryFolder folder;
  for (const auto& [config, faults] : {std::pair("gaze: {mode: follow}", 1U),
                                       {"gaze: {mode: stabilise}", 1U},
                                       {"gaze: {mode: auto}", 0U}}) {
    write_text(folder / "config.yaml", config);
    std::vector<std::string> arguments = run_of(folder, "sim:bench,frames=2", "wearable");
    arguments.insert(arguments.end(), {"--config", folder / "config.yaml"});
    ASSERT_EQ(run_armsreach(arguments).exit_code, 0);
    std::vector<json> told = events_of(folder / "e.jsonl", "fault");
    std::erase_if(told, [](const json& fault) { return fault["component"] != "gaze"; });
    EXPECT_EQ(told.size(), faults) << config;
  }
}

TEST(EndToEndWearable, ACameraThatNobodyAsksToTrackIsNotTracked) {
  const TemporaryFolder folder;
  const std::filesystem::path images = folder / "images";
  std::filesystem::create_directories(images);
  for (int i = 0; i < 5; ++i) {
    cv::imwrite(images / (std::to_string(i) + ".png"),
                cv::Mat(120, 160, CV_8UC3, cv::Scalar(140, 90, 20)));
  }
  write_text(folder / "config.yaml", "tracking: {method: none}\n");
  const ProgramResult run =
      run_armsreach({"run", "--source", "images:" + images.string(), "--pace", "every-frame",
                     "--config", folder / "config.yaml", "--display", "none", "--events",
                     folder / "e.jsonl", "--stats", folder / "s.json"});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, ::testing::Not(HasSubstr("tracked")));
  EXPECT_TRUE(events_of(folder / "e.jsonl", "tracking").empty());
  EXPECT_TRUE(hands_faults(folder / "e.jsonl").empty());
  const json stages = json::parse(read_text(folder / "s.json"))["stages"];
  EXPECT_EQ(stages["hands"]["frames"], 5);
  EXPECT_FALSE(stages.contains("tracking"));
}

TEST(EndToEndWearable, GreyImagesAreOneFaultWithARemedy) {
  const TemporaryFolder folder;
  const std::filesystem::path images = folder / "images";
  std::filesystem::create_directories(images);
  for (int i = 0; i < 5; ++i) {
    cv::imwrite(images / (std::to_string(i) + ".png"), cv::Mat(120, 160, CV_8UC1, cv::Scalar(90)));
  }
  const ProgramResult run = run_armsreach(run_of(folder, "images:" + images.string(), "wearable"));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto faults = hands_faults(folder / "e.jsonl");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0]["remedy"].get<std::string>(), HasSubstr("colour"));
  EXPECT_EQ(json::parse(read_text(folder / "s.json"))["frames"], 5);
}

TEST(EndToEndWearable, FilesThatAreWrongAreNamed) {
  const TemporaryFolder folder;
  write_text(folder / "table.yaml", "states: [{name: a}]\ntransitions: [{from: b}]\n");
  const std::string skin = ARMSREACH_SOURCE_DIR "/assets/skin/simulated.yaml";
  std::string others = read_text(skin);
  others.replace(others.find("skin"), 4, "mugs");
  write_text(folder / "things.yaml", others);
  const std::string things = folder / "things.yaml";
  for (const auto& [config, complaint] :
       {std::pair<std::string, std::string>{"gesture: {templates: nowhere}", "no templates"},
        {"gesture: {skin: nowhere.yaml}", "nowhere.yaml"},
        {"gesture: {vocabulary: semaphore}", "semaphore"},
        {"gesture: {skin: " + things + "}", "no class 'skin'"},
        {"gesture: {colours: " + skin + "}", "a model of skin"},
        {"gaze: {target: \"colour:ball\"}", "'ball'"},
        {"gesture: {table: " + (folder / "table.yaml").string() + "}", "transitions[0].from"}}) {
    write_text(folder / "config.yaml", config);
    std::vector<std::string> arguments = run_of(folder, "sim:bench,frames=2", "wearable");
    arguments.insert(arguments.end(), {"--config", folder / "config.yaml"});
    const ProgramResult run = run_armsreach(arguments);
    EXPECT_EQ(run.exit_code, 2) << config;
    EXPECT_THAT(run.output, HasSubstr(complaint)) << config;
  }
}

}  // namespace
}  // namespace armsreach::test
