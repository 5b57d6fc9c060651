#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "vision/core/byte_stream.hpp"
#include "vision/mapping/distance_estimate.hpp"
#include "vision/mapping/octree_codec.hpp"
#include "vision/mapping/octree_format.hpp"

namespace armsreach::mapping {
namespace {

using Blocks = std::map<BlockKey, Block>;

struct Header {
  std::uint64_t nodes = 0;
  double resolution = 0;
};

Error broken(const std::string& where, const std::string& what) {
  return {what, where, "save the map again, or give a ColorOcTree file written by OctoMap"};
}

std::string too_large(std::size_t most) {
  return "the map has more than " + std::to_string(most) +
         " cubes of 8x8x8 voxels; prune it, or make it coarser";
}

Result<Header> read_header(std::istream& in, const std::string& where) {
  std::string line;
  if (!std::getline(in, line) || line.rfind(octree::kFirstLine, 0) != 0) {
    return broken(where, "not an OctoMap file: its first line is not \"# Octomap OcTree file\"");
  }
  Header header;
  std::string id;
  while (std::getline(in, line) && line != "data") {
    if (line.size() > 200) return broken(where, "the header has a line of over 200 characters");
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "id") words >> id;
    if (word == "size") words >> header.nodes;
    if (word == "res") words >> header.resolution;
    if (words.fail() && !word.empty() && word[0] != '#') {
      return broken(where, "the header's entry '" + word + "' has no proper value");
    }
  }
  if (!in) return broken(where, "the header ends before 'data'");
  if (id != "ColorOcTree") return broken(where, "the tree is a '" + id + "', not a ColorOcTree");
  if (!(header.resolution >= 1e-4 && header.resolution <= 10)) {
    return broken(where, "the header's res is not between 0.1 mm and 10 m");
  }
  return header;
}

class TreeReader {
 public:
  TreeReader(std::istream& in, std::uint64_t nodes, const VoxelMapOptions& options)
      : in_(in),
        nodes_left_(nodes),
        max_blocks_(options.max_blocks),
        lowest_(fixed_log_odds(options.least_certain)),
        highest_(fixed_log_odds(options.most_certain)) {}

  // Nothing, or what is wrong.
  std::optional<std::string> read(Blocks& blocks) {
    if (nodes_left_ == 0) return std::nullopt;
    node(blocks, {0, 0, 0}, 0);
    if (!wrong_ && nodes_left_ != 0) wrong_ = "the tree has fewer nodes than its header says";
    return wrong_;
  }

 private:
  using Key = std::array<int, 3>;

  // One node and those below it; recursion is as deep as the tree's sixteen levels.
  void node(Blocks& blocks, const Key& corner, int depth) {
    const auto log_odds = in_.get<float>();
    const auto rgb = in_.get_values<std::array<std::uint8_t, 3>>();
    const auto children = in_.get<std::uint8_t>();
    if (!in_.ok()) return fail("the tree is cut off");
    if (!std::isfinite(log_odds)) return fail("a node's log-odds is not a number");
    if (nodes_left_-- == 0) return fail("the tree has more nodes than its header says");
    if (depth == octree::kDepth && children != 0) return fail("a leaf has children");
    if (children == 0) {
      return leaf(blocks, corner, 1 << (octree::kDepth - depth), log_odds,
                  static_cast<std::uint16_t>((rgb[0] + rgb[1] + rgb[2]) * 257 / 3));
    }
    const int half = 1 << (octree::kDepth - depth - 1);
    for (int child = 0; child < 8 && !wrong_; ++child) {
      if ((children >> child & 1) == 0) continue;
      node(blocks,
           {corner[0] + half * (child & 1), corner[1] + half * (child >> 1 & 1),
            corner[2] + half * (child >> 2)},
           depth + 1);
    }
  }

  // A cube of `edge` voxels of one value. Free space in pieces larger than a block says nothing
  // that the next frame would not.
  void leaf(Blocks& blocks, const Key& corner, int edge, float log_odds, std::uint16_t intensity) {
    if (edge > kBlockEdge && log_odds < 0) return;
    const float units = std::round(log_odds / kLogOddsUnit);
    const auto value = static_cast<std::int16_t>(
        std::clamp(units, static_cast<float>(lowest_), static_cast<float>(highest_)));
    const int step = std::min(edge, kBlockEdge);
    for (int z = corner[2]; z < corner[2] + edge; z += step) {
      for (int y = corner[1]; y < corner[1] + edge; y += step) {
        for (int x = corner[0]; x < corner[0] + edge; x += step) {
          Block& block = blocks[block_of_voxel(x - octree::kKeyOffset, y - octree::kKeyOffset,
                                               z - octree::kKeyOffset)];
          if (blocks.size() > max_blocks_) return fail(too_large(max_blocks_));
          fill(block, {x, y, z}, step, value, intensity);
        }
      }
    }
  }

  static void fill(Block& block, const Key& corner, int edge, std::int16_t value,
                   std::uint16_t intensity) {
    for (int z = 0; z < edge; ++z) {
      for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x) {
          const int at = voxel_in_block(corner[0] + x, corner[1] + y, corner[2] + z);
          block.log_odds(at) = value;
          block.intensity(at) = intensity;
        }
      }
    }
  }

  void fail(const std::string& what) {
    if (!wrong_) wrong_ = what;
  }

  ValueReader in_;
  std::uint64_t nodes_left_;
  std::size_t max_blocks_;
  std::int16_t lowest_;
  std::int16_t highest_;
  std::optional<std::string> wrong_;
};

// The blocks' signed distances; what is wrong with them, or nothing.
std::optional<std::string> read_distances(std::istream& in, std::size_t max_blocks,
                                          Blocks& blocks) {
  std::size_t count = 0;
  if (!(in >> count) || in.get() != '\n') return "the count of signed distances is missing";
  if (count > max_blocks) return too_large(max_blocks);
  ValueReader reader(in);
  for (std::size_t i = 0; i < count; ++i) {
    const auto xyz = reader.get_values<std::array<std::int16_t, 3>>();
    const auto known = reader.get<std::uint16_t>();
    if (!reader.ok()) return "the signed distances are cut off";
    const BlockKey key{xyz[0], xyz[1], xyz[2]};
    if (!BlockTable::in_limits(key) || known > kBlockVoxels) {
      return "a block of signed distances is impossible";
    }
    Block& block = blocks[key];
    for (int voxel = 0; voxel < known; ++voxel) {
      const auto at = reader.get<std::uint16_t>();
      const auto distance = reader.get<std::int16_t>();
      const auto weight = reader.get<std::uint16_t>();
      const auto intensity = reader.get<std::uint16_t>();
      if (!reader.ok()) return "the signed distances are cut off";
      if (at >= kBlockVoxels) return "a block of signed distances is impossible";
      block.distance(at) = distance;
      block.weight(at) = weight;
      block.intensity(at) = intensity;
    }
  }
  return std::nullopt;
}

}  // namespace

Result<VoxelMap> read_octree(std::istream& in, const std::string& where,
                             const VoxelMapOptions& options) {
  const Result<Header> header = read_header(in, where);
  if (!header) return header.error();
  Blocks blocks;
  if (auto wrong = TreeReader(in, header->nodes, options).read(blocks)) {
    return broken(where, *wrong);
  }
  std::string tag;
  const bool has_distances = std::getline(in, tag) && tag == octree::kDistancesTag;
  if (has_distances) {
    if (auto wrong = read_distances(in, options.max_blocks, blocks)) return broken(where, *wrong);
  }
  VoxelMapOptions used = options;
  used.resolution = header->resolution;
  VoxelMap map(used);
  for (const auto& [key, block] : blocks) map.put(key, block);
  if (!has_distances) estimate_distances(map);
  return map;
}

}  // namespace armsreach::mapping
