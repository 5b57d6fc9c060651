// Calibrating through the program.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"
#include "vision/core/camera_yaml.hpp"

namespace armsreach::test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

TEST(EndToEndCalibrateCamera, PhotographsGiveACameraFileAndPictures) {
  ARMSREACH_RECORDING_OR_SKIP(photos, "calibration/chessboard");
  const TemporaryFolder folder;
  const fs::path file = folder / "camera.yaml";
  const ProgramResult result = run_armsreach({"calibrate", "camera", photos.string(), "--out",
                                              file.string(), "--plots", folder / "plots"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("rms"));
  std::ifstream in(file);
  const auto camera = read_camera_yaml(in, file.string());
  ASSERT_TRUE(camera.ok()) << camera.error().message();
  ASSERT_TRUE(camera->calibration);
  EXPECT_EQ(camera->calibration->images, 13);
  EXPECT_LT(camera->calibration->rms, 0.3);
  EXPECT_EQ(camera->calibration->date.size(), std::string("2026-01-31").size());
  EXPECT_TRUE(fs::exists(folder / "plots/left01.png"));
}

// The same photographs as a source: what a person sees who holds the board before a camera.
TEST(EndToEndCalibrateCamera, ASourceIsAdvisedWhatToShow) {
  ARMSREACH_RECORDING_OR_SKIP(photos, "calibration/chessboard");
  const TemporaryFolder folder;
  const ProgramResult result =
      run_armsreach({"calibrate", "camera", "--source", "images:" + photos.string(), "--display",
                     "none", "--out", folder / "camera.yaml"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("to know the camera better"));
}

TEST(EndToEndCalibrateCamera, WrongInputIsSaid) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "empty");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{}, "images or a source"},
      {{"/no/such.jpg"}, "/no/such.jpg"},
      {{folder / "empty"}, "holds no images"},
      {{folder / "empty", "--board", "9by6"}, "9by6"},
      {{"--source", "sim:bench", "--frames", "3"}, "frames"},
  };
  for (const auto& [arguments, expected] : wrong) {
    std::vector<std::string> command{"calibrate", "camera"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const ProgramResult result = run_armsreach(command);
    EXPECT_EQ(result.exit_code, 2) << result.output;
    EXPECT_THAT(result.output, HasSubstr(expected));
  }
}

TEST(EndToEndCalibrateTarget, ASheetAndItsDescription) {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_armsreach({"calibrate", "target", "--size", "200x100", "--out", folder / "start.pdf"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(read_text(folder / "start.pdf").substr(0, 5), "%PDF-");
  EXPECT_THAT(read_text(folder / "start.yaml"), HasSubstr("width: 0.2, height: 0.1"));
}

TEST(EndToEndCalibrateTarget, WhatCannotBePrintedIsRefused) {
  for (const char* size : {"400x300", "5x5", "20", "-100x100", "nanxnan"}) {
    const ProgramResult result = run_armsreach({"calibrate", "target", "--size", size});
    EXPECT_EQ(result.exit_code, 2) << size << result.output;
    EXPECT_THAT(result.output, HasSubstr("--size"));
  }
  const ProgramResult result =
      run_armsreach({"calibrate", "target", "--out", "/no/such/folder/target.pdf"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.output, HasSubstr("/no/such/folder"));
}

}  // namespace
}  // namespace armsreach::test
