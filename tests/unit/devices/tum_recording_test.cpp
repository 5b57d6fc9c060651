#include "devices/tum_recording.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/recordings.hpp"
#include "tests/unit/devices/recorded_folder.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;
using test::kHeight;
using test::kStep;
using test::kWidth;
using test::RecordedFolder;

class TumRecordingTest : public ::testing::Test {
 protected:
  TumRecordingTest() { test::write_small_recording(folder_); }

  std::unique_ptr<Recording> open(const OpenOptions& options = {}) {
    auto recording = open_tum_recording(folder_.path(), options);
    if (!recording) {
      ADD_FAILURE() << recording.error().message();
      return nullptr;
    }
    return std::move(*recording);
  }
  Error refusal() {
    const auto recording = open_tum_recording(folder_.path(), {});
    return recording ? Error{"opened", "", ""} : recording.error();
  }

  RecordedFolder folder_;
};

TEST_F(TumRecordingTest, DeliversColourDepthInMetresTimeAndTruth) {
  const auto recording = open();
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->size(), 3);
  const SensorInfo& sensor = *recording->sensor();
  EXPECT_TRUE(sensor.registered);
  EXPECT_FALSE(sensor.registration_stated);  // there is no camera_color.yaml
  EXPECT_EQ(sensor.depth_camera->width, kWidth);
  EXPECT_EQ(sensor.color_camera->fx, 30);
  EXPECT_NEAR(sensor.rate, 10, 1e-9);

  const auto frame = recording->read(2);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ((*frame)->time, 2 * kStep);
  EXPECT_EQ((*frame)->index, 2);
  EXPECT_EQ((*frame)->color.type(), CV_8UC3);
  EXPECT_EQ(cv::norm((*frame)->color, test::color_image(kWidth, kHeight, 2), cv::NORM_INF), 0);
  const cv::Mat& depth = (*frame)->depth;
  ASSERT_EQ(depth.type(), CV_32F);
  EXPECT_TRUE(std::isnan(depth.at<float>(0, 0)));  // 0
  EXPECT_TRUE(std::isnan(depth.at<float>(0, 1)));  // saturated
  // One unit of 1/5000 m and 3 m, to the last bits of a float.
  EXPECT_FLOAT_EQ(depth.at<float>(0, 2), 0.0002F);
  EXPECT_FLOAT_EQ(depth.at<float>(5, 5), 3.0F);
  EXPECT_NEAR((*frame)->world_from_camera->translation().x(), 2, 1e-12);
  EXPECT_FALSE(recording->read(3).value());
  EXPECT_TRUE(recording->take_events().empty());
}

TEST_F(TumRecordingTest, TruthIsInterpolatedOverShortGapsOnly) {
  folder_.write("groundtruth.txt",
                "-0.04 0 0 0 0 0 0 1\n0.04 8 0 0 0 0 0 1\n0.115 5 0 0 0 0 0 1\n"
                "0.3 9 0 0 0 0 0 1\n");
  const auto recording = open();
  ASSERT_TRUE(recording);
  const auto truth = [&](int index) { return recording->read(index).value()->world_from_camera; };
  EXPECT_NEAR(truth(0)->translation().x(), 4, 1e-12);   // halfway across 80 ms
  EXPECT_NEAR(truth(1)->translation().x(), 5.6, 1e-9);  // 0.8 of the way across 75 ms
  EXPECT_FALSE(truth(2)) << "0.185 s between poses, 85 ms to the nearest";
}

TEST_F(TumRecordingTest, TwoCamerasAreNotRegistered) {
  folder_.write(
      "camera_color.yaml",
      test::camera_yaml(64, 48) +
          "camera_from_depth: {rotation_vector: [0, 0, 0.1], translation: [-0.02, 0, 0]}");
  for (int i = 0; i < 3; ++i) {
    cv::imwrite(folder_ / ("rgb/" + std::to_string(i) + ".png"), test::color_image(64, 48, i));
  }
  const auto recording = open();
  ASSERT_TRUE(recording);
  EXPECT_FALSE(recording->sensor()->registered);
  EXPECT_TRUE(recording->sensor()->registration_stated);
  EXPECT_EQ(recording->sensor()->color_camera->width, 64);
  EXPECT_EQ(recording->sensor()->depth_camera->width, kWidth);
  EXPECT_NEAR(recording->sensor()->color_from_depth.translation().x(), -0.02, 1e-12);
  const auto frame = recording->read(0);
  ASSERT_TRUE(frame) << frame.error().message();
  EXPECT_EQ((*frame)->color.cols, 64);
}

TEST_F(TumRecordingTest, OneKindOfImageIsEnough) {
  folder_.remove("rgb.txt");
  auto recording = open();
  ASSERT_TRUE(recording);
  EXPECT_FALSE(recording->sensor()->color_camera);
  EXPECT_TRUE(recording->read(0).value()->color.empty());

  test::write_small_recording(folder_);
  folder_.remove("depth.txt");
  recording = open();
  ASSERT_TRUE(recording);
  EXPECT_FALSE(recording->sensor()->depth_camera);
  EXPECT_EQ(recording->sensor()->camera().width, kWidth);
  EXPECT_TRUE(recording->read(0).value()->depth.empty());
}

TEST_F(TumRecordingTest, ColourAloneOfTwoCamerasHasTheColourCamerasTruth) {
  folder_.remove("depth.txt");
  folder_.write("camera_color.yaml",
                test::camera_yaml(kWidth, kHeight) +
                    "camera_from_depth: {rotation_vector: [0, 0, 0], translation: [-0.5, 0, 0]}");
  const auto recording = open();
  ASSERT_TRUE(recording);
  // The depth camera is at x = 1, the colour camera half a metre to its right.
  EXPECT_NEAR(recording->read(1).value()->world_from_camera->translation().x(), 1.5, 1e-12);
}

TEST_F(TumRecordingTest, AssociationsDecideWhatIsPaired) {
  folder_.write("associations.txt", "0.0 rgb/0.png 0.1 depth/1.png\n");
  const auto recording = open();
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->size(), 1);
  EXPECT_EQ(recording->time(0), kStep);
  EXPECT_FLOAT_EQ(recording->read(0).value()->depth.at<float>(5, 5), 2.0F);
}

TEST_F(TumRecordingTest, UnpairedImagesAreAnEvent) {
  folder_.replace("rgb.txt", "0.1 ", "0.15 ");
  const auto recording = open();
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->size(), 2);
  const Events events = recording->take_events();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<FaultEvent>(events[0].body).message.find("1 of 3 depth images"), 0U);
  EXPECT_TRUE(recording->take_events().empty());
}

TEST_F(TumRecordingTest, TheGivenCameraTakesTheFilesPlace) {
  folder_.remove("camera.yaml");
  OpenOptions options;
  options.sensor = "left";
  options.camera = CameraFile{pinhole(kWidth, kHeight, 20, 20, 15, 11), std::nullopt};
  const auto recording = open(options);
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->sensor()->name, "left");
  EXPECT_EQ(recording->sensor()->depth_camera->fx, 20);
  EXPECT_TRUE(recording->sensor()->registered);
}

// What is wrong with lists and calibration is said when opening.
TEST_F(TumRecordingTest, BrokenRecordingsAreRefusedByNameWithARemedy) {
  struct Broken {
    std::function<void(const RecordedFolder&)> harm;
    std::string where;  // the end of it
    std::string what;   // a part of it
  };
  const std::vector<Broken> all = {
      {[](auto& f) { f.remove("camera.yaml"); }, "camera.yaml", "no camera file"},
      {[](auto& f) { f.replace("camera.yaml", "30.0", ".nan"); }, "camera.yaml:3", "camera_matrix"},
      {[](auto& f) { f.replace("camera.yaml", "30.0", "-30"); }, "camera.yaml:3", "focal length"},
      {[](auto& f) { f.replace("camera.yaml", "image_width: 32\n", ""); }, "camera.yaml:1",
       "image_width"},
      {[](auto& f) { f.write("camera_color.yaml", test::camera_yaml(kWidth, kHeight)); },
       "camera_color.yaml", "camera_from_depth"},
      {[](auto& f) { f.remove("rgb.txt"), f.remove("depth.txt"); }, "", "not a TUM recording"},
      {[](auto& f) { f.write("rgb.txt", ""); }, "rgb.txt", "empty"},
      {[](auto& f) { f.write("depth.txt", "# none\n"); }, "depth.txt", "empty"},
      {[](auto& f) { f.write("associations.txt", "\n"); }, "associations.txt", "empty"},
      {[](auto& f) { f.replace("rgb.txt", "0.1 ", "nan "); }, "rgb.txt:3", "not a time"},
      {[](auto& f) { f.replace("depth.txt", "0.1 ", "-0.1 "); }, "depth.txt:3", "not increase"},
      {[](auto& f) { f.replace("depth.txt", "0.1 ", ""); }, "depth.txt:3", "too short"},
      {[](auto& f) { f.replace("rgb.txt", "rgb/1.png", "../rgb/1.png"); }, "rgb.txt:3", "leaves"},
      {[](auto& f) { f.replace("rgb.txt", "rgb/1.png", "rgb/../../1.png"); }, "rgb.txt:3",
       "leaves"},
      {[](auto& f) { f.replace("depth.txt", "depth/2.png", "/etc/passwd"); }, "depth.txt:4",
       "leaves"},
      {[](auto& f) { f.write("rgb.txt", "9.0 rgb/0.png\n"); }, "", "within 20 ms"},
      {[](auto& f) { f.write("groundtruth.txt", "0 0 0 0 0 0 0 0\n"); }, "groundtruth.txt:1",
       "quaternion"},
  };
  for (const Broken& broken : all) {
    const RecordedFolder folder;
    test::write_small_recording(folder);
    broken.harm(folder);
    const auto recording = open_tum_recording(folder.path(), {});
    ASSERT_FALSE(recording) << broken.what;
    const Error& error = recording.error();
    EXPECT_EQ(error.where, (broken.where.empty() ? folder.path() : folder / broken.where).string());
    EXPECT_NE(error.what.find(broken.what), std::string::npos) << error.message();
    EXPECT_FALSE(error.remedy.empty()) << error.message();
    EXPECT_EQ(error.kind, Error::Kind::input);
  }
}

// As of a recording that was thinned by linking some of its images.
TEST_F(TumRecordingTest, LinksMadeByItsKeeperAreFollowed) {
  const RecordedFolder elsewhere;
  cv::imwrite(elsewhere / "1.png", test::color_image(kWidth, kHeight, 1));
  folder_.remove("rgb/1.png");
  fs::create_symlink(elsewhere / "1.png", folder_ / "rgb/1.png");
  EXPECT_TRUE(open());
}

TEST_F(TumRecordingTest, NoFolder) {
  const auto recording = open_tum_recording(folder_ / "absent", {});
  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().where, (folder_ / "absent").string());
}

// What is wrong with an image is said when reading it, and the next one is fine.
TEST_F(TumRecordingTest, BrokenFramesAreNamedAndPassedOver) {
  struct Broken {
    std::function<void(const RecordedFolder&)> harm;
    std::string where;
    std::string what;
  };
  const std::vector<Broken> all = {
      {[](auto& f) { f.remove("rgb/1.png"); }, "rgb/1.png", "cannot be read"},
      {[](auto& f) { f.write("rgb/1.png", ""); }, "rgb/1.png", "not a readable image"},
      {[](auto& f) { f.write("depth/1.png", "text"); }, "depth/1.png", "not a readable image"},
      {[](auto& f) { f.remove("rgb/1.png"), fs::create_directory(f / "rgb/1.png"); }, "rgb/1.png",
       "cannot be read"},
      {[](auto& f) { f.truncate("rgb/1.png", 0.5); }, "rgb/1.png", "ends early"},
      {[](auto& f) { f.truncate("depth/1.png", 0.9); }, "depth/1.png", "ends early"},
      {[](auto& f) { cv::imwrite(f / "rgb/1.png", test::color_image(16, 12, 1)); }, "rgb/1.png",
       "the colour image is 16x12, its camera 32x24"},
      {[](auto& f) { cv::imwrite(f / "depth/1.png", cv::Mat::ones(12, 16, CV_16UC1)); },
       "depth/1.png", "the depth image is 16x12, its camera 32x24"},
      {[](auto& f) { cv::imwrite(f / "depth/1.png", cv::Mat::ones(kHeight, kWidth, CV_8UC1)); },
       "depth/1.png", "1 channel(s) of 8 bits"},
      {[](auto& f) { cv::imwrite(f / "depth/1.png", test::color_image(kWidth, kHeight, 0)); },
       "depth/1.png", "3 channel(s) of 8 bits"},
  };
  for (const Broken& broken : all) {
    const RecordedFolder folder;
    test::write_small_recording(folder);
    broken.harm(folder);
    auto recording = open_tum_recording(folder.path(), {});
    ASSERT_TRUE(recording) << recording.error().message();
    const auto source = play(std::move(*recording), Loop::once);
    ASSERT_TRUE(source->next());
    const auto frame = source->next();
    ASSERT_FALSE(frame) << broken.what;
    EXPECT_EQ(frame.error().where, (folder / broken.where).string());
    EXPECT_NE(frame.error().what.find(broken.what), std::string::npos) << frame.error().message();
    EXPECT_FALSE(frame.error().remedy.empty());
    const auto after = source->next();
    ASSERT_TRUE(after) << after.error().message();
    EXPECT_EQ((*after)->index, 2);
    EXPECT_EQ(source->next().value(), nullptr);
  }
}

struct Known {
  std::int64_t frames;
  double known_depth;  // of the first frame's pixels at least
};

// Opens a real recording, checks its first and last frame and returns it.
std::unique_ptr<Recording> check_real(const fs::path& path, const Known& known) {
  auto recording = open_tum_recording(path, {});
  if (!recording) {
    ADD_FAILURE() << recording.error().message();
    return nullptr;
  }
  EXPECT_EQ((*recording)->size(), known.frames);
  for (const std::int64_t index : {std::int64_t{0}, known.frames - 1}) {
    const auto frame = (*recording)->read(index);
    if (!frame) {
      ADD_FAILURE() << frame.error().message();
      return nullptr;
    }
    EXPECT_EQ((*frame)->color.size(), cv::Size(640, 480));
    EXPECT_EQ((*frame)->depth.size(), cv::Size(640, 480));
    EXPECT_TRUE((*frame)->world_from_camera);
    const cv::Mat depth = (*frame)->depth;
    EXPECT_EQ(cv::countNonZero(depth <= 0), 0) << "unknown depth is NaN, not 0";
    // Indoors, and known where it is not NaN.
    const int plausible = cv::countNonZero((depth > 0.3) & (depth < 12));
    EXPECT_GT(plausible, known.known_depth * 640 * 480);
    EXPECT_EQ(plausible, cv::countNonZero(depth == depth));
  }
  return std::move(*recording);
}

TEST(TumRecordingReal, Redkitchen) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  const auto recording = check_real(path, {200, 0.7});
  ASSERT_TRUE(recording);
  const SensorInfo& sensor = *recording->sensor();
  EXPECT_FALSE(sensor.registered);
  EXPECT_EQ(sensor.color_camera->fx, 527.3);
  EXPECT_EQ(sensor.depth_camera->fx, 585);
  EXPECT_NEAR(sensor.color_from_depth.translation().x(), -0.0221, 1e-12);
  EXPECT_NEAR(sensor.rate, 30, 0.01);
  const auto first = recording->read(0).value()->world_from_camera->translation();
  EXPECT_NEAR((first - Eigen::Vector3d(-0.340456, 0.016470, 0.296569)).norm(), 0, 1e-9);
}

TEST(TumRecordingReal, Livingroom) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/livingroom");
  const auto recording = check_real(path, {100, 0.95});
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->sensor()->registered);
  const auto last = recording->read(99).value()->world_from_camera->translation();
  EXPECT_NEAR((last - Eigen::Vector3d(0.112844, -0.646588, 0.247977)).norm(), 0, 1e-9);
}

TEST(TumRecordingReal, Cabinet) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/cabinet");
  const auto recording = check_real(path, {58, 0.5});
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->sensor()->depth_camera->depth_units_per_metre, 5000);
}

}  // namespace
}  // namespace armsreach
