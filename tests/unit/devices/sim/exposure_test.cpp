#include "devices/sim/exposure.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "devices/sim/sim_source.hpp"

namespace armsreach::sim {
namespace {

// A white board left of a black one, 1 m away, and a camera that moves past at `speed` m/s.
World two_boards(double speed) {
  World world;
  const auto board = [&](const char* name, const char* at, double x) {
    Material material;
    material.name = name;
    material.colors = {Color::Constant(at[0] == 'w' ? 0.9 : 0.01)};
    world.materials.push_back(material);
    Thing thing;
    thing.name = name;
    thing.world_from_thing =
        Pose(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX())), {x, 1, 0});
    const int index = static_cast<int>(world.things.size());
    world.parts.push_back({index, Panel{{4, 4}}, {}, static_cast<int>(world.materials.size()) - 1});
    world.things.push_back(thing);
  };
  board("white", "w", -2);
  board("black", "b", 2);
  world.light.key = Color::Zero();
  world.light.above = world.light.below = Color::Constant(0.9);
  world.path.duration = 1;
  world.path.keys = {{0, {0, 0, 0}, {0, 1, 0}, 0}, {1, {speed, 0, 0}, {speed, 1, 0}, 0}};
  world.sensor.width = 320;
  world.sensor.height = 240;
  world.sensor.color = kCleanColor;
  return world;
}

// A ramp of light from the white board to the black one, n px long, falls from three quarters to
// one quarter within n / 2: between those, the boards' own mottle does not matter.
double ramp_length(const cv::Mat& picture) {
  const auto light = [&](int x) {
    double sum = 0;
    for (int y = 100; y < 140; ++y) sum += std::pow(picture.at<cv::Vec3b>(y, x)[1], 2);
    return sum / 40;
  };
  int middle = 20;
  while (light(middle) > 0.5 * light(20)) ++middle;
  double white = 0;
  for (int x = middle - 16; x < middle - 8; ++x) white += light(x) / 8;
  const auto falls_below = [&](double share) {
    const double level = share * white;
    int x = middle - 8;
    while (light(x) > level) ++x;
    return x - 1 + (light(x - 1) - level) / (light(x - 1) - light(x));
  };
  return 2 * (falls_below(0.25) - falls_below(0.75));
}

double blur_of(double speed, double exposure) {
  World world = two_boards(speed);
  world.sensor.color.exposure = exposure;
  const auto source = make_sim_source(world, {});
  FramePtr frame;
  for (int i = 0; i < 5; ++i) frame = *source->next();
  return ramp_length(frame->color);
}

TEST(Exposure, BlurIsAsLongAsTheMotionInIt) {
  const double focal = camera_of(two_boards(1).sensor).fx;
  for (const double length : {5.0, 8.0, 12.0}) {  // px
    const double exposure = 0.02;
    const double speed = length / focal / exposure;  // at 1 m
    // Each moment's edge is drawn on whole pixels, which lengthens the ramp by up to one.
    EXPECT_NEAR(blur_of(speed, exposure), length, 1.2) << length;
    EXPECT_NEAR(blur_of(speed, exposure / 2), length / 2, 1.2) << length;
    EXPECT_LT(blur_of(speed, 0), 1.2) << length;
  }
}

TEST(Exposure, TheFastestPixelIsFound) {
  const Camera camera = pinhole(320, 240, 300, 300, 159.5, 119.5);
  cv::Mat depth(240, 320, CV_32F, cv::Scalar(2));
  depth(cv::Rect(100, 100, 60, 60)).setTo(0.5);
  depth(cv::Rect(200, 0, 60, 60)).setTo(std::nanf(""));
  const Pose aside(Eigen::Quaterniond::Identity(), {0.01, 0, 0});
  EXPECT_NEAR(picture_motion(depth, camera, aside), 300 * 0.01 / 0.5, 1e-6);
  EXPECT_NEAR(picture_motion(depth, camera, Pose()), 0, 1e-9);
}

TEST(Exposure, MomentsLieEvenlyAroundTheMiddle) {
  EXPECT_EQ(exposure_moments(0.01, 0.2), std::vector{0.0});
  const auto moments = exposure_moments(0.01, 6.5);
  ASSERT_EQ(moments.size(), 5U);
  EXPECT_NEAR(moments.front(), -0.004, 1e-12);
  EXPECT_EQ(moments[2], 0);
  EXPECT_NEAR(moments.back(), 0.004, 1e-12);
}

TEST(Exposure, LightIsAddedNotValues) {
  LightSum sum;
  sum.add(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(0)));
  sum.add(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(200)));
  EXPECT_EQ(sum.mean().at<cv::Vec3b>(0, 0), cv::Vec3b(141, 141, 141));  // 200 / sqrt(2)
}

}  // namespace
}  // namespace armsreach::sim
