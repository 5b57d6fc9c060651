// The vision stages on a synthetic room: what they publish when the camera is lost, and with a map
// from another day.
#include "app/pipelines/vision_stages.hpp"

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"
#include "vision/alignment/frame_reducer.hpp"

namespace armsreach::app {
namespace {

Pose at(const Eigen::Vector3d& place) { return {Eigen::Quaterniond::Identity(), place}; }

class VisionStagesTest : public ::testing::Test {
 protected:
  FramePtr frame(const Pose& pose, std::int64_t index) const {
    return room_.frame(sensor_, pose, index);
  }

  // The map of `count` frames from a standing camera.
  MapStatePtr mapped(MappingStage& mapping, TrackingStage& tracking, int count) {
    MapStatePtr state;
    for (int i = 0; i < count; ++i) {
      state = mapping.process({tracking.process({frame(Pose(), i), state}), nullptr});
    }
    return state;
  }

  test::SyntheticRoom room_;
  SensorInfoPtr sensor_ = test::synthetic_sensor(320);
  TrackingConfig tracking_config_;
  MappingConfig mapping_config_;
};

TEST_F(VisionStagesTest, AMapFromAnotherDayIsEnteredAtItsOrigin) {
  MappingStage first_day(mapping_config_);
  TrackingStage first_tracking(tracking_config_, false);
  mapped(first_day, first_tracking, 4);

  const Camera camera = FrameReducer(sensor_, tracking_config_.width).camera();
  MappingStage mapping(mapping_config_, first_day.map(), camera);
  TrackingStage tracking(tracking_config_, true);
  ASSERT_TRUE(mapping.state());
  ASSERT_TRUE(mapping.state()->proposed);
  EXPECT_TRUE(mapping.state()->view);
  EXPECT_FALSE(mapping.state()->surface->blocks.empty());
  const auto tracked = tracking.process({frame(at({0.02, 0, 0}), 0), mapping.state()});
  EXPECT_EQ(tracked->state, TrackingState::relocalised);
  EXPECT_NEAR(tracked->world_from_camera.translation().x(), 0.02, 0.002);
}

TEST_F(VisionStagesTest, WithoutItsMapACameraInAKnownWorldIsLost) {
  TrackingStage tracking(tracking_config_, true);
  EXPECT_EQ(tracking.process({frame(Pose(), 0), nullptr})->state, TrackingState::lost);
}

TEST_F(VisionStagesTest, AProposalIsDrawnOnce) {
  MappingStage mapping(mapping_config_);
  TrackingStage tracking(tracking_config_, false);
  const MapStatePtr before = mapped(mapping, tracking, 4);
  EXPECT_FALSE(before->proposed);
  TrackedFrame lost = *tracking.process({frame(Pose(), 4), before});
  lost.state = TrackingState::lost;
  const auto lost_frame = std::make_shared<const TrackedFrame>(lost);
  const Pose there = at({0.1, 0, 0});
  const auto proposal = std::make_shared<const Proposal>(Proposal{lost.camera, there, 4});
  const MapStatePtr proposed = mapping.process({lost_frame, proposal});
  ASSERT_TRUE(proposed->proposed);
  EXPECT_EQ(proposed->proposed->frame, 4);
  EXPECT_TRUE(proposed->proposed->world_from_reference.translation() == there.translation());
  EXPECT_EQ(mapping.process({lost_frame, proposal})->proposed, proposed->proposed);
}

TEST_F(VisionStagesTest, LostFramesDoNotTouchTheMap) {
  MappingStage mapping(mapping_config_);
  TrackingStage tracking(tracking_config_, false);
  const MapStatePtr before = mapped(mapping, tracking, 4);
  const auto revision = mapping.state()->view->revision();
  TrackedFrame lost = *tracking.process({frame(Pose(), 4), before});
  lost.state = TrackingState::lost;
  for (int i = 0; i < 6; ++i)
    mapping.process({std::make_shared<const TrackedFrame>(lost), nullptr});
  EXPECT_EQ(mapping.state()->view->revision(), revision);
}

TEST_F(VisionStagesTest, NothingIsProposedWithoutKeyFrames) {
  RelocalisationStage relocalisation({});
  TrackingStage tracking(tracking_config_, true);
  EXPECT_FALSE(relocalisation.process(tracking.process({frame(Pose(), 0), nullptr})));
  EXPECT_FALSE(relocalisation.process(nullptr));
}

}  // namespace
}  // namespace armsreach::app
