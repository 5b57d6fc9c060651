#include "app/pipelines/workspace_part.hpp"

#include <utility>

#include "vision/alignment/frame_reducer.hpp"

namespace armsreach::app {

WorkspacePart::WorkspacePart(const PartContext& context, const SensorInfoPtr& sensor,
                             Outlet<FramePtr>& frames, SavedWorld world)
    : context_(context),
      frames_(context.wiring.driving<FramePtr>()),
      to_register_(context.wiring.driving<FramePtr>()),
      to_map_(context.wiring.driving<TrackedFramePtr>()),
      to_relocalise_(context.wiring.driving<TrackedFramePtr>()),
      registration_for_tracking_(context.wiring, context.config.lag),
      registration_for_composing_(context.wiring, context.config.lag),
      map_for_tracking_(context.wiring, context.config.lag),
      map_for_composing_(context.wiring, context.config.lag),
      proposal_(context.wiring, context.config.lag) {
  frames.connect(frames_);
  if (!sensor->registration_stated) join_registration(sensor, frames);
  join_tracking(world.map.has_value());
  if (!context_.config.mapping.enabled) return;
  join_relocalisation(world.key_frames);
  join_mapping(sensor, std::move(world.map));
}

void WorkspacePart::join_registration(const SensorInfoPtr& sensor, Outlet<FramePtr>& frames) {
  registration_ = std::make_unique<RegistrationNode>(
      std::make_unique<RegistrationStage>(sensor), [this] { return to_register_->pop(); },
      context_.fault);
  frames.connect(to_register_);
  registration_->outlet().connect(registration_for_tracking_.connection());
  registration_->outlet().connect(registration_for_composing_.connection());
  registration_->at_end([this] {
    to_register_->close();
    registration_->outlet().close();
  });
}

void WorkspacePart::join_tracking(bool map_exists) {
  tracking_ = std::make_unique<TrackingNode>(
      std::make_unique<TrackingStage>(context_.config.tracking, map_exists),
      [this]() -> std::optional<TrackInput> {
        auto frame = frames_->pop();
        if (!frame) return std::nullopt;
        return TrackInput{*frame, mapping_ ? map_for_tracking_.take() : nullptr,
                          registration_ ? registration_for_tracking_.take() : nullptr};
      },
      context_.fault);
  tracking_->at_end([this] {
    frames_->close();
    map_for_tracking_.connection()->close();
    registration_for_tracking_.connection()->close();
    tracking_->outlet().close();
  });
}

void WorkspacePart::join_relocalisation(const relocalisation::KeyFrames& known) {
  auto stage = std::make_unique<RelocalisationStage>(known);
  relocalisation_stage_ = stage.get();
  relocalisation_ = std::make_unique<RelocalisationNode>(
      std::move(stage), [this] { return to_relocalise_->pop(); }, context_.fault);
  tracking_->outlet().connect(to_relocalise_);
  relocalisation_->outlet().connect(proposal_.connection());
  relocalisation_->at_end([this] {
    to_relocalise_->close();
    proposal_.connection()->close();
  });
}

void WorkspacePart::join_mapping(const SensorInfoPtr& sensor,
                                 std::optional<mapping::VoxelMap> map) {
  const Config& config = context_.config;
  std::unique_ptr<MappingStage> stage;
  if (map) {
    const Camera camera = FrameReducer(sensor, config.tracking.width).camera();
    stage = std::make_unique<MappingStage>(config.mapping, *std::move(map), camera);
    map_for_tracking_.start_with(stage->state());
    map_for_composing_.start_with(stage->state());
  } else {
    stage = std::make_unique<MappingStage>(config.mapping);
  }
  mapping_stage_ = stage.get();
  mapping_ = std::make_unique<MappingNode>(
      std::move(stage),
      [this]() -> std::optional<MapInput> {
        auto tracked = to_map_->pop();
        if (!tracked) return std::nullopt;
        return MapInput{*tracked, proposal_.take()};
      },
      context_.fault);
  tracking_->outlet().connect(to_map_);
  mapping_->outlet().connect(map_for_tracking_.connection());
  mapping_->outlet().connect(map_for_composing_.connection());
  mapping_->at_end([this] {
    to_map_->close();
    proposal_.connection()->close();
    mapping_->outlet().close();
  });
}

void WorkspacePart::close_composing() {
  map_for_composing_.connection()->close();
  registration_for_composing_.connection()->close();
}

std::vector<PartNode> WorkspacePart::nodes() {
  std::vector<PartNode> all;
  if (registration_) all.push_back({registration_.get(), [this] { return to_register_->drops(); }});
  all.push_back({tracking_.get(), [this] { return frames_->drops(); }});
  if (relocalisation_)
    all.push_back({relocalisation_.get(), [this] { return to_relocalise_->drops(); }});
  if (mapping_) all.push_back({mapping_.get(), [this] { return to_map_->drops(); }});
  return all;
}

}  // namespace armsreach::app
