// What clicks do to inserted objects: a state machine over a WorldView that knows neither windows
// nor threads.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/core/event.hpp"
#include "vision/core/world_view.hpp"

namespace armsreach::app {

struct Click {
  Ray ray_in_world;
  std::string insert;  // the mesh to stand where the ray meets the map; empty: select
};

// Who looks on.
struct Viewer {
  Eigen::Vector3d point_in_world;                // what is inserted faces it
  std::optional<Eigen::Vector3d> up_in_world{};  // unit, against gravity; nothing: not known
};

struct PlacedObject {
  std::int64_t id = 0;
  std::string mesh;
  Anchor anchor;
  bool selected = false;
};

class Placement {
 public:
  Placement() = default;
  // Goes on with objects placed before.
  explicit Placement(std::vector<PlacedObject> objects);

  // `world` may be null while nothing is mapped. Nothing is stood on what is steep.
  Events click(const Click& click, const WorldView* world, const Viewer& viewer, Timestamp time);
  void select(std::int64_t id);  // this one and no other; 0: none
  Events remove_selected(const WorldView* world, Timestamp time);

  const std::vector<PlacedObject>& objects() const { return objects_; }
  // Where an object is today, after corrections of the map.
  static Pose world_from_object(const PlacedObject& object, const WorldView* world);

 private:
  Events insert(const Click& click, const WorldView& world, const Viewer& viewer, Timestamp time);
  void select(const Ray& ray, const WorldView* world);

  std::vector<PlacedObject> objects_;
  std::int64_t next_id_ = 1;
};

}  // namespace armsreach::app
