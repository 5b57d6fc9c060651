// The wearable experience: the wearer's hands, and where the sensor is carried by a gimbal, the
// gaze that follows them.
//
//   tracked frames -> hands -> outlet
//                       |  |
//                       |  +-> gaze -> gimbal, before a later frame is read
//                       |       |
//                       +-------+----> news for composing
#pragma once

#include <memory>
#include <vector>

#include "app/pipelines/composer.hpp"
#include "app/pipelines/gaze_stage.hpp"
#include "app/pipelines/hands_stage.hpp"
#include "app/pipelines/part.hpp"
#include "app/runtime/event_log.hpp"
#include "devices/gimbal.hpp"

namespace armsreach::app {

class WearablePart {
 public:
  // `gimbal` carries the sensor; null where none does. `up_in_world` is zero where nobody knows.
  WearablePart(const PartContext& context, HandsSetup setup, const SensorInfo& sensor,
               std::shared_ptr<Gimbal> gimbal, const Eigen::Vector3d& up_in_world, EventLog& log);

  const std::shared_ptr<Connection<TrackedFramePtr>>& input() const { return frames_; }
  Outlet<HandsOutput>& outlet() { return hands_->outlet(); }
  std::vector<PartNode> nodes();  // in the order of the data

  // What is new since the last time; to be taken once a frame by whoever composes.
  std::vector<HandNews> take_news();
  void close_composing();  // nobody takes any more

  // What was composed tells the gaze where inserted objects are.
  void look_at_objects(Outlet<ComposedPtr>& composed);

  // Gives the gimbal the command that is due; to be called once before every frame is read.
  void command_gimbal();
  void close_capture();  // no frame will be read any more

 private:
  using HandsNode = StageNode<TrackedFramePtr, HandsOutput>;
  using GazeNode = StageNode<GazeStageInput, GazeOutput>;
  using CommandPtr = std::shared_ptr<const GimbalCommand>;

  double command_delay(double rate) const;
  void join_gaze(const SensorInfo& sensor, const Eigen::Vector3d& up_in_world);

  const PartContext& context_;
  EventLog& log_;
  std::shared_ptr<Gimbal> gimbal_;
  std::shared_ptr<Connection<TrackedFramePtr>> frames_;
  std::shared_ptr<Connection<SeenFrame>> to_gaze_;
  FollowingEvents<HandNews> hand_news_;
  FollowingEvents<HandNews> gaze_news_;
  Following<ObjectPlacesPtr> objects_;
  Following<CommandPtr> commands_;

  bool objects_told_ = false;
  bool command_failed_ = false;  // and that has been told

  std::unique_ptr<HandsNode> hands_;
  std::unique_ptr<GazeNode> gaze_;  // null without a gimbal
};

}  // namespace armsreach::app
