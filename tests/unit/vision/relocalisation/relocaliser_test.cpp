#include "vision/relocalisation/relocaliser.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/vision/relocalisation/painted_room.hpp"

namespace armsreach::relocalisation {
namespace {

using test::at;
using test::PaintedRoom;
using test::registered_sensor;
using test::tracked;
using test::unregistered_sensor;

double metres(const Pose& a, const Pose& b) { return (a.inverse() * b).translation().norm(); }
double radians(const Pose& a, const Pose& b) {
  return so3_log((a.inverse() * b).rotation()).norm();
}

Relocaliser mapped(const PaintedRoom& room, const std::shared_ptr<const SensorInfo>& sensor) {
  Relocaliser relocaliser{RelocaliserOptions()};
  for (int i = 0; i < 5; ++i) {
    relocaliser.consider(tracked(room.frame(sensor, at(0.2 * i - 0.4, 0.1 * i), i)));
  }
  return relocaliser;
}

TEST(Relocaliser, KeepsFramesThatAreFarInDistanceOrInAngle) {
  const PaintedRoom room(1);
  Relocaliser relocaliser{RelocaliserOptions()};
  const auto consider = [&](double x, double angle) {
    relocaliser.consider(tracked(room.frame(registered_sensor(), at(x, angle))));
    return relocaliser.key_frames().size();
  };
  EXPECT_EQ(consider(0, 0), 1U);
  EXPECT_EQ(consider(0.1, 0.1), 1U);
  EXPECT_EQ(consider(0.2, 0), 2U);
  EXPECT_EQ(consider(0, 0.2), 3U);
  EXPECT_EQ(consider(0.19, 0.01), 3U);  // near the second, not the last
}

TEST(Relocaliser, KeepsNothingThatIsNotTrustedOrHasNoColourOrNoDepth) {
  const PaintedRoom room(1);
  const FramePtr frame = room.frame(registered_sensor(), at(0, 0));
  Relocaliser relocaliser{RelocaliserOptions()};
  relocaliser.consider(tracked(frame, TrackingState::lost));
  relocaliser.consider(tracked(frame, TrackingState::relocalised));
  auto without_color = std::make_shared<Frame>(*frame);
  without_color->color = cv::Mat();
  relocaliser.consider(tracked(without_color));
  auto without_depth = std::make_shared<Frame>(*frame);
  without_depth->depth = cv::Mat();
  relocaliser.consider(tracked(without_depth));
  EXPECT_TRUE(relocaliser.key_frames().empty());
  EXPECT_FALSE(relocaliser.relocalise(*frame));
}

TEST(Relocaliser, DropsOneOfTheClosestTwoBeyondItsBound) {
  const PaintedRoom room(1);
  RelocaliserOptions options;
  options.most_key_frames = 3;
  Relocaliser relocaliser(options);
  for (const double x : {-0.6, 0.0, 0.17, 0.6}) {
    relocaliser.consider(tracked(room.frame(registered_sensor(), at(x, 0))));
  }
  ASSERT_EQ(relocaliser.key_frames().size(), 3U);
  const auto x_of = [&](int i) {
    return relocaliser.key_frames()[i]->world_from_color.translation().x();
  };
  EXPECT_DOUBLE_EQ(x_of(0), -0.6);
  EXPECT_DOUBLE_EQ(x_of(1), 0.17);
  EXPECT_DOUBLE_EQ(x_of(2), 0.6);
}

// Sub-pixel features on exact surfaces, several hundred of them: a tenth of the accuracy that is
// asked of a real camera, 5 cm and 5 deg.
constexpr double kMetres = 0.005;
constexpr double kRadians = 0.005;

TEST(Relocaliser, FindsAViewBetweenKeyFrames) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  const Pose truth(so3_exp({0.05, 0.13, -0.08}), {-0.12, 0.05, 0.08});
  const auto candidate = relocaliser.relocalise(*room.frame(registered_sensor(), truth));
  ASSERT_TRUE(candidate);
  EXPECT_LT(metres(candidate->world_from_camera, truth), kMetres);
  EXPECT_LT(radians(candidate->world_from_camera, truth), kRadians);
  EXPECT_GT(candidate->inliers, 50);
  EXPECT_GT(candidate->agreement, 0.95);
  EXPECT_GT(candidate->confidence, 0.5);
  EXPECT_LE(candidate->confidence, 1);
}

TEST(Relocaliser, GivesTheDepthCamerasPoseWhereColourIsNotRegistered) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, unregistered_sensor());
  const Pose truth = at(-0.12, 0.13);
  const auto candidate = relocaliser.relocalise(*room.frame(unregistered_sensor(), truth));
  ASSERT_TRUE(candidate);
  // The two cameras are 22 mm and 23 mrad apart.
  EXPECT_LT(metres(candidate->world_from_camera, truth), kMetres);
  EXPECT_LT(radians(candidate->world_from_camera, truth), kRadians);
}

TEST(Relocaliser, RecognisesAFrameWithoutDepth) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  const Pose truth = at(-0.12, 0.13);
  auto query = std::make_shared<Frame>(*room.frame(registered_sensor(), truth));
  auto colour_only = std::make_shared<SensorInfo>(*query->sensor);
  colour_only->depth_camera.reset();
  query->sensor = colour_only;
  query->depth = cv::Mat();
  const auto candidate = relocaliser.relocalise(*query);
  ASSERT_TRUE(candidate);
  EXPECT_LT(metres(candidate->world_from_camera, truth), kMetres);
  EXPECT_EQ(candidate->agreement, 0);
}

TEST(Relocaliser, RefusesWhatItCannotKnow) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  // The wall behind, which no key frame has seen.
  EXPECT_FALSE(relocaliser.relocalise(*room.frame(registered_sensor(), at(0, 3.0))));
  // A room of the same shape with other paintings, with depth and without.
  const PaintedRoom other(2);
  auto frame = std::make_shared<Frame>(*other.frame(registered_sensor(), at(0, 0.2)));
  EXPECT_FALSE(relocaliser.relocalise(*frame));
  frame->depth = cv::Mat();
  EXPECT_FALSE(relocaliser.relocalise(*frame));
  // Nothing to see.
  frame->color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 90, 90));
  EXPECT_FALSE(relocaliser.relocalise(*frame));
  frame->color = cv::Mat();
  EXPECT_FALSE(relocaliser.relocalise(*frame));
}

TEST(Relocaliser, RefusesAPictureOfThePlaceOnAWallOfAnotherDepth) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  auto frame = std::make_shared<Frame>(*room.frame(registered_sensor(), at(-0.12, 0.13)));
  frame->depth = cv::Mat(240, 320, CV_32FC1, cv::Scalar(0.6));
  EXPECT_FALSE(relocaliser.relocalise(*frame));
}

TEST(Relocaliser, DepthThatIsUnknownEverywhereIsNoContradiction) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  auto frame = std::make_shared<Frame>(*room.frame(registered_sensor(), at(-0.12, 0.13)));
  frame->depth = cv::Mat(240, 320, CV_32FC1, cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(relocaliser.relocalise(*frame));
}

TEST(Relocaliser, TheSameQuestionHasTheSameAnswer) {
  const PaintedRoom room(1);
  const Relocaliser relocaliser = mapped(room, registered_sensor());
  const FramePtr query = room.frame(registered_sensor(), at(0.1, 0.2));
  const auto first = relocaliser.relocalise(*query);
  (void)relocaliser.relocalise(*room.frame(registered_sensor(), at(-0.3, 0)));
  const auto again = relocaliser.relocalise(*query);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->world_from_camera.matrix(), again->world_from_camera.matrix());
  EXPECT_EQ(first->inliers, again->inliers);
  EXPECT_EQ(first->key_frame, again->key_frame);
}

}  // namespace
}  // namespace armsreach::relocalisation
