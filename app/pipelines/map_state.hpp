// What the mapping stage publishes: always the whole state, so that a reader may skip any of them.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "render/scene.hpp"
#include "vision/core/reference_view.hpp"
#include "vision/mapping/map_view.hpp"
#include "vision/mapping/surface.hpp"

namespace armsreach::app {

struct MapState {
  ReferenceViewPtr reference;  // null until something is mapped, as is `view`
  ReferenceViewPtr proposed;   // from where a lost camera may be; null until one was lost
  std::shared_ptr<const mapping::MapView> view;
  render::SurfacePtr surface;
};
using MapStatePtr = std::shared_ptr<const MapState>;

// Turns changes of the mapped surface into the surface of the scene. Blocks that did not change are
// shared from one surface to the next.
class SurfaceCollector {
 public:
  // `resolution` [m] of the map.
  explicit SurfaceCollector(double resolution) : size_(static_cast<float>(resolution)) {}

  // Returns the surface after the changes; the same as before when there are none.
  render::SurfacePtr apply(const std::vector<mapping::SurfaceBlockPtr>& changes);

 private:
  float size_;
  std::map<mapping::BlockKey, render::SurfaceBlockPtr> blocks_;
  render::SurfacePtr surface_;
};

}  // namespace armsreach::app
