#include "devices/video_recording.hpp"

#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "tests/support/recordings.hpp"
#include "tests/unit/devices/recorded_folder.hpp"

namespace armsreach {
namespace {

using test::RecordedFolder;

// Motion JPEG: every frame stands alone, and an AVI that is cut off still opens.
void write_video(const std::filesystem::path& file, int frames) {
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'),
                         25, {64, 48});
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < frames; ++i) {
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(2 * i)));
  }
}

TEST(VideoRecording, DeliversEveryFrameAtItsOwnRate) {
  const RecordedFolder folder;
  write_video(folder / "video.avi", 10);
  const auto recording = open_video_recording(folder / "video.avi", {});
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ((*recording)->size(), 10);
  EXPECT_EQ((*recording)->take_events().size(), 1U) << "the guessed camera";
  for (int i = 0; i < 10; ++i) {
    const auto frame = (*recording)->read(i);
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ((*frame)->time, i * 40'000'000);
    // A flat grey survives JPEG and YUV within two levels.
    EXPECT_NEAR(cv::mean((*frame)->color)[0], 2 * i, 2);
  }
  EXPECT_FALSE((*recording)->read(10).value());
}

TEST(VideoRecording, FramesAreTheSameInAnyOrder) {
  const RecordedFolder folder;
  write_video(folder / "video.avi", 80);
  const auto recording = open_video_recording(folder / "video.avi", {});
  ASSERT_TRUE(recording) << recording.error().message();
  std::vector<cv::Mat> forwards;
  for (int i = 0; i < 80; ++i) forwards.push_back((*recording)->read(i).value()->color);
  for (int i = 79; i >= 0; --i) {
    const cv::Mat again = (*recording)->read(i).value()->color;
    ASSERT_EQ(cv::norm(again, forwards[i], cv::NORM_INF), 0) << i;
  }
  for (const int i : {0, 50, 51, 3, 40, 79}) {
    const cv::Mat again = (*recording)->read(i).value()->color;
    ASSERT_EQ(cv::norm(again, forwards[i], cv::NORM_INF), 0) << i;
  }
}

TEST(VideoRecording, ACutOffVideoEndsEarlyAndSaysSo) {
  const RecordedFolder folder;
  write_video(folder / "video.avi", 80);
  folder.truncate("video.avi", 0.5);
  auto recording = open_video_recording(folder / "video.avi", {});
  ASSERT_TRUE(recording) << recording.error().message();
  (*recording)->take_events();
  const auto source = play(std::move(*recording), Loop::once);
  int frames = 0;
  while (source->next().value()) ++frames;
  EXPECT_GT(frames, 20);
  EXPECT_LT(frames, 60);
  const Events events = source->take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<FaultEvent>(events[0].body).message,
            "ends after " + std::to_string(frames) + " of the 80 frames that its header promises");
}

TEST(VideoRecording, RefusesWhatIsNotAVideoOrHasAnotherCamera) {
  const RecordedFolder folder;
  EXPECT_FALSE(open_video_recording(folder / "absent.mp4", {}));
  EXPECT_FALSE(open_video_recording(folder.path(), {}));
  folder.write("text.mp4", "not a video");
  EXPECT_EQ(open_video_recording(folder / "text.mp4", {}).error().what, "not a readable video");
  write_video(folder / "video.avi", 2);
  folder.write("camera.yaml", test::camera_yaml(32, 24));
  EXPECT_NE(open_video_recording(folder / "video.avi", {}).error().what.find("64x48"),
            std::string::npos);
}

TEST(VideoRecordingReal, CountingHand) {
  ARMSREACH_RECORDING_OR_SKIP(path, "hands/video/count.mp4");
  const auto recording = open_video_recording(path, {});
  ASSERT_TRUE(recording) << recording.error().message();
  const std::int64_t frames = (*recording)->size().value();
  ASSERT_GT(frames, 60);
  std::vector<cv::Mat> last;  // H.264 with pictures between key frames: seeking must be exact
  for (std::int64_t i = 0; i < frames; ++i) {
    const auto frame = (*recording)->read(i);
    ASSERT_TRUE(frame && *frame) << i;
    if (i >= frames - 40) last.push_back((*frame)->color);
  }
  for (std::int64_t i = frames - 1; i >= frames - 40; --i) {
    const cv::Mat again = (*recording)->read(i).value()->color;
    ASSERT_EQ(cv::norm(again, last[i - (frames - 40)], cv::NORM_INF), 0) << i;
  }
}

}  // namespace
}  // namespace armsreach
