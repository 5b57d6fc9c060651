#include "vision/mapping/octree_codec.hpp"

#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include "tests/unit/vision/mapping/shapes.hpp"
#include "vision/mapping/ray_cast.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;
using test::looking_at;
using test::small_camera;

VoxelMap scene_map() {
  return test::map_of(
      test::nearest_of(
          {test::plane(Vector3d::UnitZ(), -0.2), test::box({-0.2, -0.2, -0.2}, {0.1, 0.1, 0.1})}),
      {looking_at({0.7, 0.5, 0.6}, {0, 0, 0}), looking_at({0.6, 0.6, 0.6}, {0, 0, 0}),
       looking_at({0.7, 0.3, 0.7}, {0, 0, 0})});
}

std::string saved(const VoxelMap& map) {
  std::ostringstream out;
  write_octree(out, map.grid());
  EXPECT_TRUE(out);
  return out.str();
}

Result<VoxelMap> loaded(const std::string& bytes, const VoxelMapOptions& options = {}) {
  std::istringstream in(bytes);
  return read_octree(in, "test.ot", options);
}

bool same(const VoxelGrid& a, const VoxelGrid& b) {
  if (a.blocks.keys() != b.blocks.keys()) return false;
  for (const BlockKey& key : a.blocks.keys()) {
    const Block& x = *a.blocks.find(key);
    const Block& y = *b.blocks.find(key);
    if (std::memcmp(x.cubes, y.cubes, sizeof(x.cubes)) != 0 || x.occupied != y.occupied) {
      return false;
    }
  }
  return true;
}

TEST(Octree, ReadsBackWhatWasWritten) {
  const VoxelMap map = scene_map();
  const auto back = loaded(saved(map));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_TRUE(same(map.grid(), back->grid()));
  EXPECT_EQ(saved(*back), saved(map)) << "and writes the same again";
}

TEST(Octree, MappingContinuesExactlyAfterLoading) {
  VoxelMap map = scene_map();
  auto back = loaded(saved(map));
  ASSERT_TRUE(back);
  const Camera camera = small_camera();
  const Pose pose = looking_at({0.5, 0.7, 0.5}, {0, 0, 0});
  const cv::Mat depth = test::depth_of(test::plane(Vector3d::UnitZ(), -0.2), camera, pose);
  const cv::Mat grey(60, 80, CV_32FC1, cv::Scalar(0.3F));
  // The count of insertions decides when to carve; both have made an odd number.
  map.insert(depth, grey, cv::Mat(), camera, pose);
  back->insert(cv::Mat(60, 80, CV_32FC1, cv::Scalar(0)), cv::Mat(), cv::Mat(), camera, pose);
  back->insert(depth, grey, cv::Mat(), camera, pose);
  EXPECT_TRUE(same(map.grid(), back->grid()));
}

TEST(Octree, ARunThatIsBrokenOffAndContinuedEndsWithTheMapOfOneThatIsNot) {
  const test::Shape scene =
      test::nearest_of({test::plane(Vector3d::UnitZ(), 0), test::sphere({0, 0, 0.1}, 0.2)});
  const Camera camera = small_camera();
  VoxelMap unbroken{VoxelMapOptions()};
  VoxelMap broken{VoxelMapOptions()};
  // Broken off after an even count, since every second insertion carves.
  for (int i = 0; i < 12; ++i) {
    if (i == 6) {
      auto back = loaded(saved(broken));
      ASSERT_TRUE(back) << back.error().message();
      broken = *std::move(back);
    }
    const Pose pose = looking_at({std::cos(0.2 * i), std::sin(0.2 * i), 0.8}, {0, 0, 0});
    const cv::Mat depth = test::depth_of(scene, camera, pose);
    const cv::Mat grey(60, 80, CV_32FC1, cv::Scalar(0.02 * i));
    unbroken.insert(depth, grey, cv::Mat(), camera, pose);
    broken.insert(depth, grey, cv::Mat(), camera, pose);
  }
  EXPECT_TRUE(same(unbroken.grid(), broken.grid())) << "bit for bit";
}

TEST(Octree, StockOctoMapOpensIt) {
  const VoxelMap map = scene_map();
  std::istringstream in(saved(map));
  const std::unique_ptr<octomap::AbstractOcTree> tree(octomap::AbstractOcTree::read(in));
  ASSERT_TRUE(tree);
  const auto* color = dynamic_cast<octomap::ColorOcTree*>(tree.get());
  ASSERT_TRUE(color);
  EXPECT_EQ(color->getResolution(), 0.01);
  std::size_t seen = 0;
  for (const BlockKey& key : map.grid().blocks.keys()) {
    const Block& block = *map.grid().blocks.find(key);
    for (int at = 0; at < kBlockVoxels; ++at) {
      if (block.log_odds(at) == 0) continue;
      const VoxelInBlock v = voxel_at(at);
      const auto* node =
          color->search((8 * key.x + v.x + 0.5) * 0.01, (8 * key.y + v.y + 0.5) * 0.01,
                        (8 * key.z + v.z + 0.5) * 0.01);
      ASSERT_TRUE(node);
      EXPECT_EQ(node->getLogOdds(), static_cast<float>(block.log_odds(at)) * kLogOddsUnit);
      EXPECT_NEAR(node->getColor().r, block.intensity(at) / 257.0, 0.51);
      EXPECT_EQ(node->getColor().r, node->getColor().b);
      ++seen;
    }
  }
  EXPECT_EQ(color->getNumLeafNodes(), seen);
  EXPECT_EQ(color->calcNumNodes(), color->size());
}

TEST(Octree, ReadsWhatStockOctoMapWrites) {
  // A wall of stock nodes, pruned, without any signed distance.
  octomap::ColorOcTree tree(0.01);
  for (double x = -0.4; x < 0.4; x += 0.01) {
    for (double y = -0.4; y < 0.4; y += 0.01) {
      for (int i = 0; i < 6; ++i) {
        tree.updateNode(x + 0.005, y + 0.005, 0.965 + 0.01 * i, i >= 4);
      }
      tree.setNodeColor(static_cast<float>(x) + 0.005F, static_cast<float>(y) + 0.005F, 1.005F, 128,
                        128, 128);
    }
  }
  tree.updateInnerOccupancy();
  tree.prune();
  std::ostringstream out;
  ASSERT_TRUE(tree.write(out));
  const auto map = loaded(out.str());
  ASSERT_TRUE(map) << map.error().message();
  const ReferenceView view = cast(map->grid(), small_camera(), Pose());
  // Two occupied layers from 1.00 to 1.02 m: the estimated surface is their middle, give or take
  // half a voxel.
  EXPECT_NEAR(view.depth.at<float>(30, 40), 1.01F, 0.005F);
}

TEST(Octree, AnEmptyMapIsAFileToo) {
  const VoxelMap empty{VoxelMapOptions()};
  const auto back = loaded(saved(empty));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->grid().blocks.block_count(), 0U);
}

TEST(Octree, EveryTruncationIsAnErrorOrTheTreeAlone) {
  const std::string bytes = saved(scene_map());
  const std::size_t tag = bytes.rfind("armsreach signed distances");
  ASSERT_NE(tag, std::string::npos);
  for (std::size_t i = 0; i < 300; ++i) {
    const std::size_t length = i < 150 ? i : bytes.size() * (i - 150) / 150;
    const auto result = loaded(bytes.substr(0, length));
    // Without a complete tag line the tree is whole and the rest is not ours to judge.
    const bool tree_alone = length >= tag && length < tag + 28;
    EXPECT_TRUE(tree_alone || !result) << length << " of " << bytes.size();
    if (!result) {
      EXPECT_EQ(result.error().where, "test.ot");
      EXPECT_FALSE(result.error().remedy.empty());
    }
  }
}

TEST(Octree, GarbageIsAnError) {
  for (const char* text :
       {"", "garbage", "# Octomap OcTree file\n",
        "# Octomap OcTree file\nid OcTree\nsize 0\nres 1\ndata\n",
        "# Octomap OcTree file\nid ColorOcTree\nsize x\nres 0.01\ndata\n",
        "# Octomap OcTree file\nid ColorOcTree\nsize 1\nres nan\ndata\n",
        "# Octomap OcTree file\nid ColorOcTree\nsize 1\nres -1\ndata\n",
        "# Octomap OcTree file\nid ColorOcTree\nsize 99999999999999999999\nres 0.01\ndata\n"}) {
    EXPECT_FALSE(loaded(text)) << text;
  }
  // Flipped bytes anywhere: an error or a map, never a crash.
  VoxelMapOptions coarse;
  coarse.resolution = 0.04;
  const std::string bytes = saved(
      test::map_of(test::sphere({0, 0, 0}, 0.3), {looking_at({0.8, 0, 0}, {0, 0, 0})}, coarse));
  int accepted = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    std::string broken = bytes;
    broken[(i * 7919) % broken.size()] ^= static_cast<char>(1 + i % 255);
    accepted += loaded(broken).ok();
  }
  EXPECT_LT(accepted, 400);
}

TEST(Octree, AHugeLeafDoesNotFillTheMemory) {
  std::string bytes = "# Octomap OcTree file\nid ColorOcTree\nsize 1\nres 0.01\ndata\n";
  const float occupied = 2;
  char node[8] = {};
  std::memcpy(node, &occupied, sizeof(occupied));
  bytes.append(node, 8);  // the root itself a leaf: 655 m of solid rock
  VoxelMapOptions options;
  options.max_blocks = 1000;
  const auto result = loaded(bytes, options);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("cubes of 8x8x8 voxels"), std::string::npos);
}

}  // namespace
}  // namespace armsreach::mapping
