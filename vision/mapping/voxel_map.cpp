#include "vision/mapping/voxel_map.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <memory>

#include "vision/mapping/depth_band.hpp"
#include "vision/mapping/depth_planes.hpp"
#include "vision/mapping/frame_evidence.hpp"
#include "vision/mapping/update_block.hpp"
#include "vision/mapping/view_frustum.hpp"

namespace armsreach::mapping {
namespace {

// Centre of a block's voxel (0,0,0), in voxel edges.
Eigen::Vector3d first_voxel(const BlockKey& key) {
  return kBlockEdge * Eigen::Vector3d(key.x, key.y, key.z) + Eigen::Vector3d::Constant(0.5);
}

}  // namespace

VoxelMap::VoxelMap(const VoxelMapOptions& options) : options_(options), hits_(options.sensor) {
  CV_Assert(options.resolution > 0 && options.max_range > 0 && options.sensor.noise > 0);
  grid_.resolution = options.resolution;
  grid_.occupied_above = fixed_log_odds(options.occupied_above);
}

void VoxelMap::insert(const cv::Mat& depth, const cv::Mat& intensity, const cv::Mat& trust,
                      const Camera& camera, const Pose& world_from_camera) {
  CV_Assert(!camera.has_distortion() && camera.width >= 2 && camera.height >= 2);
  CV_Assert(intensity.empty() ||
            (intensity.type() == CV_32FC1 && intensity.size() == depth.size()));
  const DepthPlanes planes = depth_planes(depth, trust, options_.min_trust, camera,
                                          options_.max_range, options_.resolution);
  const Pose camera_from_world = world_from_camera.inverse();
  const cv::Mat packed = intensity.isContinuous() ? intensity : intensity.clone();
  FrameEvidence frame = frame_evidence(options_, hits_, planes, packed, camera, camera_from_world);

  const DepthBand band(planes, camera, options_.sensor, options_.resolution);
  const DepthBand::Reach in_band = band.reach(false);
  band.aim(frame, in_band, false);
  update(band.blocks(world_from_camera), frame, camera_from_world);
  if (options_.carve_every > 0 && insertions_ % options_.carve_every == 0) {
    const DepthBand::Reach in_front = band.reach(true);
    band.aim(frame, in_front, true);
    std::vector<BlockKey> occupied;
    for_occupied_in_view(grid_, camera, camera_from_world,
                         [&](const BlockKey& key) { occupied.push_back(key); });
    std::sort(occupied.begin(), occupied.end());
    update(occupied, frame, camera_from_world);
  }
  ++insertions_;
  if (grid_.blocks.block_count() > options_.max_blocks) {
    // A tenth more than needed, so that this happens rarely.
    const auto dropped = grid_.blocks.shrink(options_.max_blocks - options_.max_blocks / 10);
    changed_.insert(changed_.end(), dropped.begin(), dropped.end());
  }
}

void VoxelMap::update(const std::vector<BlockKey>& keys, const FrameEvidence& frame,
                      const Pose& camera_from_world) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation_matrix();
  const Eigen::Vector3d translation = camera_from_world.translation() / options_.resolution;
  static const Block kUnseen;
  BlockCubes updated;
  for (const BlockKey& key : keys) {
    const Eigen::Vector3f first = (rotation * first_voxel(key) + translation).cast<float>();
    const float origin[3] = {first.x(), first.y(), first.z()};
    const std::uint64_t cubes = cubes_in_reach(origin, frame);
    if (cubes == 0) continue;
    // Blocks are copied for writing where a snapshot has them too: only those that change.
    const Block* stored = grid_.blocks.find(key);
    const std::uint64_t changed =
        update_cubes(stored ? *stored : kUnseen, origin, cubes, frame, updated);
    if (changed == 0) continue;
    const std::shared_ptr<Block> block = grid_.blocks.edit(key);
    for (std::uint64_t rest = changed; rest != 0; rest &= rest - 1) {
      const int cube = std::countr_zero(rest);
      block->cubes[cube] = updated[cube];
    }
    block->occupied = has_occupied(*block, grid_.occupied_above);
    grid_.blocks.put(key, block);
    changed_.push_back(key);
  }
}

VoxelGrid VoxelMap::snapshot() {
  grid_.blocks.share();
  return grid_;
}

std::vector<BlockKey> VoxelMap::take_changed() {
  std::vector<BlockKey> changed;
  changed.swap(changed_);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

void VoxelMap::put(const BlockKey& key, const Block& block) {
  const std::shared_ptr<Block> target = grid_.blocks.edit(key);
  const std::uint64_t epoch = target->epoch;
  *target = block;
  target->epoch = epoch;
  target->occupied = has_occupied(*target, grid_.occupied_above);
  grid_.blocks.put(key, target);
  changed_.push_back(key);
}

}  // namespace armsreach::mapping
