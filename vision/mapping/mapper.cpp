#include "vision/mapping/mapper.hpp"

#include <utility>

namespace armsreach::mapping {

Mapper::Mapper(const MapperOptions& options) : Mapper(options, VoxelMap(options.map)) {}

Mapper::Mapper(const MapperOptions& options, VoxelMap map)
    : options_(options), map_(std::move(map)) {}

MapUpdate Mapper::process(const TrackedFrame& tracked) {
  MapUpdate update;
  const auto due = [this](int every) { return every > 0 && processed_ % every == 0; };
  if (trusted(tracked) && !tracked.depth.empty() && due(options_.insert_every)) {
    map_.insert(tracked.depth, tracked.intensity,
                options_.leave_out_outliers ? tracked.weights : cv::Mat(), tracked.camera,
                tracked.world_from_camera);
    ++revision_;
    update.inserted = true;
  }
  // Where a relocaliser put the camera at once: alignment against this view confirms it or not.
  const bool relocalised = tracked.state == TrackingState::relocalised;
  const bool wanted =
      relocalised || (tracked.state != TrackingState::lost && due(options_.cast_every));
  if (wanted && map_.grid().blocks.block_count() > 0) {
    update.reference = reference(tracked);
  }
  if (due(options_.view_every)) update.view = take_view();
  if (due(options_.surface_every)) update.surface = take_surface();
  ++processed_;
  return update;
}

std::shared_ptr<const MapView> Mapper::take_view() {
  return std::make_shared<MapView>(map_.snapshot(), revision_);
}

std::vector<SurfaceBlockPtr> Mapper::take_surface() {
  std::vector<SurfaceBlockPtr> surface;
  for (const BlockKey& key : changed_surface(map_.grid(), map_.take_changed())) {
    surface.push_back(
        std::make_shared<SurfaceBlock>(SurfaceBlock{key, surface_points(map_.grid(), key)}));
  }
  return surface;
}

ReferenceViewPtr Mapper::reference(const TrackedFrame& tracked) const {
  RayCastOptions options = options_.cast;
  if (options_.reference_width == 0 || options_.reference_width == tracked.camera.width) {
    options.expected_depth = tracked.depth;
    options.weights = tracked.weights;
  }
  return cast_view(tracked.camera, tracked.world_from_camera,
                   tracked.frame ? tracked.frame->index : -1, options);
}

ReferenceViewPtr Mapper::reference(const Camera& camera, const Pose& world_from_camera,
                                   std::int64_t frame) const {
  return cast_view(camera, world_from_camera, frame, options_.cast);
}

ReferenceViewPtr Mapper::cast_view(const Camera& camera, const Pose& world_from_camera,
                                   std::int64_t frame, const RayCastOptions& options) const {
  const int width = options_.reference_width > 0 ? options_.reference_width : camera.width;
  auto view = std::make_shared<ReferenceView>(
      cast(map_.grid(), resized(camera, width, camera.height * width / camera.width),
           world_from_camera, options));
  view->frame = frame;
  return view;
}

}  // namespace armsreach::mapping
