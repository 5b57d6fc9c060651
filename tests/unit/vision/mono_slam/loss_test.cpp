// When the camera is said to be lost, and when a pose is only a prediction.
#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/pictures.hpp"
#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::mono_slam {
namespace {

// A camera that is held before a picture that fills its view.
class Loss : public testing::Test {
 protected:
  MonoResult step(const cv::Mat& grey, double commanded_turn = 0) {
    MonoInput input;
    input.time = timestamp_from_seconds(frame_++ / 30.0);
    input.grey = grey;
    input.control.emplace();
    input.control->before_from_after = Pose(so3_exp({0, commanded_turn, 0}), {0, 0, 0});
    input.control->rotation_sigma = 0.005 * commanded_turn;
    return slam_.step(input);
  }
  void settle() {
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(step(picture_).pose_seen) << i;
  }
  // Frames until `lost`, at most so many.
  int patience(const cv::Mat& grey, int most) {
    for (int i = 1; i <= most; ++i) {
      if (step(grey).state == TrackingState::lost) return i;
    }
    return most + 1;
  }

  const cv::Mat picture_ = test::speckles(320, 240, 3);
  const cv::Mat dark_ = cv::Mat::zeros(240, 320, CV_8UC1);
  const MonoSlamOptions options_;
  MonoSlam slam_{pinhole(320, 240, 264, 264, 159.5, 119.5), options_};
  int frame_ = 0;
};

TEST_F(Loss, ACoveredCameraIsLostAndItsPosesUntilThenArePredictions) {
  settle();
  for (int i = 1; i < options_.patience; ++i) {
    const MonoResult result = step(dark_);
    EXPECT_EQ(result.state, TrackingState::tracking) << i;
    EXPECT_FALSE(result.pose_seen) << i;
  }
  EXPECT_EQ(step(dark_).state, TrackingState::lost);
}

// A leap of 64 degrees to where nothing is mapped, in eight frames; and then somebody covers it.
TEST_F(Loss, ALeapExcusesBlindnessForASecondOnly) {
  settle();
  for (int i = 0; i < 8; ++i) {
    const MonoResult result = step(dark_, 0.14);
    EXPECT_EQ(result.state, TrackingState::tracking);
    EXPECT_FALSE(result.pose_seen);
  }
  const int frames = patience(dark_, 100);
  EXPECT_GT(frames, 20) << "time to find something to hold on to";
  EXPECT_LE(frames, 30 + options_.patience);
}

// Most of what is seen is exchanged while a strip of it stays: the strip's points agree, but as
// well may a strip of another place.
TEST_F(Loss, AFewOfManyPointsAreNotEnough) {
  settle();
  cv::Mat other = test::speckles(320, 240, 4);
  const cv::Rect strip(0, 0, 70, 240);
  picture_(strip).copyTo(other(strip));
  const MonoResult result = step(other);
  EXPECT_GE(result.inliers, options_.least_inliers);
  EXPECT_LT(3 * result.inliers, result.visible);
  EXPECT_EQ(result.state, TrackingState::tracking);
  EXPECT_FALSE(result.pose_seen);
}

}  // namespace
}  // namespace armsreach::mono_slam
