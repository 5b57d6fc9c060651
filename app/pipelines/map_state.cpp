#include "app/pipelines/map_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armsreach::app {
namespace {

std::int8_t unit_to_byte(float component) {
  return static_cast<std::int8_t>(std::lround(127 * std::clamp(component, -1.0F, 1.0F)));
}

render::SurfaceBlockPtr drawn(const mapping::SurfaceBlock& block, float size) {
  auto out = std::make_shared<render::SurfaceBlock>();
  out->key = {block.key.x, block.key.y, block.key.z};
  out->size = size;
  out->points.reserve(block.points.size());
  for (const mapping::SurfacePoint& p : block.points) {
    const Eigen::Vector3f& n = p.normal_in_world;
    out->points.push_back({p.point_in_world,
                           {unit_to_byte(n.x()), unit_to_byte(n.y()), unit_to_byte(n.z())},
                           static_cast<std::uint8_t>(255 * std::clamp(p.intensity, 0.0F, 1.0F))});
  }
  return out;
}

}  // namespace

render::SurfacePtr SurfaceCollector::apply(const std::vector<mapping::SurfaceBlockPtr>& changes) {
  if (changes.empty()) return surface_;
  for (const mapping::SurfaceBlockPtr& block : changes) {
    if (block->points.empty()) {
      blocks_.erase(block->key);
    } else {
      blocks_[block->key] = drawn(*block, size_);
    }
  }
  auto surface = std::make_shared<render::Surface>();
  surface->revision = surface_ ? surface_->revision + 1 : 1;
  surface->blocks.reserve(blocks_.size());
  for (const auto& [key, block] : blocks_) surface->blocks.push_back(block);
  surface_ = std::move(surface);
  return surface_;
}

}  // namespace armsreach::app
