// Where the blocks are: a hash of regions of 4x4x4 blocks. Copying a table shares everything, so a
// snapshot costs one pointer a region; the table that goes on writing first calls `share`, after
// which it copies whatever it is about to change and the snapshot never sees it.
//
// Ownership is decided by epochs and not by reference counts, so that what is copied depends on the
// calls alone and never on when another thread lets go of a snapshot.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "vision/mapping/block.hpp"

namespace armsreach::mapping {

inline constexpr int kRegionEdge = 4;  // blocks

struct Region {
  std::array<std::shared_ptr<const Block>, kRegionEdge * kRegionEdge * kRegionEdge> blocks;
  std::uint64_t occupied = 0;  // bit i: blocks[i] has an occupied voxel
  std::uint64_t epoch = 0;
  std::int64_t last_change = 0;  // count of the table's edits when it was last written
};

class BlockTable {
 public:
  // Keys reach as far as OctoMap's 16 bits a voxel.
  static constexpr int kKeyLimit = 32768 / kBlockEdge;
  static bool in_limits(const BlockKey& key) {
    const auto in = [](int v) { return v >= -kKeyLimit && v < kKeyLimit; };
    return in(key.x) && in(key.y) && in(key.z);
  }
  static constexpr BlockKey region_of(const BlockKey& key) {
    return {key.x >> 2, key.y >> 2, key.z >> 2};
  }
  static constexpr int block_in_region(const BlockKey& key) {
    return (key.x & 3) + 4 * (key.y & 3) + 16 * (key.z & 3);
  }
  static constexpr BlockKey block_at(const BlockKey& region, int index) {
    return {region.x * kRegionEdge + index % 4, region.y * kRegionEdge + index / 4 % 4,
            region.z * kRegionEdge + index / 16};
  }

  const Region* find_region(const BlockKey& region) const;
  const Block* find(const BlockKey& key) const {
    const Region* region = find_region(region_of(key));
    return region ? region->blocks[block_in_region(key)].get() : nullptr;
  }
  std::size_t block_count() const { return block_count_; }
  std::vector<BlockKey> keys() const;  // sorted
  // Calls f(region key, region) for each region, in an order that the calls made so far decide.
  template <class F>
  void for_each_region(F&& f) const {
    for (const Slot& slot : slots_) {
      if (slot.region) f(unpacked(slot.key), *slot.region);
    }
  }

  // From here on nothing that exists now is written in place.
  void share() { ++epoch_; }
  // A block to write: the stored one where this table alone has it, else a copy or a new one that
  // takes effect with `put`.
  std::shared_ptr<Block> edit(const BlockKey& key) const;
  void put(const BlockKey& key, std::shared_ptr<const Block> block);
  // Drops the regions written longest ago until at most `blocks` are left; what was dropped.
  std::vector<BlockKey> shrink(std::size_t blocks);

 private:
  struct Slot {
    std::uint64_t key = kEmpty;
    std::shared_ptr<const Region> region;
  };
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

  static BlockKey unpacked(std::uint64_t key);
  std::size_t slot_of(std::uint64_t packed) const;
  void rehash(std::size_t slots);
  Region& editable_region(const BlockKey& region);

  std::vector<Slot> slots_;
  std::size_t region_count_ = 0;
  std::size_t block_count_ = 0;
  std::uint64_t epoch_ = 1;
  std::int64_t edits_ = 0;
};

}  // namespace armsreach::mapping
