#include "app/interaction/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::app {
namespace {

constexpr double kReach = 10;           // m: clicks beyond are at nothing
constexpr double kFootRadius = 0.06;    // m: what an object stands on
constexpr double kMiddleHeight = 0.06;  // m above an object's foot
constexpr double kLeastLevel = 0.5;     // cosine of 60 deg: what is steeper is stood on by nothing
constexpr double kSelectRadius = 0.1;   // m: how close a click passes by an object that it means

// Stands on the plane (z is its normal) and has the viewer in front (-y).
Pose standing_pose(const Eigen::Vector3d& foot, const Eigen::Vector3d& up,
                   const Eigen::Vector3d& viewer) {
  Eigen::Vector3d front = viewer - foot;
  front -= front.dot(up) * up;
  if (front.norm() < 1e-3) front = up.unitOrthogonal();
  const Eigen::Vector3d y = -front.normalized();
  Eigen::Matrix3d axes;
  axes << y.cross(up), y, up;
  return {Eigen::Quaterniond(axes), foot};
}

bool too_steep(const Plane& plane, const Viewer& viewer) {
  return viewer.up_in_world && plane.normal_in_world.dot(*viewer.up_in_world) < kLeastLevel;
}

FaultEvent nothing_there() {
  return {"interaction", "the click met no mapped surface",
          "look at the place for a moment so that it is mapped, then click again"};
}

}  // namespace

Placement::Placement(std::vector<PlacedObject> objects) : objects_(std::move(objects)) {
  for (const PlacedObject& object : objects_) next_id_ = std::max(next_id_, object.id + 1);
}

Events Placement::click(const Click& click, const WorldView* world, const Viewer& viewer,
                        Timestamp time) {
  if (click.insert.empty()) {
    select(click.ray_in_world, world);
    return {};
  }
  if (!world) return {{time, nothing_there()}};
  return insert(click, *world, viewer, time);
}

Events Placement::insert(const Click& click, const WorldView& world, const Viewer& viewer,
                         Timestamp time) {
  const auto foot = world.pick(click.ray_in_world, kReach);
  if (!foot) return {{time, nothing_there()}};
  const auto plane = world.local_plane(*foot, kFootRadius);
  if (!plane) {
    return {{time, FaultEvent{"interaction", "the surface there is not flat enough to stand on",
                              "click on a flat place of about 10 cm"}}};
  }
  if (too_steep(*plane, viewer)) {
    return {{time, FaultEvent{"interaction", "the surface there is too steep to stand on",
                              "click on something level: a table, a shelf, the floor"}}};
  }
  // The click's ray meets the plane, which is finer than the voxel that was hit.
  const Eigen::Vector3d& normal = plane->normal_in_world;
  const double offset = normal.dot(*foot - plane->point_in_world);
  const Pose world_from_object =
      standing_pose(*foot - offset * normal, normal, viewer.point_in_world);
  objects_.push_back({next_id_++, click.insert, world.anchor(world_from_object), false});
  return {{time, InsertEvent{click.insert, objects_.back().id, world_from_object}}};
}

void Placement::select(const Ray& ray, const WorldView* world) {
  const Eigen::Vector3d direction = ray.direction_in_world.normalized();
  PlacedObject* nearest = nullptr;
  double nearest_distance = kSelectRadius;
  for (PlacedObject& object : objects_) {
    object.selected = false;
    const Pose pose = world_from_object(object, world);
    const Eigen::Vector3d middle = pose * Eigen::Vector3d(0, 0, kMiddleHeight);
    const Eigen::Vector3d offset = middle - ray.origin_in_world;
    if (offset.dot(direction) <= 0) continue;
    const double distance = offset.cross(direction).norm();
    if (distance < nearest_distance) {
      nearest_distance = distance;
      nearest = &object;
    }
  }
  if (nearest) nearest->selected = true;
}

void Placement::select(std::int64_t id) {
  for (PlacedObject& object : objects_) object.selected = object.id == id;
}

Events Placement::remove_selected(const WorldView* world, Timestamp time) {
  Events events;
  std::erase_if(objects_, [&](const PlacedObject& object) {
    if (!object.selected) return false;
    events.push_back({time, DeleteEvent{object.mesh, object.id, world_from_object(object, world)}});
    return true;
  });
  return events;
}

Pose Placement::world_from_object(const PlacedObject& object, const WorldView* world) {
  return world ? world->resolve(object.anchor) : object.anchor.world_from_anchor;
}

}  // namespace armsreach::app
