#include "devices/image_recording.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/recordings.hpp"
#include "tests/unit/devices/recorded_folder.hpp"

namespace armsreach {
namespace {

using test::color_image;
using test::RecordedFolder;

TEST(ImageRecording, ReadsEveryFormatInNameOrderAtItsRate) {
  const RecordedFolder folder;
  folder.write("notes.txt", "not an image");
  const char* names[] = {"a.bmp", "b.PNG", "c.jpg", "d.jpeg", "e.ppm", "f.pgm"};
  for (int i = 4; i >= 0; --i) cv::imwrite(folder / names[i], color_image(32, 24, i));
  cv::imwrite(folder / "f.pgm", cv::Mat(24, 32, CV_8UC1, cv::Scalar(7)));
  const auto recording = open_image_recording(folder.path(), 20, {});
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ((*recording)->size(), 6);
  for (int i = 0; i < 6; ++i) {
    const auto frame = (*recording)->read(i);
    ASSERT_TRUE(frame) << frame.error().message();
    EXPECT_EQ((*frame)->time, i * 50'000'000);
    EXPECT_EQ((*frame)->color.type(), i == 5 ? CV_8UC1 : CV_8UC3);
    // Mean error in grey levels: none but for JPEG, which at 95 % blurs this one-pixel texture.
    const double error =
        i == 5 ? std::abs(cv::mean((*frame)->color)[0] - 7)
               : cv::norm((*frame)->color, color_image(32, 24, i), cv::NORM_L1) / (32 * 24 * 3);
    EXPECT_LE(error, i == 2 || i == 3 ? 30 : 0) << names[i];
  }
  EXPECT_FALSE((*recording)->read(6).value());
}

TEST(ImageRecording, WithoutCalibrationGuessesAndSaysSo) {
  const RecordedFolder folder;
  cv::imwrite(folder / "a.png", color_image(32, 24, 0));
  const auto recording = open_image_recording(folder.path(), 30, {});
  ASSERT_TRUE(recording) << recording.error().message();
  const Camera& camera = (*recording)->sensor()->camera();
  // The ray through the right edge, half a pixel beyond the last centre, is 30 deg off the axis.
  EXPECT_NEAR(unproject(camera, {31.5, 11.5}).x(), std::tan(std::numbers::pi / 6), 1e-12);
  const Events events = (*recording)->take_events();
  ASSERT_EQ(events.size(), 1U);
  const auto& fault = std::get<FaultEvent>(events[0].body);
  EXPECT_NE(fault.message.find("60 degrees"), std::string::npos);
  EXPECT_NE(fault.remedy.find((folder / "camera.yaml").string()), std::string::npos);
}

TEST(ImageRecording, CalibrationComesFromTheFolderAndFramesFromWithin) {
  const RecordedFolder folder;
  std::filesystem::create_directory(folder / "frames");
  cv::imwrite(folder / "frames/a.png", color_image(32, 24, 0));
  cv::imwrite(folder / "target.png", color_image(11, 11, 0));
  folder.write("camera.yaml", test::camera_yaml(32, 24));
  const auto recording = open_image_recording(folder.path(), 30, {});
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ((*recording)->size(), 1);
  EXPECT_EQ((*recording)->sensor()->camera().fx, 30);
  EXPECT_TRUE((*recording)->take_events().empty());
}

TEST(ImageRecording, ABrokenFirstImageDoesNotHideTheOthers) {
  const RecordedFolder folder;
  folder.write("a.png", "not an image");
  cv::imwrite(folder / "b.png", color_image(32, 24, 0));
  const auto recording = open_image_recording(folder.path(), 30, {});
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_FALSE((*recording)->read(0));
  EXPECT_TRUE((*recording)->read(1));
}

TEST(ImageRecording, RefusesWhatIsNotAFolderOfImages) {
  const RecordedFolder folder;
  EXPECT_NE(open_image_recording(folder.path(), 30, {}).error().what.find("no images"),
            std::string::npos);
  EXPECT_FALSE(open_image_recording(folder / "absent", 30, {}));
  folder.write("video.mp4", "");
  EXPECT_NE(open_image_recording(folder / "video.mp4", 30, {}).error().remedy.find("video:"),
            std::string::npos);
}

TEST(ImageRecording, BrokenImagesAreNamedInEveryFormat) {
  for (const char* extension : {".png", ".jpg", ".pgm", ".ppm", ".bmp"}) {
    for (const double kept : {0.0, 0.1, 0.5, 0.95}) {
      const RecordedFolder folder;
      const std::string broken = std::string("b") + extension;
      cv::imwrite(folder / "a.png", color_image(64, 48, 0));
      cv::Mat image = color_image(64, 48, 1);
      if (broken == "b.pgm") cv::extractChannel(image, image, 0);  // grey only
      cv::imwrite(folder / broken, image);
      cv::imwrite(folder / "c.png", color_image(32, 48, 2));
      folder.truncate(broken, kept);
      const auto recording = open_image_recording(folder.path(), 30, {});
      ASSERT_TRUE(recording) << recording.error().message();
      const auto frame = (*recording)->read(1);
      ASSERT_FALSE(frame) << broken << " cut to " << kept;
      EXPECT_EQ(frame.error().where, (folder / broken).string());
      EXPECT_NE((*recording)->read(2).error().what.find("32x48"), std::string::npos);
    }
  }
}

// A camera's JPEG carries a small JPEG with an end marker of its own before the picture.
TEST(ImageRecording, AThumbnailsEndIsNotThePicturesEnd) {
  const RecordedFolder folder;
  cv::imwrite(folder / "a.jpg", color_image(64, 48, 0));
  const std::string picture = folder.read("a.jpg");
  const std::string thumbnail = std::string("\xff\xe1\x00\x08", 4) + "ab\xff\xd9\xff\xd9";
  folder.write("a.jpg", picture.substr(0, 2) + thumbnail + picture.substr(2));
  EXPECT_TRUE(open_image_recording(folder.path(), 30, {}));
  folder.truncate("a.jpg", 0.7);
  const auto broken = open_image_recording(folder.path(), 30, {});
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().what, "none of the 1 images can be read");
}

TEST(ImageRecordingReal, MonoDesk) {
  ARMSREACH_RECORDING_OR_SKIP(path, "mono/desk");
  const auto recording = open_image_recording(path, 30, {});
  ASSERT_TRUE(recording) << recording.error().message();
  EXPECT_EQ((*recording)->size(), 320);
  EXPECT_EQ((*recording)->sensor()->camera().distortion, Distortion::monoslam);
  EXPECT_TRUE((*recording)->take_events().empty());
  for (const int index : {0, 319}) {
    const auto frame = (*recording)->read(index);
    ASSERT_TRUE(frame) << frame.error().message();
    EXPECT_EQ((*frame)->color.size(), cv::Size(320, 240));
    EXPECT_EQ((*frame)->color.type(), CV_8UC1);
    EXPECT_TRUE((*frame)->depth.empty());
  }
}

}  // namespace
}  // namespace armsreach
