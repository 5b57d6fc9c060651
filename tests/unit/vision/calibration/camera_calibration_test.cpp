// Calibration against cameras that are known.
#include "vision/calibration/camera_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/vision/calibration/board_views.hpp"

namespace armsreach::test {
namespace {

using calibration::Chessboard;
using ::testing::HasSubstr;

constexpr double kCornerError = 0.1;  // px, about what the corner finder has on real images

Camera true_camera(Distortion model) {
  Camera camera = pinhole(640, 480, 533, 531, 325, 236);
  camera.distortion = model;
  if (model == Distortion::fisheye) {
    camera.coefficients = {-0.02, 0.01, 0, 0};
  } else {
    camera.coefficients = {-0.25, 0.08, 0.001, -0.0008, 0};
  }
  return camera;
}

// Largest distance [px] between where two cameras see the same rays, over the middle of the image
// (where every calibration has corners), beyond what turning one of them undoes: to first order a
// shift of the whole image, which the views cannot tell from a board that hangs elsewhere.
double largest_difference(const Camera& a, const Camera& b) {
  std::vector<Eigen::Vector2d> differences;
  for (int y = 40; y < a.height - 40; y += 40) {
    for (int x = 40; x < a.width - 40; x += 40) {
      const auto pixel = project(b, unproject(a, {x, y}));
      if (!pixel) return 1e9;
      differences.emplace_back(*pixel - Eigen::Vector2d(x, y));
    }
  }
  Eigen::Vector2d mean(0, 0);
  for (const auto& d : differences) mean += d / static_cast<double>(differences.size());
  double largest = 0;
  for (const auto& d : differences) largest = std::max(largest, (d - mean).norm());
  return largest;
}

class CalibrationOf : public ::testing::TestWithParam<Distortion> {};

// 20 views of 54 corners at 0.1 px fix the focal length to about 0.5 px; three deviations of that
// move pixels near the border by 0.8 px.
TEST_P(CalibrationOf, FindsTheTrueCamera) {
  const Camera truth = true_camera(GetParam());
  const Chessboard board;
  const auto views = board_views(truth, board, 20, kCornerError, 7);
  const auto result = calibrate_camera(views, {640, 480}, board, GetParam(), "test");
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_NEAR(result->camera.fx, truth.fx, 1.5);
  EXPECT_NEAR(result->camera.cy, truth.cy, 1.5);
  EXPECT_LT(largest_difference(truth, result->camera), 0.8);
  // Two coordinates of a normal error each.
  EXPECT_NEAR(result->rms, kCornerError * std::sqrt(2.0), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Models, CalibrationOf,
                         ::testing::Values(Distortion::plumb_bob, Distortion::rational_polynomial,
                                           Distortion::fisheye),
                         [](const auto& model) { return std::string(name(model.param)); });

TEST(CameraCalibration, AViewWithAWrongCornerIsLeftOut) {
  const Camera truth = true_camera(Distortion::plumb_bob);
  const Chessboard board;
  auto views = board_views(truth, board, 12, kCornerError, 3);
  for (std::size_t i = 0; i < 9; ++i) views[4][i] += cv::Point2f(6, -4);  // one row slipped
  const auto result = calibrate_camera(views, {640, 480}, board, Distortion::plumb_bob, "test");
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result->kept[4]);
  EXPECT_EQ(std::count(result->kept.begin(), result->kept.end(), true), 11);
  EXPECT_NEAR(result->camera.fx, truth.fx, 2);
}

TEST(CameraCalibration, SaysWhatIsMissing) {
  const Camera truth = true_camera(Distortion::plumb_bob);
  const Chessboard board;
  const auto two = board_views(truth, board, 2, 0, 3);
  const auto few = calibrate_camera(two, {640, 480}, board, Distortion::plumb_bob, "photos");
  ASSERT_FALSE(few.ok());
  EXPECT_THAT(few.error().message(), HasSubstr("photos"));
  EXPECT_THAT(few.error().message(), HasSubstr("too few"));
  // One photo three times is one view.
  const auto copies = calibrate_camera({two[0], two[0], two[0]}, {640, 480}, board,
                                       Distortion::plumb_bob, "photos");
  ASSERT_FALSE(copies.ok());
  EXPECT_THAT(copies.error().message(), HasSubstr("1 different view"));
  const auto monoslam = calibrate_camera(two, {640, 480}, board, Distortion::monoslam, "photos");
  ASSERT_FALSE(monoslam.ok());
  EXPECT_THAT(monoslam.error().message(), HasSubstr("fisheye"));
}

}  // namespace
}  // namespace armsreach::test
