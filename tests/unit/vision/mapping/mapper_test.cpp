#include "vision/mapping/mapper.hpp"

#include <cstring>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/vision/mapping/shapes.hpp"

namespace armsreach::mapping {
namespace {

using Eigen::Vector3d;

TrackedFrame frame(int index, TrackingState state = TrackingState::tracking) {
  TrackedFrame tracked;
  auto source = std::make_shared<Frame>();
  source->index = index;
  tracked.frame = source;
  tracked.state = state;
  tracked.camera = test::small_camera();
  tracked.world_from_camera =
      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.01 * index, Vector3d::UnitY())),
           {0.005 * index, 0, 0});
  tracked.depth = test::depth_of(
      test::nearest_of({test::plane(Vector3d::UnitZ(), 1.6), test::sphere({0, 0, 1.3}, 0.2)}),
      tracked.camera, tracked.world_from_camera);
  tracked.intensity = cv::Mat(60, 80, CV_32FC1, cv::Scalar(0.25));
  return tracked;
}

TEST(Mapper, CadencesAreCounted) {
  MapperOptions options;
  options.insert_every = 3;
  options.cast_every = 2;
  options.view_every = 4;
  options.surface_every = 5;
  Mapper mapper(options);
  for (int i = 0; i < 20; ++i) {
    const MapUpdate update = mapper.process(frame(i));
    EXPECT_EQ(update.inserted, i % 3 == 0);
    EXPECT_EQ(update.reference != nullptr, i % 2 == 0);
    EXPECT_EQ(update.view != nullptr, i % 4 == 0);
    EXPECT_EQ(!update.surface.empty(), i % 5 == 0);
    if (update.reference) {
      EXPECT_EQ(update.reference->frame, i);
      EXPECT_NEAR(update.reference->intensity.at<float>(30, 40), 0.25F, 1e-3F);
    }
  }
}

TEST(Mapper, FramesThatAreNotTrustedDoNotTouchTheMap) {
  Mapper mapper{MapperOptions()};
  mapper.process(frame(0, TrackingState::initialising));
  const std::size_t blocks = mapper.map().grid().blocks.block_count();
  EXPECT_GT(blocks, 0U);
  const MapUpdate lost = mapper.process(frame(30, TrackingState::lost));
  EXPECT_FALSE(lost.inserted);
  EXPECT_EQ(lost.reference, nullptr);
  const MapUpdate relocalised = mapper.process(frame(60, TrackingState::relocalised));
  EXPECT_FALSE(relocalised.inserted);
  EXPECT_NE(relocalised.reference, nullptr) << "to be confirmed by alignment";
  EXPECT_EQ(mapper.map().grid().blocks.block_count(), blocks);
}

TEST(Mapper, RunsRepeatBitForBit) {
  const auto run = [] {
    MapperOptions options;
    options.insert_every = options.cast_every = 1;
    options.map.max_blocks = 900;  // forgetting, too, is the same
    Mapper mapper(options);
    std::vector<cv::Mat> views;
    for (int i = 0; i < 12; ++i) {
      const MapUpdate update = mapper.process(frame(4 * i));
      views.push_back(update.reference->depth);
      views.push_back(update.reference->intensity);
    }
    return views;
  };
  const std::vector<cv::Mat> a = run();
  const std::vector<cv::Mat> b = run();
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::memcmp(a[i].data, b[i].data, a[i].total() * a[i].elemSize()), 0) << i;
  }
}

TEST(Mapper, TheSurfacePiecesAddUpToTheWholeSurface) {
  MapperOptions options;
  options.surface_every = 3;
  Mapper mapper(options);
  std::map<BlockKey, std::size_t> pieces;
  for (int i = 0; i < 10; ++i) {
    for (const SurfaceBlockPtr& block : mapper.process(frame(i)).surface) {
      pieces[block->key] = block->points.size();
    }
  }
  std::size_t whole = 0;
  for (const BlockKey& key : mapper.map().grid().blocks.keys()) {
    const std::size_t points = surface_points(mapper.map().grid(), key).size();
    whole += points;
    EXPECT_EQ(pieces[key], points);
  }
  EXPECT_GT(whole, 10'000U);
}

TEST(Mapper, ReferencesOfAnotherSize) {
  MapperOptions options;
  options.reference_width = 160;
  Mapper mapper(options);
  const MapUpdate update = mapper.process(frame(0));
  EXPECT_EQ(update.reference->depth.cols, 160);
  EXPECT_EQ(update.reference->depth.rows, 120);
  EXPECT_EQ(update.reference->camera.width, 160);
  EXPECT_NEAR(update.reference->depth.at<float>(60, 80), 1.1F, 0.002F);
}

}  // namespace
}  // namespace armsreach::mapping
