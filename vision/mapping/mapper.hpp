// The mapping stage: trusted frames go into the map, and out come the reference view that later
// frames are tracked against, a snapshot to ask and the surface to draw.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vision/core/reference_view.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/mapping/map_view.hpp"
#include "vision/mapping/ray_cast.hpp"
#include "vision/mapping/surface.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping {

struct MapperOptions {
  VoxelMapOptions map;
  RayCastOptions cast;
  // How often, in frames processed; counted, never timed, so that runs repeat. Every third frame
  // tracks as well as every frame and leaves most of a core to the rest of the program.
  int insert_every = 3;
  int cast_every = 3;
  int view_every = 3;
  int surface_every = 9;
  int reference_width = 0;  // px of the reference view; 0: the tracked images' own
  // Pixels that did not fit the reference add no surface (moving things stay out of the map), but a
  // map that is wrong somewhere then takes longer to be put right.
  bool leave_out_outliers = false;
};

struct MapUpdate {
  bool inserted = false;
  ReferenceViewPtr reference;           // null when none was cast this time
  std::shared_ptr<const MapView> view;  // null when none was taken this time
  // Blocks whose surface changed since the last time it was extracted, sorted by key; one without
  // points is gone.
  std::vector<SurfaceBlockPtr> surface;
};

class Mapper {
 public:
  explicit Mapper(const MapperOptions& options);
  // Goes on with a map that was loaded.
  Mapper(const MapperOptions& options, VoxelMap map);

  MapUpdate process(const TrackedFrame& tracked);

  // What `process` would publish, now: for the end of a run, a loaded map, a relocaliser.
  std::shared_ptr<const MapView> take_view();
  std::vector<SurfaceBlockPtr> take_surface();
  ReferenceViewPtr reference(const TrackedFrame& tracked) const;
  // From any pose, with nothing known of what is seen there: for a place that was recognised.
  // `camera` is a tracked frame's; `frame` is the index of the frame that it is about.
  ReferenceViewPtr reference(const Camera& camera, const Pose& world_from_camera,
                             std::int64_t frame) const;

  const VoxelMap& map() const { return map_; }
  std::uint64_t insertions() const { return revision_; }  // since it was made

 private:
  ReferenceViewPtr cast_view(const Camera& camera, const Pose& world_from_camera,
                             std::int64_t frame, const RayCastOptions& options) const;

  MapperOptions options_;
  VoxelMap map_;
  std::int64_t processed_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace armsreach::mapping
