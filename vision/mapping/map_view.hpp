// A snapshot of the dense map as the WorldView that interaction, gaze and haptics ask. Immutable
// and safe to use from any thread; it shares its blocks with the map it was taken from.
#pragma once

#include <utility>
#include <vector>

#include "vision/core/world_view.hpp"
#include "vision/mapping/surface.hpp"
#include "vision/mapping/voxel_grid.hpp"

namespace armsreach::mapping {

class MapView final : public WorldView {
 public:
  MapView(VoxelGrid grid, std::uint64_t revision) : grid_(std::move(grid)), revision_(revision) {}

  const VoxelGrid& grid() const { return grid_; }

  std::optional<Eigen::Vector3d> pick(const Ray& ray, double range) const override;
  std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& point_in_world,
                                         double radius) const override;
  // The plane of the surface right at the point, followed outwards to `radius`: what stands on it
  // or lies beside it does not tilt it.
  std::optional<Plane> local_plane(const Eigen::Vector3d& point_in_world,
                                   double radius) const override;
  // The map is never corrected as a whole, so an anchor stays where it was put.
  Anchor anchor(const Pose& world_from_thing) const override { return {0, world_from_thing}; }
  Pose resolve(const Anchor& anchor) const override { return anchor.world_from_anchor; }
  std::uint64_t revision() const override { return revision_; }

  // Surface within `radius` of a point; sorted by block, then by cell.
  std::vector<SurfacePoint> surface_near(const Eigen::Vector3d& point_in_world,
                                         double radius) const;

 private:
  VoxelGrid grid_;
  std::uint64_t revision_;
};

}  // namespace armsreach::mapping
