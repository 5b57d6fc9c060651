#include "vision/mapping/distance_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Core>

#include "vision/mapping/sampler.hpp"

namespace armsreach::mapping {
namespace {

constexpr int kReach = 2;  // voxels to each side

// In voxel edges; nothing where there is no surface or no free space around.
std::optional<float> distance_at(Sampler& sampler, std::int16_t occupied_above,
                                 const Eigen::Vector3i& voxel) {
  Eigen::Vector3f occupied = Eigen::Vector3f::Zero();
  Eigen::Vector3f free = Eigen::Vector3f::Zero();
  float occupied_weight = 0;
  float free_count = 0;
  for (int z = -kReach; z <= kReach; ++z) {
    for (int y = -kReach; y <= kReach; ++y) {
      for (int x = -kReach; x <= kReach; ++x) {
        const VoxelRef ref = sampler.voxel(voxel.x() + x, voxel.y() + y, voxel.z() + z);
        if (!ref.block) continue;
        const std::int16_t value = ref.block->log_odds(ref.at);
        const Eigen::Vector3f offset(static_cast<float>(x), static_cast<float>(y),
                                     static_cast<float>(z));
        if (value > occupied_above) {
          occupied += static_cast<float>(value) * offset;
          occupied_weight += static_cast<float>(value);
        } else if (value < 0) {
          free += offset;
          ++free_count;
        }
      }
    }
  }
  if (occupied_weight == 0 || free_count == 0) return std::nullopt;
  occupied /= occupied_weight;
  const Eigen::Vector3f outwards = free / free_count - occupied;
  if (!(outwards.norm() > 0.3F)) return std::nullopt;
  return -occupied.dot(outwards.normalized());
}

}  // namespace

void estimate_distances(VoxelMap& map) {
  const VoxelGrid source = map.snapshot();
  constexpr std::uint16_t kWeight = 4;  // a sixteenth of one frontal observation from a metre
  Sampler sampler(source);
  // The shell reaches into neighbouring blocks, also into those that do not exist yet.
  std::vector<BlockKey> keys;
  for (const BlockKey& key : source.blocks.keys()) {
    if (!source.blocks.find(key)->occupied) continue;
    for (int i = 0; i < 27; ++i) {
      const BlockKey near{key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1};
      if (BlockTable::in_limits(near)) keys.push_back(near);
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const BlockKey& key : keys) {
    const Block* stored = source.blocks.find(key);
    Block block = stored ? *stored : Block{};
    bool any = false;
    for (int at = 0; at < kBlockVoxels; ++at) {
      const VoxelInBlock offset = voxel_at(at);
      const Eigen::Vector3i voxel(kBlockEdge * key.x + offset.x, kBlockEdge * key.y + offset.y,
                                  kBlockEdge * key.z + offset.z);
      const auto distance = distance_at(sampler, source.occupied_above, voxel);
      if (!distance) continue;
      block.distance(at) = static_cast<std::int16_t>(std::lround(*distance / kDistanceUnit));
      block.weight(at) = kWeight;
      any = true;
    }
    if (any) map.put(key, block);
  }
}

}  // namespace armsreach::mapping
