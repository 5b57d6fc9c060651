// Recording: every frame or drops counted, and clear words when it cannot be done.
#include "render/recorder.hpp"

#include <csignal>
#include <filesystem>
#include <string>
#include <sys/resource.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

namespace armsreach::render {
namespace {

namespace fs = std::filesystem;

class RecorderTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        ("recorder_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

// A grey level for each frame, 6 apart: far more than compression changes.
cv::Mat frame_picture(int frame, int width, int height) {
  return cv::Mat(height, width, CV_8UC3, cv::Scalar::all(40 + 6 * (frame % 30)));
}

TEST_F(RecorderTest, EveryFrameIsInTheFileInOrder) {
  const fs::path file = folder_ / "out.mp4";
  auto recorder = Recorder::open({.file = file, .width = 160, .height = 120, .queue = 1});
  ASSERT_TRUE(recorder.ok()) << recorder.error().message();
  for (int i = 0; i < 45; ++i) ASSERT_TRUE((*recorder)->write(frame_picture(i, 160, 120)).ok());
  const auto summary = (*recorder)->close();
  ASSERT_TRUE(summary.ok()) << summary.error().message();
  EXPECT_EQ(summary->frames, 45);
  EXPECT_EQ(summary->dropped, 0);

  cv::VideoCapture video(file.string(), cv::CAP_FFMPEG);
  ASSERT_TRUE(video.isOpened());
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 30, 0.01);
  cv::Mat picture;
  int frames = 0;
  for (; video.read(picture); ++frames)
    EXPECT_NEAR(cv::mean(picture)[1], 40 + 6 * (frames % 30), 3) << "frame " << frames;
  EXPECT_EQ(frames, 45);
}

TEST_F(RecorderTest, LiveDropsAndCountsInsteadOfWaiting) {
  auto recorder = Recorder::open({.file = folder_ / "live.mp4",
                                  .width = 640,
                                  .height = 480,
                                  .pace = RecordingPace::live,
                                  .queue = 2});
  ASSERT_TRUE(recorder.ok()) << recorder.error().message();
  cv::Mat noise(480, 640, CV_8UC3);
  cv::randu(noise, 0, 255);  // slow to encode
  for (int i = 0; i < 100; ++i) ASSERT_TRUE((*recorder)->write(noise).ok());
  const auto summary = (*recorder)->close();
  ASSERT_TRUE(summary.ok()) << summary.error().message();
  EXPECT_GT(summary->dropped, 0);
  EXPECT_EQ(summary->frames + summary->dropped, 100);
}

TEST_F(RecorderTest, WhatCannotBeRecordedIsSaidAtOnce) {
  const auto message = [](const RecordingOptions& options) {
    auto recorder = Recorder::open(options);
    return recorder ? std::string() : recorder.error().message();
  };
  EXPECT_NE(message({.file = folder_ / "no" / "out.mp4", .width = 64, .height = 48})
                .find("No such file or directory"),
            std::string::npos);
  fs::create_directory(folder_ / "folder.mp4");
  EXPECT_NE(
      message({.file = folder_ / "folder.mp4", .width = 64, .height = 48}).find("Is a directory"),
      std::string::npos);
  EXPECT_NE(message({.file = folder_ / "out.avi", .width = 64, .height = 48}).find(".mp4"),
            std::string::npos);
  EXPECT_NE(message({.file = folder_ / "odd.mp4", .width = 63, .height = 48}).find("even"),
            std::string::npos);
}

TEST_F(RecorderTest, PictureOfAnotherSizeIsRefused) {
  auto recorder = Recorder::open({.file = folder_ / "out.mp4", .width = 64, .height = 48});
  ASSERT_TRUE(recorder.ok()) << recorder.error().message();
  const Status written = (*recorder)->write(frame_picture(0, 80, 60));
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().message().find("80x60"), std::string::npos);
}

// The limit on file sizes stands in for a full disk: writes beyond it fail the same way.
TEST_F(RecorderTest, ATruncatedFileIsNotCalledARecording) {
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 60000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  auto recorder = Recorder::open({.file = folder_ / "full.mp4", .width = 320, .height = 240});
  ASSERT_TRUE(recorder.ok()) << recorder.error().message();
  cv::Mat noise(240, 320, CV_8UC3);
  for (int i = 0; i < 40; ++i) {
    noise = cv::Mat(240, 320, CV_8UC3);
    cv::randu(noise, 0, 255);
    ASSERT_TRUE((*recorder)->write(noise).ok());
  }
  const auto summary = (*recorder)->close();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(summary.ok());
  EXPECT_NE(summary.error().message().find("of 40 frames"), std::string::npos);
  EXPECT_EQ(summary.error().kind, Error::Kind::device);
}

TEST_F(RecorderTest, PngIsWrittenOrTheReasonGiven) {
  const cv::Mat picture = frame_picture(3, 20, 10);
  ASSERT_TRUE(write_png(folder_ / "a.png", picture).ok());
  EXPECT_EQ(cv::norm(cv::imread((folder_ / "a.png").string()), picture, cv::NORM_INF), 0);
  const Status failed = write_png(folder_ / "no" / "a.png", picture);
  ASSERT_FALSE(failed.ok());
  EXPECT_NE(failed.error().message().find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace armsreach::render
