#include "app/pipelines/wearable_part.hpp"

#include <iterator>
#include <utility>

namespace armsreach::app {

WearablePart::WearablePart(const PartContext& context, HandsSetup setup, const SensorInfo& sensor,
                           std::shared_ptr<Gimbal> gimbal, const Eigen::Vector3d& up_in_world,
                           EventLog& log)
    : context_(context),
      log_(log),
      gimbal_(std::move(gimbal)),
      frames_(context.wiring.driving<TrackedFramePtr>()),
      to_gaze_(context.wiring.driving<SeenFrame>()),
      hand_news_(context.wiring, 0),
      gaze_news_(context.wiring, 0),
      objects_(context.wiring, context.config.lag),
      commands_(context.wiring, context.config.lag) {
  hands_ = std::make_unique<HandsNode>(
      std::make_unique<HandsStage>(std::move(setup)), [this] { return frames_->pop(); },
      context_.fault);
  if (gimbal_) join_gaze(sensor, up_in_world);
  hands_->outlet().connect(hand_news_.connection(),
                           [](const HandsOutput& output) { return output.news; });
  hands_->at_end([this] {
    frames_->close();
    hands_->outlet().close();
  });
}

// From a frame to the command that comes of it: lock-step that is certain, live it is what a
// picture and its stages take.
double WearablePart::command_delay(double rate) const {
  constexpr double kLive = 0.05;  // s
  return context_.wiring.pace == Pace::live ? kLive : (context_.config.lag - 1) / rate;
}

void WearablePart::join_gaze(const SensorInfo& sensor, const Eigen::Vector3d& up_in_world) {
  gaze_ = std::make_unique<GazeNode>(
      std::make_unique<GazeStage>(context_.config.gaze, gimbal_->model(),
                                  sensor.color_camera ? *sensor.color_camera : sensor.camera(),
                                  up_in_world, command_delay(sensor.rate)),
      [this]() -> std::optional<GazeStageInput> {
        auto seen = to_gaze_->pop();
        if (!seen) return std::nullopt;
        std::optional<GimbalState> state;
        if (seen->tracked) state = gimbal_->state_at(seen->tracked->frame->time);
        return GazeStageInput{*std::move(seen), state, objects_told_ ? objects_.take() : nullptr};
      },
      context_.fault);
  hands_->outlet().connect(to_gaze_, [](const HandsOutput& output) { return output.seen; });
  gaze_->outlet().connect(commands_.connection(),
                          [](const GazeOutput& output) { return output.command; });
  gaze_->outlet().connect(gaze_news_.connection(), [](const GazeOutput& output) {
    return HandNews{output.events, {}};
  });
  gaze_->at_end([this] {
    to_gaze_->close();
    objects_.connection()->close();
    gaze_->outlet().close();
  });
}

void WearablePart::look_at_objects(Outlet<ComposedPtr>& composed) {
  if (!gaze_) return;
  objects_told_ = true;
  composed.connect(objects_.connection(), [](const ComposedPtr& made) -> ObjectPlacesPtr {
    if (!made) return nullptr;
    auto places = std::make_shared<ObjectPlaces>();
    for (const render::VirtualObject& object : made->scene->objects)
      places->emplace(object.id, object.world_from_object.translation());
    return places;
  });
}

std::vector<HandNews> WearablePart::take_news() {
  std::vector<HandNews> news = hand_news_.take();
  if (!gaze_) return news;
  std::vector<HandNews> more = gaze_news_.take();
  news.insert(news.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
  return news;
}

void WearablePart::close_composing() {
  hand_news_.connection()->close();
  gaze_news_.connection()->close();
}

// Lock-step, the command of a fixed number of frames ago, so that which frame it moves the camera
// in does not depend on who was faster.
void WearablePart::command_gimbal() {
  if (!gaze_) return;
  const CommandPtr& command = commands_.take();
  if (!command) return;
  const Status status = gimbal_->command(*command);
  if (status || std::exchange(command_failed_, true)) return;
  log_.write({command->time, FaultEvent{"gaze", status.error().what, status.error().remedy}});
}

void WearablePart::close_capture() { commands_.connection()->close(); }

std::vector<PartNode> WearablePart::nodes() {
  std::vector<PartNode> all{{hands_.get(), [this] { return frames_->drops(); }}};
  if (gaze_) all.push_back({gaze_.get(), [this] { return to_gaze_->drops(); }});
  return all;
}

}  // namespace armsreach::app
