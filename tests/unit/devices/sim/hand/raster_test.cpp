#include "devices/sim/hand/raster.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

const Camera kCamera = pinhole(64, 48, 50, 50, 31.5, 23.5);
using Triangle = std::array<std::uint32_t, 3>;

// A rectangle that faces the camera, at depth z.
struct Card {
  std::vector<Vector3f> corners;
  std::vector<Vector3f> colors;
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  Card(float left, float top, float right, float bottom, float z, const Vector3f& color)
      : corners{{left, top, z}, {left, bottom, z}, {right, bottom, z}, {right, top, z}},
        colors(4, color) {}
  RasterSurface surface(std::uint8_t id) const { return {corners, colors, triangles, false, id}; }
};

TEST(Raster, DepthIsThatOfThePlaneOnEveryPixel) {
  // Leaning: z = 1 + 0.5 x.
  const std::vector<Vector3f> corners{
      {-0.4F, -0.3F, 0.8F}, {-0.4F, 0.3F, 0.8F}, {0.4F, 0.3F, 1.2F}, {0.4F, -0.3F, 1.2F}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  Raster raster(kCamera);
  raster.draw({corners, {}, triangles, false, 1});
  const Raster::Images images = raster.images();
  int pixels = 0;
  for (int y = 0; y < images.place.height; ++y) {
    for (int x = 0; x < images.place.width; ++x) {
      const float depth = images.depth.at<float>(y, x);
      if (std::isnan(depth)) continue;
      ++pixels;
      const Eigen::Vector3d ray = unproject(kCamera, {x + images.place.x, y + images.place.y});
      // The ray t (x, y, 1) meets z = 1 + 0.5 x at t = 1 / (1 - 0.5 x). At the rim the nearest
      // point of the card stands for the pixel's centre: half a pixel of slope.
      EXPECT_NEAR(static_cast<double>(depth), 1 / (1 - 0.5 * ray.x()), 0.006);
    }
  }
  EXPECT_GT(pixels, 1000);
}

TEST(Raster, TheNearestWinsWhateverComesFirst) {
  const Card near(-0.1F, -0.1F, 0.1F, 0.1F, 0.5F, {10, 20, 30});
  const Card far(-0.5F, -0.4F, 0.5F, 0.4F, 1, {200, 200, 200});
  for (const bool near_first : {false, true}) {
    Raster raster(kCamera);
    if (near_first) raster.draw(near.surface(7));
    raster.draw(far.surface(9));
    if (!near_first) raster.draw(near.surface(7));
    const Raster::Images images = raster.images();
    const cv::Point centre(32 - images.place.x, 24 - images.place.y);
    EXPECT_EQ(images.ids.at<std::uint8_t>(centre), 7);
    EXPECT_FLOAT_EQ(images.depth.at<float>(centre), 0.5F);
    EXPECT_EQ(images.color.at<cv::Vec3b>(centre), cv::Vec3b(10, 20, 30));
    EXPECT_EQ(raster.ids().at<std::uint8_t>(24, 32), 7);
    EXPECT_EQ(raster.ids().at<std::uint8_t>(5, 32), 9);
  }
}

TEST(Raster, CoverageIsTheCoveredShare) {
  // From pixel 20.0 to 40.0: half of pixels 20 and 40, all between.
  const auto at = [](double pixel) { return static_cast<float>((pixel - 31.5) / 50); };
  const Card card(at(20), -0.2F, at(40), 0.2F, 1, {255, 255, 255});
  Raster raster(kCamera);
  raster.draw(card.surface(1));
  const Raster::Images images = raster.images();
  const auto coverage = [&](int x) {
    return images.coverage.at<std::uint8_t>(24 - images.place.y, x - images.place.x);
  };
  EXPECT_EQ(coverage(30), 255);
  EXPECT_EQ(coverage(20), 127);
  EXPECT_EQ(coverage(40), 127);
}

TEST(Raster, BacksAreLeftOut) {
  const Card card(-0.1F, -0.1F, 0.1F, 0.1F, 0.5F, {1, 1, 1});
  Raster raster(kCamera);
  RasterSurface back = card.surface(1);
  back.mirrored = true;
  raster.draw(back);
  EXPECT_TRUE(raster.touched().empty());
}

// A floor 10 cm below the camera, from 1 m behind it to 1 m before it, far wider than the picture:
// it fills every row below that of its far end, to the lower edge, each pixel at its depth.
TEST(Raster, WhatReachesBehindTheCameraIsCutOffAtTheNearPlane) {
  const std::vector<Vector3f> corners{{-9, 0.1F, -1}, {-9, 0.1F, 1}, {9, 0.1F, 1}, {9, 0.1F, -1}};
  const std::vector<Vector3f> colors(4, {50, 100, 150});
  for (const bool mirrored : {false, true}) {
    std::vector<Triangle> triangles{{0, 2, 1}, {0, 3, 2}};
    if (mirrored) triangles = {{0, 1, 2}, {0, 2, 3}};
    Raster raster(kCamera);
    raster.draw({corners, colors, triangles, mirrored, 3});
    const Raster::Images images = raster.images();
    ASSERT_EQ(images.place.br(), cv::Point(64, 48));
    for (int y = 30; y < 48; ++y) {
      for (int x = 0; x < 64; ++x) {
        const cv::Point at(x - images.place.x, y - images.place.y);
        ASSERT_EQ(images.ids.at<std::uint8_t>(at), 3) << x << " " << y;
        EXPECT_EQ(images.color.at<cv::Vec3b>(at), cv::Vec3b(50, 100, 150));
        const double depth = 0.1 / unproject(kCamera, Eigen::Vector2d(x, y)).y();
        // Single precision over a triangle of 18 m.
        EXPECT_NEAR(static_cast<double>(images.depth.at<float>(at)), depth, 0.002);
      }
    }
    raster.clear();
    EXPECT_EQ(cv::countNonZero(raster.ids()), 0);
  }
}

TEST(Raster, WhatIsBehindTheCameraIsNotDrawn) {
  const Card card(-0.1F, -0.1F, 0.1F, 0.1F, -0.5F, {1, 1, 1});
  Raster raster(kCamera);
  raster.draw(card.surface(1));
  EXPECT_TRUE(raster.touched().empty());
}

TEST(Raster, BendsWithTheLens) {
  Camera fisheye = kCamera;
  fisheye.distortion = Distortion::fisheye;
  fisheye.coefficients[0] = 0.05;
  const Card dot(0.28F, -0.02F, 0.32F, 0.02F, 0.5F, {1, 1, 1});
  Raster raster(fisheye);
  raster.draw(dot.surface(1));
  const auto expected = project(fisheye, {0.3, 0, 0.5});
  const cv::Rect place = raster.touched();
  EXPECT_NEAR(place.x + 0.5 * (place.width - 1), expected->x(), 1);
  EXPECT_NEAR(place.y + 0.5 * (place.height - 1), expected->y(), 1);
}

}  // namespace
}  // namespace armsreach::sim
