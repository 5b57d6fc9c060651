// The surface in the context's memory: only what changed travels, nothing is lost on the way.
#include "render/surface_cloud.hpp"

#include <memory>
#include <numeric>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "render/context.hpp"
#include "tests/screenshot/tiny_world.hpp"

namespace armsreach::render {
namespace {

class SurfaceCloudTest : public testing::Test {
 protected:
  void SetUp() override {
    auto context = make_headless_context();
    ASSERT_TRUE(context.ok()) << context.error().message();
    context_ = *std::move(context);
    auto cloud = SurfaceCloud::make(context_->gl());
    ASSERT_TRUE(cloud.ok()) << cloud.error().message();
    cloud_ = *std::move(cloud);
  }

  // Pixels that the cloud covers, seen by the tiny world's viewer.
  int covered() {
    const Gl& gl = context_->gl();
    auto target = Framebuffer::make(gl, {.width = 320, .height = 240, .depth = true});
    if (!target) return -1;
    target->bind();
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl.Enable(GL_DEPTH_TEST);
    cloud_.draw(view_of(pinhole(320, 240, 260, 260, 159.5, 119.5), test::world_from_viewer()),
                {0, 0, -1});
    cv::Mat pixels(240, 320, CV_8UC4);
    target->read(GL_RGBA, GL_UNSIGNED_BYTE, pixels.data);
    cv::Mat alpha;
    cv::extractChannel(pixels, alpha, 3);
    return cv::countNonZero(alpha);
  }

  std::unique_ptr<Context> context_;
  SurfaceCloud cloud_;
};

std::size_t point_count(const Surface& surface) {
  return std::accumulate(surface.blocks.begin(), surface.blocks.end(), std::size_t{0},
                         [](std::size_t sum, const auto& b) { return sum + b->points.size(); });
}

TEST_F(SurfaceCloudTest, OnlyChangedBlocksAreUploaded) {
  Surface surface = *test::tiny_surface(0.01F);
  EXPECT_EQ(cloud_.update(surface), point_count(surface));
  EXPECT_EQ(cloud_.update(surface), 0U);
  const int before = covered();
  surface.blocks[3] = std::make_shared<const SurfaceBlock>(*surface.blocks[3]);
  EXPECT_EQ(cloud_.update(surface), surface.blocks[3]->points.size());
  EXPECT_EQ(covered(), before);
}

TEST_F(SurfaceCloudTest, RemovedBlocksDisappearAndTheirPlaceIsUsedAgain) {
  const Surface all = *test::tiny_surface(0.01F);
  cloud_.update(all);
  const int before = covered();
  ASSERT_GT(before, 20000);
  Surface half = all;
  half.blocks.resize(half.blocks.size() / 2);
  cloud_.update(half);
  EXPECT_LT(covered(), before * 3 / 4);
  cloud_.update(all);
  EXPECT_EQ(covered(), before);
}

TEST_F(SurfaceCloudTest, GrowsBeyondItsFirstBufferWithoutLosingPoints) {
  const Surface fine = *test::tiny_surface(0.003F);  // over 200 000 points
  ASSERT_GT(point_count(fine), 200000U);
  Surface few = fine;
  few.blocks.resize(few.blocks.size() / 8);
  cloud_.update(few);
  EXPECT_EQ(cloud_.update(fine), point_count(fine) - point_count(few));
  // Seen closely enough the table, wall and block cover most of the picture.
  EXPECT_GT(covered(), 40000);
}

}  // namespace
}  // namespace armsreach::render
