#include "vision/mapping/block_table.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace armsreach::mapping {
namespace {

void write(BlockTable& table, const BlockKey& key, std::int16_t value, bool occupied = true) {
  const std::shared_ptr<Block> block = table.edit(key);
  block->log_odds(0) = value;
  block->occupied = occupied;
  table.put(key, block);
}

TEST(Block, PlaceAndVoxelAreInverse) {
  std::set<int> places;
  for (int z = 0; z < kBlockEdge; ++z) {
    for (int y = 0; y < kBlockEdge; ++y) {
      for (int x = 0; x < kBlockEdge; ++x) {
        const int place = voxel_in_block(x, y, z);
        places.insert(place);
        const VoxelInBlock back = voxel_at(place);
        EXPECT_TRUE(back.x == x && back.y == y && back.z == z);
        // The same place whichever block, negative coordinates included.
        EXPECT_EQ(place, voxel_in_block(x - 24, y - 8, z + 16));
      }
    }
  }
  EXPECT_EQ(places.size(), static_cast<std::size_t>(kBlockVoxels));
  EXPECT_EQ(*places.rbegin(), kBlockVoxels - 1);
}

TEST(BlockTable, FindsWhatWasPutEverywhereInItsLimits) {
  BlockTable table;
  std::vector<BlockKey> keys;
  const int edge = BlockTable::kKeyLimit;
  for (int i = 0; i < 400; ++i) keys.push_back({i * 7 - 1400, i * i % 91 - 45, -i});
  keys.push_back({-edge, -edge, -edge});
  keys.push_back({edge - 1, edge - 1, edge - 1});
  for (std::size_t i = 0; i < keys.size(); ++i) write(table, keys[i], static_cast<std::int16_t>(i));
  EXPECT_EQ(table.block_count(), keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    ASSERT_NE(table.find(keys[i]), nullptr);
    EXPECT_EQ(table.find(keys[i])->log_odds(0), static_cast<std::int16_t>(i));
  }
  EXPECT_EQ(table.find({1, 2, 3}), nullptr);
  EXPECT_EQ(table.find({edge, 0, 0}), nullptr) << "beyond the limits nothing is found";
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(table.keys(), keys);
}

TEST(BlockTable, ASnapshotNeverSeesLaterWrites) {
  BlockTable table;
  write(table, {0, 0, 0}, 1);
  write(table, {1, 0, 0}, 2);
  const BlockTable snapshot = table;
  table.share();
  write(table, {0, 0, 0}, 100);
  write(table, {50, 0, 0}, 3);
  EXPECT_EQ(snapshot.find({0, 0, 0})->log_odds(0), 1);
  EXPECT_EQ(snapshot.find({50, 0, 0}), nullptr);
  EXPECT_EQ(table.find({0, 0, 0})->log_odds(0), 100);
  EXPECT_EQ(snapshot.find({1, 0, 0}), table.find({1, 0, 0})) << "what did not change is shared";
}

TEST(BlockTable, AnUnfinishedEditChangesNothing) {
  BlockTable table;
  write(table, {0, 0, 0}, 1);
  table.share();
  table.edit({0, 0, 0})->log_odds(0) = 9;  // not put
  table.edit({3, 3, 3})->log_odds(0) = 9;
  EXPECT_EQ(table.find({0, 0, 0})->log_odds(0), 1);
  EXPECT_EQ(table.find({3, 3, 3}), nullptr);
}

TEST(BlockTable, ShrinkingDropsTheRegionsWrittenLongestAgo) {
  BlockTable table;
  for (int region = 0; region < 10; ++region) {
    for (int i = 0; i < 4; ++i) write(table, {region * kRegionEdge + i, 0, 0}, 1);
  }
  write(table, {0, 0, 0}, 2);  // the first region is now the newest
  const std::vector<BlockKey> dropped = table.shrink(20);
  EXPECT_EQ(table.block_count(), 20U);
  EXPECT_EQ(dropped.size(), 20U);
  EXPECT_NE(table.find({0, 0, 0}), nullptr);
  EXPECT_EQ(table.find({kRegionEdge, 0, 0}), nullptr);
  EXPECT_NE(table.find({9 * kRegionEdge, 0, 0}), nullptr);
  EXPECT_EQ(table.keys().size(), 20U);
}

}  // namespace
}  // namespace armsreach::mapping
