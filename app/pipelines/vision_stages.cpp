#include "app/pipelines/vision_stages.hpp"

#include <utility>

namespace armsreach::app {
namespace {

TrackerOptions tracker_options(const TrackingConfig& config, bool map_exists) {
  TrackerOptions options;
  options.aligner.alpha = config.alpha;
  if (config.iterations > 0) {
    options.aligner.iterations.assign(default_iterations(config.width).size(), config.iterations);
  }
  options.width = config.width;
  if (map_exists) options.start.reset();
  return options;
}

}  // namespace

mapping::MapperOptions mapper_options(const MappingConfig& config) {
  mapping::MapperOptions options;
  options.map.resolution = config.resolution;
  return options;
}

TrackingStage::TrackingStage(const TrackingConfig& config, bool map_exists)
    : tracker_(tracker_options(config, map_exists)) {}

TrackedFramePtr TrackingStage::process(const TrackInput& input) {
  const MapState none;
  const MapState& map = input.map ? *input.map : none;
  return std::make_shared<const TrackedFrame>(tracker_.track(
      with_known_color(input.frame, input.registration), map.reference, map.proposed));
}

RelocalisationStage::RelocalisationStage(const relocalisation::KeyFrames& known)
    : relocaliser_(relocalisation::RelocaliserOptions{}) {
  for (const auto& key_frame : known) relocaliser_.put(key_frame);
}

ProposalPtr RelocalisationStage::process(const TrackedFramePtr& tracked) {
  if (!tracked) return nullptr;
  if (tracked->state != TrackingState::lost) {
    relocaliser_.consider(*tracked);
    return nullptr;
  }
  const auto candidate = relocaliser_.relocalise(*tracked->frame);
  if (!candidate) return nullptr;
  return std::make_shared<const Proposal>(
      Proposal{tracked->camera, candidate->world_from_camera, tracked->frame->index});
}

MappingStage::MappingStage(const MappingConfig& config)
    : mapper_(mapper_options(config)), surface_(config.resolution) {}

MappingStage::MappingStage(const MappingConfig& config, mapping::VoxelMap map, const Camera& camera)
    : mapper_(mapper_options(config), std::move(map)), surface_(mapper_.map().grid().resolution) {
  auto state = std::make_shared<MapState>();
  state->proposed = mapper_.reference(camera, Pose(), -1);
  state->view = mapper_.take_view();
  state->surface = surface_.apply(mapper_.take_surface());
  state_ = std::move(state);
}

MapStatePtr MappingStage::process(const MapInput& input) {
  if (!input.tracked) return state_;
  mapping::MapUpdate update = mapper_.process(*input.tracked);
  auto state = state_ ? std::make_shared<MapState>(*state_) : std::make_shared<MapState>();
  if (update.reference) state->reference = std::move(update.reference);
  if (update.view) state->view = std::move(update.view);
  state->surface = surface_.apply(update.surface);
  if (input.proposal && input.proposal != proposal_) {
    proposal_ = input.proposal;
    state->proposed =
        mapper_.reference(proposal_->camera, proposal_->world_from_camera, proposal_->frame);
  }
  state_ = std::move(state);
  return state_;
}

}  // namespace armsreach::app
