// Start targets in real pictures: found in all that show them, and in none that do not.
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/recordings.hpp"
#include "tests/unit/vision/mono_slam/mono_recording.hpp"

namespace armsreach::mono_slam {
namespace {

TEST(StartOnRecordings, TheDesksTargetIsInAllOfItsFrames) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const test::MonoRecording desk = test::read_desk(folder);
  SearchImage image;
  for (std::size_t i = 0; i < desk.frames.size(); ++i) {
    image.set(desk.frames[i]);
    const auto fix = find_marks(image, desk.camera, desk.target->marks);
    ASSERT_TRUE(fix) << i;
    EXPECT_LT(fix->pose.rms, 0.5) << i;
    // Up to here it is near enough to start from, and beyond doubt.
    if (i <= 80) {
      EXPECT_TRUE(fix->certain) << i;
      EXPECT_LT(position_sigma(*fix), 0.05) << i;
    }
  }
}

std::vector<cv::Mat> pictures_in(const std::filesystem::path& folder, std::size_t every) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".png" || entry.path().extension() == ".jpg")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<cv::Mat> pictures;
  for (std::size_t i = 0; i < files.size(); i += every) {
    const cv::Mat picture = cv::imread(files[i].string(), cv::IMREAD_GRAYSCALE);
    cv::Mat small;
    cv::resize(picture, small, cv::Size(320, 240), 0, 0, cv::INTER_AREA);
    pictures.push_back(small);
  }
  return pictures;
}

// Kitchens, rooms, hands and chessboards, full of dark corners and rectangles.
TEST(StartOnRecordings, NoTargetIsFoundWhereThereIsNone) {
  ARMSREACH_RECORDING_OR_SKIP(folder, "mono/desk");
  const test::MonoRecording desk = test::read_desk(folder);
  const Camera camera = pinhole(320, 240, 290, 290, 159.5, 119.5);
  int seen = 0;
  for (const char* name : {"rgbd/redkitchen/rgb", "rgbd/cabinet/rgb", "rgbd/livingroom/rgb",
                           "calibration/chessboard", "hands/gestures"}) {
    const auto place = armsreach::test::recording(name);
    if (!place) continue;
    for (const cv::Mat& picture : pictures_in(*place, 2)) {
      SearchImage image;
      image.set(picture);
      EXPECT_FALSE(find_marks(image, camera, desk.target->marks)) << name << " " << seen;
      EXPECT_FALSE(find_rectangle(picture, camera, {0.21, 0.1485})) << name << " " << seen;
      ++seen;
    }
  }
  if (seen == 0) GTEST_SKIP() << "no recording without the target";
}

}  // namespace
}  // namespace armsreach::mono_slam
