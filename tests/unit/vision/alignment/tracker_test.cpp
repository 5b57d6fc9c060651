#include "vision/alignment/tracker.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"

namespace armsreach {
namespace {

using test::SyntheticRoom;

const Pose kStart(so3_exp({-0.25, 0.1, 0}), Eigen::Vector3d(0, -0.5, 0.3));

Pose path(int frame) {
  const double t = 0.1 * frame;
  Vector6d tangent;
  tangent << 0.08 * std::sin(t), 0.03 * std::sin(1.3 * t), 0.04 * (1 - std::cos(t)),
      0.04 * std::sin(0.7 * t), 0.07 * std::sin(t), 0.03 * std::sin(t);
  return kStart * Pose::exp(tangent);
}

FramePtr frame_at(const SyntheticRoom& room, int index, const Pose& pose) {
  static const auto sensor = test::synthetic_sensor(320);  // rendered four times as fast
  return room.frame(sensor, pose, index);
}

// As noisy, once reduced to 80 pixels, as a Kinect.
SyntheticRoom kinect_room() {
  SyntheticRoom room;
  room.depth_noise = 0.7e-3;
  room.intensity_noise = 0.005;
  return room;
}

TrackerOptions options(OwnReference own = OwnReference::key_frame) {
  TrackerOptions out;
  out.own_reference = own;
  out.start = kStart;
  return out;
}

double distance(const Pose& a, const Pose& b) { return (a.translation() - b.translation()).norm(); }

// What a map would draw: the room seen exactly.
ReferenceViewPtr drawn(const SyntheticRoom& room, const Pose& pose, std::int64_t frame) {
  const FramePtr seen = frame_at(room, 0, pose);
  const FrameReducer reducer(seen->sensor, 80);
  const ReducedFrame reduced = reducer.reduce(*seen);
  return std::make_shared<ReferenceView>(
      ReferenceView{reducer.camera(), pose, reduced.depth, reduced.intensity, frame});
}

FramePtr covered(const FramePtr& frame) {
  auto out = std::make_shared<Frame>(*frame);
  out->depth = cv::Mat(240, 320, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  out->color = cv::Mat(240, 320, CV_8UC1, cv::Scalar(3));
  return out;
}

TEST(Tracker, StartsWhereItIsTold) {
  Tracker tracker(options());
  const TrackedFrame first = tracker.track(frame_at(SyntheticRoom(), 0, kStart), nullptr);
  EXPECT_EQ(first.state, TrackingState::initialising);
  EXPECT_EQ(first.world_from_camera.matrix(), kStart.matrix());
  EXPECT_TRUE(first.weights.empty());
  EXPECT_EQ(first.camera.width, 80);
  EXPECT_EQ(first.depth.size(), cv::Size(80, 60));
}

TEST(Tracker, GoesOnInitialisingUntilItSeesSomething) {
  Tracker tracker(options());
  for (int i = 0; i < 3; ++i) {
    const auto blind = tracker.track(covered(frame_at(SyntheticRoom(), i, kStart)), nullptr);
    EXPECT_EQ(blind.state, TrackingState::initialising);
  }
  EXPECT_EQ(tracker.track(frame_at(SyntheticRoom(), 3, kStart), nullptr).state,
            TrackingState::initialising);
  EXPECT_EQ(tracker.track(frame_at(SyntheticRoom(), 4, kStart), nullptr).state,
            TrackingState::tracking);
}

TEST(Tracker, TakesOverAColorCameraThatBecomesKnown) {
  const SyntheticRoom room;
  Tracker tracker(options());
  const FramePtr assumed = frame_at(room, 0, kStart);
  tracker.track(assumed, nullptr);
  auto sensor = std::make_shared<SensorInfo>(*assumed->sensor);
  sensor->registered = false;
  sensor->color_camera->cx += 40;
  auto known = std::make_shared<Frame>(*frame_at(room, 1, kStart));
  known->sensor = sensor;
  const TrackedFrame tracked = tracker.track(known, nullptr);
  EXPECT_EQ(tracked.state, TrackingState::tracking);
  EXPECT_LT(distance(tracked.world_from_camera, kStart), 0.01);  // depth has not moved
  const float seen = tracked.intensity.at<float>(30, 40);
  EXPECT_EQ(seen, FrameReducer(sensor, 80).reduce(*known).intensity.at<float>(30, 40));
  EXPECT_NE(seen, FrameReducer(assumed->sensor, 80).reduce(*known).intensity.at<float>(30, 40));
}

TEST(Tracker, FollowsAHandHeldPathAndKeyFramesDriftLess) {
  const SyntheticRoom room = kinect_room();
  std::vector<double> worst;
  for (const OwnReference own : {OwnReference::previous_frame, OwnReference::key_frame}) {
    Tracker tracker(options(own));
    double most = 0;
    for (int i = 0; i < 40; ++i) {
      const TrackedFrame tracked = tracker.track(frame_at(room, i, path(i)), nullptr);
      EXPECT_EQ(tracked.state, i == 0 ? TrackingState::initialising : TrackingState::tracking);
      if (own == OwnReference::previous_frame) {
        EXPECT_EQ(tracked.reference, i - 1);
      }
      most = std::max(most, distance(tracked.world_from_camera, path(i)));
    }
    worst.push_back(most);
  }
  EXPECT_LT(worst[0], 0.03);  // steps of 8 mm under a Kinect's noise
  EXPECT_LT(worst[1], 0.01);
  EXPECT_LT(worst[1], worst[0]);
}

TEST(Tracker, HoldsToAMapThatIsThreeFramesBehind) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options(OwnReference::previous_frame));
  for (int i = 0; i < 40; ++i) {
    const ReferenceViewPtr map = i < 3 ? nullptr : drawn(SyntheticRoom(), path(i - 3), i - 3);
    const TrackedFrame tracked = tracker.track(frame_at(room, i, path(i)), map);
    if (i < 3) continue;
    EXPECT_EQ(tracked.state, TrackingState::tracking);
    EXPECT_EQ(tracked.reference, i - 3);
    EXPECT_LT(distance(tracked.world_from_camera, path(i)), 0.004) << i;
    EXPECT_EQ(tracked.weights.size(), tracked.depth.size());
    EXPECT_NEAR(tracked.rms, 1, 0.5);
  }
}

TEST(Tracker, TwoRunsAgreeToTheBit) {
  const SyntheticRoom room = kinect_room();
  Tracker a(options());
  Tracker b(options());
  for (int i = 0; i < 8; ++i) {
    const FramePtr frame = frame_at(room, i, path(i));
    EXPECT_EQ(a.track(frame, nullptr).world_from_camera.matrix(),
              b.track(frame, nullptr).world_from_camera.matrix());
  }
}

TEST(Tracker, IsLostWhenCoveredAndFindsItselfAgain) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options());
  int i = 0;
  for (; i < 6; ++i) tracker.track(frame_at(room, i, path(i)), nullptr);
  for (; i < 12; ++i) {
    const TrackedFrame tracked = tracker.track(covered(frame_at(room, i, path(i))), nullptr);
    EXPECT_EQ(tracked.state, TrackingState::lost);
    EXPECT_FALSE(trusted(tracked));
    EXPECT_TRUE(tracked.world_from_camera.is_finite());
  }
  for (; i < 15; ++i) {
    const TrackedFrame tracked = tracker.track(frame_at(room, i, path(i)), nullptr);
    EXPECT_EQ(tracked.state, TrackingState::tracking) << i;
    EXPECT_LT(distance(tracked.world_from_camera, path(i)), 0.01);
  }
}

TEST(Tracker, AdmitsThatItCannotFollowAJump) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options());
  for (int i = 0; i < 6; ++i) tracker.track(frame_at(room, i, path(i)), nullptr);
  const Pose elsewhere(so3_exp({0.1, -2.2, 0}), Eigen::Vector3d(0.8, -0.3, 0.2));
  for (int i = 6; i < 12; ++i) {
    EXPECT_EQ(tracker.track(frame_at(room, i, elsewhere), nullptr).state, TrackingState::lost);
  }
}

// Carried away under a cover: 0.9 m and 60 deg from where it was seen last.
const Pose kElsewhere(so3_exp({-0.2, -0.9, 0}), Eigen::Vector3d(0.8, -0.4, 0.1));

TEST(Tracker, GoesOnFromAProposedPlaceThatIsRight) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options());
  ReferenceViewPtr old_map;
  int i = 0;
  for (; i < 6; ++i) {
    old_map = drawn(SyntheticRoom(), path(i), i);
    tracker.track(frame_at(room, i, path(i)), old_map);
  }
  for (; i < 20; ++i) tracker.track(covered(frame_at(room, i, path(i))), old_map);
  EXPECT_EQ(tracker.track(frame_at(room, i, kElsewhere), old_map).state, TrackingState::lost);
  // The proposal is 4 cm and 3 deg off, as it is when the camera moved on while it was computed.
  Vector6d moved;
  moved << 0.03, -0.01, 0.025, 0.03, 0.04, -0.02;
  const ReferenceViewPtr proposed = drawn(SyntheticRoom(), kElsewhere * Pose::exp(moved), i);
  const TrackedFrame found = tracker.track(frame_at(room, ++i, kElsewhere), old_map, proposed);
  EXPECT_EQ(found.state, TrackingState::relocalised);
  EXPECT_FALSE(trusted(found));  // its successor is
  EXPECT_EQ(found.reference, proposed->frame);
  EXPECT_LT(distance(found.world_from_camera, kElsewhere), 0.01);
  // A map that has not heard of it yet does not lead it astray.
  for (int k = 0; k < 4; ++k) {
    const TrackedFrame on = tracker.track(frame_at(room, ++i, kElsewhere), old_map, proposed);
    EXPECT_EQ(on.state, TrackingState::tracking);
    EXPECT_LT(distance(on.world_from_camera, kElsewhere), 0.01);
  }
}

TEST(Tracker, DoesNotBelieveAProposedPlaceThatIsWrong) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options());
  int i = 0;
  for (; i < 6; ++i) tracker.track(frame_at(room, i, path(i)), nullptr);
  const Pose wrong[] = {Pose(so3_exp({-0.2, 0.9, 0}), Eigen::Vector3d(-0.8, -0.4, 0.1)),
                        kElsewhere * Pose(so3_exp({0, 0.5, 0}), Eigen::Vector3d(0.3, 0, 0)),
                        kStart};
  for (const Pose& pose : wrong) {
    const ReferenceViewPtr proposed = drawn(SyntheticRoom(), pose, i);
    const TrackedFrame still = tracker.track(frame_at(room, ++i, kElsewhere), nullptr, proposed);
    EXPECT_EQ(still.state, TrackingState::lost);
  }
}

TEST(Tracker, AProposedPlaceSaysNothingToACameraThatIsNotLost) {
  const SyntheticRoom room = kinect_room();
  Tracker tracker(options());
  const ReferenceViewPtr proposed = drawn(SyntheticRoom(), kElsewhere, 0);
  for (int i = 0; i < 4; ++i) {
    const TrackedFrame tracked = tracker.track(frame_at(room, i, path(i)), nullptr, proposed);
    EXPECT_LT(distance(tracked.world_from_camera, path(i)), 0.01);
    EXPECT_NE(tracked.state, TrackingState::relocalised);
  }
}

TEST(Tracker, IsLostInAKnownMapUntilItIsFound) {
  const SyntheticRoom room = kinect_room();
  TrackerOptions anywhere = options();
  anywhere.start.reset();
  Tracker tracker(anywhere);
  EXPECT_EQ(tracker.track(frame_at(room, 0, kElsewhere), nullptr).state, TrackingState::lost);
  const ReferenceViewPtr wrong = drawn(SyntheticRoom(), kStart, 0);
  EXPECT_EQ(tracker.track(frame_at(room, 1, kElsewhere), nullptr, wrong).state,
            TrackingState::lost);
  const ReferenceViewPtr right = drawn(SyntheticRoom(), kElsewhere, 0);
  EXPECT_EQ(tracker.track(frame_at(room, 2, kElsewhere), nullptr, right).state,
            TrackingState::relocalised);
  EXPECT_EQ(tracker.track(frame_at(room, 3, kElsewhere), nullptr).state, TrackingState::tracking);
}

TEST(Tracker, AdmitsThatABlankWallTellsNothing) {
  SyntheticRoom room = kinect_room();
  room.furniture.clear();
  room.textured = false;
  const auto at = [](int i) {
    return Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.01 * i, 0, 2.3));
  };
  for (const double alpha : {0.0, 0.95, 1.0}) {
    TrackerOptions blank = options();
    blank.aligner.alpha = alpha;
    Tracker tracker(blank);
    tracker.track(frame_at(room, 0, at(0)), nullptr);
    for (int i = 1; i < 4; ++i) {
      EXPECT_EQ(tracker.track(frame_at(room, i, at(i)), nullptr).state, TrackingState::lost);
    }
  }
}

TEST(Tracker, FollowsColourAloneInAKnownMap) {
  const SyntheticRoom room = kinect_room();
  TrackerOptions monocular = options();
  monocular.aligner.alpha = 0;
  Tracker tracker(monocular);
  for (int i = 0; i < 30; ++i) {
    auto frame = std::make_shared<Frame>(*frame_at(room, i, path(i)));
    frame->depth.release();
    const ReferenceViewPtr map = drawn(SyntheticRoom(), path(std::max(0, i - 3)), i - 3);
    const TrackedFrame tracked = tracker.track(frame, map);
    EXPECT_EQ(tracked.state, TrackingState::tracking) << i;
    EXPECT_TRUE(tracked.depth.empty());
    EXPECT_LT(distance(tracked.world_from_camera, path(i)), 0.02) << i;
  }
}

TEST(Tracker, FallsBackToItsOwnReferenceWhenTheMapDoesNotFit) {
  const SyntheticRoom room = kinect_room();
  SyntheticRoom wrong;
  wrong.walls = {{-1, -1, -1}, {1, 1, 1.5}};
  wrong.furniture.clear();
  Tracker tracker(options());
  for (int i = 0; i < 8; ++i) {
    const ReferenceViewPtr map = i < 4 ? nullptr : drawn(wrong, kStart, 0);
    const TrackedFrame tracked = tracker.track(frame_at(room, i, path(i)), map);
    EXPECT_LT(distance(tracked.world_from_camera, path(i)), 0.01) << i;
    EXPECT_NE(tracked.state, TrackingState::lost);
  }
}

}  // namespace
}  // namespace armsreach
