#include "vision/alignment/frame_reducer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/synthetic_room.hpp"

namespace armsreach {
namespace {

using test::SyntheticRoom;

struct Difference {
  double mean, median;
  std::size_t compared;
};
Difference difference(const cv::Mat& a, const cv::Mat& b) {
  std::vector<double> all;
  for (int row = 0; row < a.rows; ++row) {
    for (int col = 0; col < a.cols; ++col) {
      const double d =
          static_cast<double>(a.at<float>(row, col)) - static_cast<double>(b.at<float>(row, col));
      if (!std::isnan(d)) all.push_back(std::abs(d));
    }
  }
  std::sort(all.begin(), all.end());
  return {std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size()),
          all[all.size() / 2], all.size()};
}

TEST(FrameReducer, ReducesToAPinholeOfTheWidthAskedFor) {
  const auto sensor = test::synthetic_sensor();
  const FrameReducer reducer(sensor, 80);
  EXPECT_EQ(reducer.camera().width, 80);
  EXPECT_EQ(reducer.camera().height, 60);
  const ReducedFrame reduced = reducer.reduce(*SyntheticRoom().frame(sensor, Pose()));
  EXPECT_EQ(reduced.depth.size(), cv::Size(80, 60));
  EXPECT_EQ(reduced.intensity.size(), cv::Size(80, 60));
  EXPECT_EQ(FrameReducer(sensor, 100).camera().width, 106);  // by 6, the nearest integer
}

TEST(FrameReducer, LooksUpUnregisteredColourThroughItsOwnCamera) {
  const SyntheticRoom room;
  const auto registered = test::synthetic_sensor();
  const FramePtr depth = room.frame(registered, Pose());
  auto sensor = std::make_shared<SensorInfo>(*registered);
  sensor->registered = false;
  sensor->color_camera = pinhole(640, 480, 470, 475, 325, 236);
  sensor->color_from_depth = Pose(so3_exp({0, 0.01, 0.02}), Eigen::Vector3d(-0.025, 0.002, 0));
  auto color_sensor = std::make_shared<SensorInfo>(*registered);
  color_sensor->depth_camera = sensor->color_camera;
  Frame frame = *depth;
  frame.color = room.frame(color_sensor, sensor->color_from_depth.inverse())->color;
  frame.sensor = sensor;
  const ReducedFrame expected = FrameReducer(registered, 80).reduce(*depth);
  const ReducedFrame found = FrameReducer(sensor, 80).reduce(frame);
  const Difference off = difference(found.intensity, expected.intensity);
  EXPECT_GT(off.compared, 4000);  // the rest lies beyond the colour camera's view
  EXPECT_LT(off.mean, 0.015);     // linear interpolation of waves of 7 to 9 pixels
  auto ignoring = std::make_shared<SensorInfo>(*sensor);
  ignoring->registered = true;
  const Difference ignored =
      difference(FrameReducer(ignoring, 80).reduce(frame).intensity, expected.intensity);
  EXPECT_GT(ignored.mean, 5 * off.mean);
}

TEST(FrameReducer, TakesDistortionOut) {
  const SyntheticRoom room;
  const auto straight = test::synthetic_sensor();
  // Askew, so that depth changes everywhere.
  const Pose askew(so3_exp({0.3, 0.5, 0}), Eigen::Vector3d::Zero());
  const FramePtr reference = room.frame(straight, askew);
  auto bent = std::make_shared<SensorInfo>(*straight);
  bent->depth_camera->coefficients = {-0.12, 0.03};
  bent->color_camera = bent->depth_camera;
  // The bent image, made from the straight one at the pixel where its ray would be seen.
  Frame frame = *reference;
  frame.sensor = bent;
  frame.depth = cv::Mat(480, 640, CV_32FC1, cv::Scalar(0));
  frame.color = cv::Mat(480, 640, CV_8UC1, cv::Scalar(0));
  for (int row = 0; row < 480; ++row) {
    for (int col = 0; col < 640; ++col) {
      const auto seen = project(*straight->depth_camera,
                                unproject(*bent->depth_camera, Eigen::Vector2d(col, row)));
      if (!seen || !straight->depth_camera->contains(*seen)) continue;
      const int u = static_cast<int>(std::lround(seen->x()));
      const int v = static_cast<int>(std::lround(seen->y()));
      frame.depth.at<float>(row, col) = reference->depth.at<float>(v, u);
      frame.color.at<std::uint8_t>(row, col) = reference->color.at<std::uint8_t>(v, u);
    }
  }
  const ReducedFrame expected = FrameReducer(straight, 80).reduce(*reference);
  const ReducedFrame found = FrameReducer(bent, 80).reduce(frame);
  const ReducedFrame left_in = FrameReducer(straight, 80).reduce(frame);
  // Away from the border, beyond which the bent image has nothing. Of intensity remains what linear
  // interpolation does to it, of depth what lies beside edges.
  const cv::Rect inner(5, 5, 70, 50);
  const cv::Mat intensity = expected.intensity(inner);
  const cv::Mat depth = expected.depth(inner);
  EXPECT_LT(difference(found.intensity(inner), intensity).mean, 0.01);
  EXPECT_GT(difference(left_in.intensity(inner), intensity).mean, 0.02);
  EXPECT_LT(difference(found.depth(inner), depth).median, 0.002);
  EXPECT_GT(difference(left_in.depth(inner), depth).median, 0.005);
}

TEST(FrameReducer, WorksWithWhatThereIs) {
  const auto sensor = test::synthetic_sensor();
  Frame frame = *SyntheticRoom().frame(sensor, Pose());
  frame.depth.release();
  const FrameReducer reducer(sensor, 80);
  EXPECT_TRUE(reducer.reduce(frame).depth.empty());
  EXPECT_EQ(reducer.reduce(frame).intensity.size(), cv::Size(80, 60));
  frame.color = cv::Mat(10, 10, CV_8UC1);  // not the camera's size
  EXPECT_TRUE(reducer.reduce(frame).intensity.empty());

  auto color_only = std::make_shared<SensorInfo>();
  color_only->color_camera = pinhole(320, 240, 260, 260, 159.5, 119.5);
  frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(51, 51, 51));
  const FrameReducer monocular(color_only, 80);
  EXPECT_EQ(monocular.camera().width, 80);
  EXPECT_NEAR(monocular.reduce(frame).intensity.at<float>(30, 40), 0.2, 1e-6);
}

}  // namespace
}  // namespace armsreach
