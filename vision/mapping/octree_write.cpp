#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "vision/core/byte_stream.hpp"
#include "vision/mapping/octree_codec.hpp"
#include "vision/mapping/octree_format.hpp"

namespace armsreach::mapping {
namespace {

struct Leaf {
  std::uint64_t path;  // three bits a level from the root: the child to take
  float log_odds;
  std::uint8_t grey;
};

// One bit of each coordinate a level, x lowest.
std::uint64_t path_of(int x, int y, int z) {
  std::uint64_t path = 0;
  for (int bit = octree::kDepth - 1; bit >= 0; --bit) {
    path = path << 3 | (static_cast<std::uint64_t>(x) >> bit & 1) |
           (static_cast<std::uint64_t>(y) >> bit & 1) << 1 |
           (static_cast<std::uint64_t>(z) >> bit & 1) << 2;
  }
  return path;
}

std::vector<Leaf> leaves_of(const VoxelGrid& grid) {
  std::vector<Leaf> leaves;
  for (const BlockKey& key : grid.blocks.keys()) {
    const Block& block = *grid.blocks.find(key);
    for (int at = 0; at < kBlockVoxels; ++at) {
      if (block.log_odds(at) == 0) continue;
      const VoxelInBlock voxel = voxel_at(at);
      const auto coordinate = [](int block_index, int offset) {
        return block_index * kBlockEdge + offset + octree::kKeyOffset;
      };
      leaves.push_back({path_of(coordinate(key.x, voxel.x), coordinate(key.y, voxel.y),
                                coordinate(key.z, voxel.z)),
                        static_cast<float>(block.log_odds(at)) * kLogOddsUnit,
                        static_cast<std::uint8_t>((block.intensity(at) + 128) / 257)});
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf& a, const Leaf& b) { return a.path < b.path; });
  return leaves;
}

// Writes the tree over sorted leaves depth first. An inner node has the greatest log-odds and the
// mean grey of its children, as OctoMap's own inner nodes do.
class TreeWriter {
 public:
  explicit TreeWriter(const std::vector<Leaf>& leaves) { add(leaves, 0); }

  // What goes into the file: nodes in the order of writing.
  struct Node {
    float log_odds;
    std::uint8_t grey;
    std::uint8_t children;  // a bit for each
  };
  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  void add(std::span<const Leaf> leaves, int depth) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({leaves.front().log_odds, leaves.front().grey, 0});
    if (depth == octree::kDepth) return;
    const int shift = 3 * (octree::kDepth - 1 - depth);
    float most = -1e9F;
    int sum = 0;
    int count = 0;
    std::uint8_t children = 0;
    while (!leaves.empty()) {
      const std::uint64_t child = leaves.front().path >> shift;
      const auto end = std::partition_point(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
        return leaf.path >> shift == child;
      });
      const std::size_t first = nodes_.size();
      const auto size = static_cast<std::size_t>(end - leaves.begin());
      add(leaves.first(size), depth + 1);
      most = std::max(most, nodes_[first].log_odds);
      sum += nodes_[first].grey;
      ++count;
      children = static_cast<std::uint8_t>(children | 1 << (child & 7));
      leaves = leaves.subspan(size);
    }
    nodes_[self] = {most, static_cast<std::uint8_t>(sum / count), children};
  }

  std::vector<Node> nodes_;
};

void write_distances(std::ostream& out, const VoxelGrid& grid) {
  const std::vector<BlockKey> keys = grid.blocks.keys();
  out << octree::kDistancesTag << '\n' << keys.size() << '\n';
  for (const BlockKey& key : keys) {
    const Block& block = *grid.blocks.find(key);
    for (const int coordinate : {key.x, key.y, key.z}) {
      write_value(out, static_cast<std::int16_t>(coordinate));
    }
    int known = 0;
    for (int at = 0; at < kBlockVoxels; ++at) known += block.weight(at) != 0;
    write_value(out, static_cast<std::uint16_t>(known));
    for (int at = 0; at < kBlockVoxels; ++at) {
      if (block.weight(at) == 0) continue;
      write_value(out, static_cast<std::uint16_t>(at));
      write_value(out, block.distance(at));
      write_value(out, block.weight(at));
      write_value(out, block.intensity(at));
    }
  }
}

}  // namespace

void write_octree(std::ostream& out, const VoxelGrid& grid) {
  const std::vector<Leaf> leaves = leaves_of(grid);
  std::vector<TreeWriter::Node> nodes;
  if (!leaves.empty()) nodes = TreeWriter(leaves).nodes();
  const auto precision = out.precision(17);
  out << octree::kFirstLine << "\n# A map by Armsreach: grey levels are intensities.\n"
      << "id ColorOcTree\nsize " << nodes.size() << "\nres " << grid.resolution << "\ndata\n";
  out.precision(precision);
  for (const TreeWriter::Node& node : nodes) {
    write_value(out, node.log_odds);
    for (int channel = 0; channel < 3; ++channel) write_value(out, node.grey);
    write_value(out, node.children);
  }
  write_distances(out, grid);
}

}  // namespace armsreach::mapping
