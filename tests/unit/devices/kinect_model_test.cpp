#include "devices/kinect_model.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

TEST(KinectModel, DepthNumbersAreShiftsAgainstTheReferencePlane) {
  const KinectGeometry geometry;
  // Magnenat's measured law, z = 0.1236 m tan(number / 2842.5 + 1.1863), is of another Kinect: the
  // two agree to within 1 % over a room's distances.
  for (const int number : {400, 500, 600, 700, 800, 900, 950}) {
    const double measured = 0.1236 * std::tan(number / 2842.5 + 1.1863);
    EXPECT_NEAR(kinect_depth(number, geometry), measured, 0.01 * measured) << number;
  }
  EXPECT_TRUE(std::isnan(kinect_depth(2047, geometry)));
  EXPECT_TRUE(std::isnan(kinect_depth(1090, geometry)));  // beyond 10 m
  EXPECT_TRUE(std::isnan(kinect_depth(1500, geometry)));  // beyond infinity
  EXPECT_TRUE(std::isnan(kinect_depth(-1, geometry)));
}

TEST(KinectModel, CamerasFollowFromTheGeometry) {
  KinectGeometry geometry;
  EXPECT_NEAR(kinect_depth_camera(geometry).fx, 575.8, 0.1);  // as every driver has it
  geometry.reference_pixel *= 2;
  EXPECT_NEAR(kinect_depth_camera(geometry).fx, 287.9, 0.1);
  const SensorInfo sensor = unregistered_kinect(geometry);
  EXPECT_FALSE(sensor.registered);
  // A point straight before the depth camera is to the left of the colour camera.
  EXPECT_LT((sensor.color_from_depth * Eigen::Vector3d(0, 0, 1)).x(), 0);
  EXPECT_TRUE(registered_kinect().registered);
}

TEST(KinectModel, ImagesBecomeMetres) {
  std::vector<std::uint16_t> numbers(640 * 480, 0);
  numbers[1] = 1234;
  const cv::Mat metres = depth_from_millimetres(numbers.data());
  EXPECT_TRUE(std::isnan(metres.at<float>(0, 0)));
  EXPECT_FLOAT_EQ(metres.at<float>(0, 1), 1.234F);
  numbers[2] = 65535;  // not 11 bits
  const cv::Mat depth = depth_from_numbers(numbers.data(), {});
  EXPECT_TRUE(std::isnan(depth.at<float>(0, 2)));
}

}  // namespace
}  // namespace armsreach
