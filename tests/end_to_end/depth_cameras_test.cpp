// Depth cameras through the command line: absent ones, and a Kinect that fakenect plays.
#include <chrono>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/unit/devices/kinect_session.hpp"

namespace armsreach::test {
namespace {

TEST(EndToEndDepthCameras, AbsentOnesAreSaidAtOnceWithARemedy) {
  const auto start = std::chrono::steady_clock::now();
  for (const char* spec : {"freenect:15", "openni:1d27/0000@99/99"}) {
    const ProgramResult run = run_armsreach({"run", "--source", spec, "--display", "none"});
    EXPECT_EQ(run.exit_code, 3) << run.output;
    EXPECT_NE(run.output.find(spec), std::string::npos) << run.output;
    EXPECT_NE(run.output.find('('), std::string::npos) << "no remedy: " << run.output;
  }
  // A second of the two is looking at USB; what is excluded is waiting for what is not there.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(EndToEndDepthCameras, SourcesListsThemPresentOrNot) {
  const ProgramResult run = run_armsreach({"sources"});
  EXPECT_EQ(run.exit_code, 0);
  for (const char* word : {"freenect:0", "openni:any", "openni:FILE.oni"}) {
    EXPECT_NE(run.output.find(word), std::string::npos) << run.output;
  }
}

TEST(EndToEndDepthCameras, AKinectsSessionIsPlayedToItsEnd) {
  const TemporaryFolder folder;
  write_kinect_session(folder / "session", 60);
  setenv("FAKENECT_PATH", (folder / "session").c_str(), 1);
  setenv("LD_LIBRARY_PATH", ARMSREACH_FAKENECT_FOLDER, 1);
  const ProgramResult run =
      run_armsreach({"run", "--source", "freenect:0,depth=raw", "--display", "none", "--frames",
                     "10", "--events", folder / "e.jsonl", "--stats", folder / "s.json"});
  unsetenv("LD_LIBRARY_PATH");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const auto stats = nlohmann::json::parse(read_text(folder / "s.json"));
  EXPECT_EQ(stats["stages"]["capture"]["frames"], 10);
  EXPECT_NE(read_text(folder / "e.jsonl").find("nominal cameras"), std::string::npos);
}

}  // namespace
}  // namespace armsreach::test
