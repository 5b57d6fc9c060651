#include "vision/mapping/block_table.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace armsreach::mapping {
namespace {

constexpr int kRegionLimit = BlockTable::kKeyLimit / kRegionEdge;
constexpr int kAxisBits = 12;
static_assert(2 * kRegionLimit <= 1 << kAxisBits);

std::uint64_t packed(const BlockKey& region) {
  const auto axis = [](int v) { return static_cast<std::uint64_t>(v + kRegionLimit); };
  return axis(region.x) | axis(region.y) << kAxisBits | axis(region.z) << (2 * kAxisBits);
}

bool region_in_limits(const BlockKey& region) {
  const auto in = [](int v) { return v >= -kRegionLimit && v < kRegionLimit; };
  return in(region.x) && in(region.y) && in(region.z);
}

std::size_t count_blocks(const Region& region) {
  return static_cast<std::size_t>(
      std::count_if(region.blocks.begin(), region.blocks.end(),
                    [](const auto& block) { return block != nullptr; }));
}

}  // namespace

BlockKey BlockTable::unpacked(std::uint64_t key) {
  const auto axis = [key](int i) {
    return static_cast<int>(key >> (i * kAxisBits) & ((1U << kAxisBits) - 1)) - kRegionLimit;
  };
  return {axis(0), axis(1), axis(2)};
}

// Linear probing from a multiplicative (Fibonacci) hash.
std::size_t BlockTable::slot_of(std::uint64_t key) const {
  const std::size_t mask = slots_.size() - 1;
  const int shift = 64 - std::countr_zero(slots_.size());
  std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> shift;
  while (slots_[slot].key != key && slots_[slot].key != kEmpty) slot = (slot + 1) & mask;
  return slot;
}

const Region* BlockTable::find_region(const BlockKey& region) const {
  if (slots_.empty() || !region_in_limits(region)) return nullptr;
  return slots_[slot_of(packed(region))].region.get();
}

std::vector<BlockKey> BlockTable::keys() const {
  std::vector<BlockKey> found;
  found.reserve(block_count_);
  for (const Slot& slot : slots_) {
    if (!slot.region) continue;
    const BlockKey region = unpacked(slot.key);
    for (int i = 0; i < static_cast<int>(slot.region->blocks.size()); ++i) {
      if (slot.region->blocks[i]) found.push_back(block_at(region, i));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::shared_ptr<Block> BlockTable::edit(const BlockKey& key) const {
  const Region* region = find_region(region_of(key));
  const std::shared_ptr<const Block> stored =
      region ? region->blocks[block_in_region(key)] : nullptr;
  // Blocks of this epoch were made by this table after the last `share`: nobody else has them.
  if (stored && stored->epoch == epoch_) return std::const_pointer_cast<Block>(stored);
  auto block = stored ? std::make_shared<Block>(*stored) : std::make_shared<Block>();
  block->epoch = epoch_;
  return block;
}

void BlockTable::put(const BlockKey& key, std::shared_ptr<const Block> block) {
  assert(in_limits(key) && block);
  Region& region = editable_region(region_of(key));
  const int index = block_in_region(key);
  if (!region.blocks[index]) ++block_count_;
  const std::uint64_t bit = std::uint64_t{1} << index;
  region.occupied = block->occupied ? region.occupied | bit : region.occupied & ~bit;
  region.last_change = ++edits_;
  if (region.blocks[index] != block) region.blocks[index] = std::move(block);
}

Region& BlockTable::editable_region(const BlockKey& region) {
  if (2 * (region_count_ + 1) > slots_.size()) rehash(std::max<std::size_t>(64, 2 * slots_.size()));
  Slot& slot = slots_[slot_of(packed(region))];
  if (!slot.region || slot.region->epoch != epoch_) {
    if (!slot.region) ++region_count_;
    auto fresh = slot.region ? std::make_shared<Region>(*slot.region) : std::make_shared<Region>();
    fresh->epoch = epoch_;
    slot = {packed(region), std::move(fresh)};
  }
  return const_cast<Region&>(*slot.region);
}

void BlockTable::rehash(std::size_t slots) {
  std::vector<Slot> old(slots);
  old.swap(slots_);
  for (Slot& slot : old) {
    if (slot.region) slots_[slot_of(slot.key)] = std::move(slot);
  }
}

std::vector<BlockKey> BlockTable::shrink(std::size_t blocks) {
  std::vector<BlockKey> dropped;
  if (block_count_ <= blocks) return dropped;
  std::vector<std::pair<std::int64_t, std::size_t>> by_age;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].region) by_age.emplace_back(slots_[i].region->last_change, i);
  }
  std::sort(by_age.begin(), by_age.end());
  for (const auto& [age, index] : by_age) {
    if (block_count_ <= blocks) break;
    Slot& slot = slots_[index];
    const BlockKey region = unpacked(slot.key);
    for (int i = 0; i < static_cast<int>(slot.region->blocks.size()); ++i) {
      if (slot.region->blocks[i]) dropped.push_back(block_at(region, i));
    }
    block_count_ -= count_blocks(*slot.region);
    slot.region = nullptr;
    --region_count_;
  }
  rehash(slots_.size());  // probing must not stop at the holes
  std::sort(dropped.begin(), dropped.end());
  return dropped;
}

}  // namespace armsreach::mapping
