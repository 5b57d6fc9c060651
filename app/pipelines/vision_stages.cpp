#include "app/pipelines/vision_stages.hpp"

#include <utility>

#include "app/runtime/output_file.hpp"
#include "vision/mapping/octree_codec.hpp"

namespace armsreach::app {
namespace {

TrackerOptions tracker_options(const TrackingConfig& config) {
  TrackerOptions options;
  options.aligner.alpha = config.alpha;
  options.aligner.iterations.assign(options.aligner.iterations.size(), config.iterations);
  options.width = config.width;
  return options;
}

mapping::MapperOptions mapper_options(const MappingConfig& config) {
  mapping::MapperOptions options;
  options.map.resolution = config.resolution;
  return options;
}

}  // namespace

TrackingStage::TrackingStage(const TrackingConfig& config) : tracker_(tracker_options(config)) {}

TrackedFramePtr TrackingStage::process(const TrackInput& input) {
  return std::make_shared<const TrackedFrame>(
      tracker_.track(input.frame, input.map ? input.map->reference : nullptr));
}

MappingStage::MappingStage(const MappingConfig& config)
    : mapper_(mapper_options(config)), surface_(config.resolution) {}

MapStatePtr MappingStage::process(const TrackedFramePtr& tracked) {
  if (!tracked) return state_;
  mapping::MapUpdate update = mapper_.process(*tracked);
  auto state = state_ ? std::make_shared<MapState>(*state_) : std::make_shared<MapState>();
  if (update.reference) state->reference = std::move(update.reference);
  if (update.view) state->view = std::move(update.view);
  state->surface = surface_.apply(update.surface);
  state_ = std::move(state);
  return state_;
}

Status MappingStage::save(const std::string& path) const {
  return write_file(path,
                    [&](std::ostream& out) { mapping::write_octree(out, mapper_.map().grid()); });
}

}  // namespace armsreach::app
