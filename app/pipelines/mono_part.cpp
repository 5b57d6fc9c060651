#include "app/pipelines/mono_part.hpp"

#include <utility>

namespace armsreach::app {

MonoPart::MonoPart(const PartContext& context, const SensorInfo& sensor, const MonoSetup& setup,
                   Outlet<FramePtr>& frames, std::shared_ptr<Gimbal> gimbal)
    : gimbal_(std::move(gimbal)),
      frames_(context.wiring.driving<FramePtr>()),
      hands_(context.wiring, context.config.lag),
      news_(context.wiring, 0) {
  frames.connect(frames_);
  auto stage = std::make_unique<MonoStage>(
      sensor, setup, gimbal_ ? std::optional(gimbal_->model()) : std::nullopt);
  stage_ = stage.get();
  node_ = std::make_unique<MonoNode>(
      std::move(stage),
      [this]() -> std::optional<MonoStageInput> {
        auto frame = frames_->pop();
        if (!frame) return std::nullopt;
        return MonoStageInput{*frame, hands_known_ ? hands_.take() : nullptr,
                              gimbal_ ? gimbal_->state_at((*frame)->time) : std::nullopt};
      },
      context.fault);
  node_->outlet().connect(news_.connection(), [](const MonoStageOutput& output) {
    return HandNews{output.events, {}};
  });
  node_->at_end([this] {
    frames_->close();
    hands_.connection()->close();
    node_->outlet().close();
  });
}

void MonoPart::look_out_for_hands(Outlet<HandsOutput>& hands) {
  hands_known_ = true;
  hands.connect(hands_.connection(), [](const HandsOutput& output) { return output.seen.hands; });
}

std::vector<PartNode> MonoPart::nodes() {
  return {{node_.get(), [this] { return frames_->drops(); }}};
}

}  // namespace armsreach::app
