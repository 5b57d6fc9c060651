// Tracks a plain camera on the way from the sensor to whoever looks at its frames.
//
//   frames -> mono_slam -> outlet
//               ^   |
//   hands, gimbal   +----> news for composing
#pragma once

#include <memory>
#include <vector>

#include "app/pipelines/mono_stage.hpp"
#include "app/pipelines/part.hpp"
#include "devices/gimbal.hpp"

namespace armsreach::app {

class MonoPart {
 public:
  // `gimbal` carries the sensor; null where none does.
  MonoPart(const PartContext& context, const SensorInfo& sensor, const MonoSetup& setup,
           Outlet<FramePtr>& frames, std::shared_ptr<Gimbal> gimbal);

  Outlet<MonoStageOutput>& outlet() { return node_->outlet(); }
  // Where hands are, so that nothing is mapped on them.
  void look_out_for_hands(Outlet<HandsOutput>& hands);
  std::vector<PartNode> nodes();

  std::vector<HandNews> take_news() { return news_.take(); }
  void close_composing() { news_.connection()->close(); }

  const MonoStage& stage() const { return *stage_; }  // after the run
  const LatencyHistogram& spent() const { return node_->statistics().processing; }

 private:
  using MonoNode = StageNode<MonoStageInput, MonoStageOutput>;

  std::shared_ptr<Gimbal> gimbal_;
  std::shared_ptr<Connection<FramePtr>> frames_;
  Following<HandsStatePtr> hands_;
  bool hands_known_ = false;
  FollowingEvents<HandNews> news_;
  std::unique_ptr<MonoNode> node_;
  MonoStage* stage_ = nullptr;  // owned by its node
};

}  // namespace armsreach::app
