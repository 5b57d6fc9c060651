// The one question desk over any map, sparse or dense: interaction, gaze and haptics ask it and
// nobody else. A WorldView is an immutable snapshot; a later one has a larger revision.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "vision/core/pose.hpp"

namespace armsreach {

struct Ray {
  Eigen::Vector3d origin_in_world;
  Eigen::Vector3d direction_in_world;  // any length but zero
};

struct Plane {
  Eigen::Vector3d point_in_world;
  Eigen::Vector3d normal_in_world;  // unit, towards where the surface was seen from
};

// A place in the map that moves when the map is corrected.
struct Anchor {
  std::int64_t id = 0;
  Pose world_from_anchor;
};

class WorldView {
 public:
  virtual ~WorldView() = default;

  // First mapped surface along the ray, up to `range` metres.
  virtual std::optional<Eigen::Vector3d> pick(const Ray& ray, double range) const = 0;
  // Mapped point nearest to a point, within `radius` metres.
  virtual std::optional<Eigen::Vector3d> nearest(const Eigen::Vector3d& point_in_world,
                                                 double radius) const = 0;
  // Plane through the mapped points within `radius` metres; nothing when they are too few or not
  // plane-like.
  virtual std::optional<Plane> local_plane(const Eigen::Vector3d& point_in_world,
                                           double radius) const = 0;
  // Ties a pose to the map here and now, and where such an anchor is today.
  virtual Anchor anchor(const Pose& world_from_thing) const = 0;
  virtual Pose resolve(const Anchor& anchor) const = 0;

  virtual std::uint64_t revision() const = 0;
};
using WorldViewPtr = std::shared_ptr<const WorldView>;

}  // namespace armsreach
