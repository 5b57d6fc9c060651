// Recording through the command line, as a user would.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"

namespace armsreach::test {
namespace {

using ::testing::HasSubstr;

int line_count(const std::filesystem::path& file) {
  std::ifstream in(file);
  int count = 0;
  for (std::string line; std::getline(in, line);) count += !line.empty() && line[0] != '#';
  return count;
}

TEST(EndToEndRecord, ARecordingTracksAsItsSourceDid) {
  const TemporaryFolder folder;
  const std::string spec = "sim:near,width=160,frames=8,seed=3";
  const std::string made = folder / "made";
  ProgramResult result = run_armsreach({"record", "--source", spec, "--out", made});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("8 frames"));
  const std::string once = folder / "once.txt";
  const std::string again = folder / "again.txt";
  const auto track = [](const std::string& option, const std::string& what,
                        const std::string& trajectory) {
    const auto run = run_armsreach({"run", option, what, "--display", "none", "--pace",
                                    "every-frame", "--trajectory", trajectory});
    EXPECT_EQ(run.exit_code, 0) << run.output;
  };
  track("--source", spec, once);
  track("--rig", made + "/rig.yaml", again);
  EXPECT_EQ(line_count(once), 8);
  EXPECT_EQ(read_text(once), read_text(again));
}

TEST(EndToEndRecord, OnlyIntoANewFolder) {
  const TemporaryFolder folder;
  write_text(folder / "precious.txt", "mine");
  const auto result =
      run_armsreach({"record", "--source", "sim:near,width=64", "--out", folder.path()});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("not an empty folder"));
  EXPECT_EQ(read_text(folder / "precious.txt"), "mine");
}

// Rotations are normalised anew when they are read, which may change their last digit.
bool alike(const nlohmann::json& a, const nlohmann::json& b) {
  if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>()) < 1e-12;
  if (a.type() != b.type() || a.size() != b.size()) return false;
  if (!a.is_structured()) return a == b;
  return std::equal(a.begin(), a.end(), b.begin(), alike);
}

bool alike_line_by_line(const std::string& a, const std::string& b) {
  std::istringstream first(a);
  std::istringstream second(b);
  std::string x;
  std::string y;
  while (std::getline(first, x)) {
    if (!std::getline(second, y) || !alike(nlohmann::json::parse(x), nlohmann::json::parse(y)))
      return false;
  }
  return !std::getline(second, y);
}

TEST(EndToEndRecord, ARigOfTwoSensorsWithAGimbalIsRecordedAndRecordedAgain) {
  const TemporaryFolder folder;
  const std::string first = folder / "first";
  const std::string second = folder / "second";
  auto result = run_armsreach({"record", "--source",
                               "main=sim:packaging,mount=shoulder,gimbal=yes,width=64,frames=4",
                               "--source", "side=sim:assembly,width=64,frames=3", "--out", first});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(line_count(folder / "first/gimbal.txt"), 4);
  EXPECT_EQ(line_count(folder / "first/side/truth.jsonl"), 3);
  result = run_armsreach({"record", "--rig", first + "/rig.yaml", "--out", second});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  for (const char* file : {"rig.yaml", "gimbal.txt", "associations.txt", "side/groundtruth.txt"}) {
    EXPECT_EQ(read_text(folder / "first" / file), read_text(folder / "second" / file)) << file;
  }
  EXPECT_TRUE(alike_line_by_line(read_text(folder / "first/truth.jsonl"),
                                 read_text(folder / "second/truth.jsonl")));
}

TEST(EndToEndRecord, AnInterruptedRecordingIsAShorterOne) {
  const TemporaryFolder folder;
  const std::string made = folder / "made";
  const std::string command =
      "'" ARMSREACH_BINARY_DIR
      "/armsreach' record --source sim:near,width=64,loop=endless --out '" +
      made + "' > /dev/null 2>&1 & for i in $(seq 600); do [ -s '" + made +
      "/associations.txt' ] && break; sleep 0.1; done; kill -INT $!; wait $!";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const int frames = line_count(folder / "made/associations.txt");
  ASSERT_GT(frames, 0);
  EXPECT_EQ(line_count(folder / "made/truth.jsonl"), frames);
  const auto result =
      run_armsreach({"record", "--source", "tum:" + made, "--out", folder / "again"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(line_count(folder / "again/associations.txt"), frames);
}

TEST(EndToEndRecord, AWorldOfOnesOwnIsOpenedByItsPath) {
  const TemporaryFolder folder;
  write_text(folder / "mine.yaml",
             R"(about: a ball on a floor
sensor: {width: 64, height: 48, field_of_view_deg: 60, rate: 30, depth_range: [0.1, 4], noise: 1}
light: {towards: [0, -1, 2], spread_deg: 10, key: "#ffffff", key_strength: 0.8, above: "#ffffff",
        below: "#808080", ambient_strength: 0.4}
path: {duration: 1, keys: [{time: 0, eye: [0, -1, 0.5], target: [0, 0, 0]}]}
materials: {red: {pattern: plain, colors: ["#c04030"], size: 0.5}}
things:
  - {name: floor, panel: [3, 3], at: [0, 0, 0], material: red}
  - {name: ball, capsule: [0.1, 0.21], at: [0, 0, 0], material: red}
motions: [{thing: ball, keys: [{t: 1, at: [0.3, 0, 0]}]}]
)");
  const std::string mine = folder / "mine.yaml";
  const auto result =
      run_armsreach({"record", "--source", "sim:" + mine, "--out", folder / "made"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  std::ifstream in(folder / "made/truth.jsonl");
  std::string line;
  for (std::string next; std::getline(in, next);) line = next;
  const auto last = nlohmann::json::parse(line);
  EXPECT_EQ(last["things"][1]["name"], "ball");
  EXPECT_GT(last["things"][1]["world_from_thing"]["translation"][0].get<double>(), 0.25);
  EXPECT_EQ(last["contacts"][0][1], "ball");
  const auto missing = run_armsreach({"record", "--source", "sim:none.yaml", "--out", "x"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.output, HasSubstr("no such world file"));
}

}  // namespace
}  // namespace armsreach::test
