#include "vision/mono_slam/start_target.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/pictures.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidth = 0.21;
constexpr double kHeight = 0.1485;

// The target's axes seen upright: x to the left, y up, z away.
Pose before_target(const Vector6d& disturbance) {
  Eigen::Matrix3d turned;
  turned << -1, 0, 0, 0, -1, 0, 0, 0, 1;
  return Pose(Eigen::Quaterniond(turned), Vector3d(0.05, 0.03, -0.6)) * Pose::exp(disturbance);
}

// Supersampled, so that edges lie where they are below the pixel.
cv::Mat picture_of_rectangle(const Camera& camera, const Pose& world_from_camera) {
  constexpr int kFine = 4;
  cv::Mat fine(camera.height * kFine, camera.width * kFine, CV_8UC1);
  for (int y = 0; y < fine.rows; ++y) {
    for (int x = 0; x < fine.cols; ++x) {
      const Vector2d pixel((x + 0.5) / kFine - 0.5, (y + 0.5) / kFine - 0.5);
      const Vector3d ray = world_from_camera.rotation() * unproject(camera, pixel);
      const Vector3d origin = world_from_camera.translation();
      const Vector3d point = origin - origin.z() / ray.z() * ray;
      const bool black = std::abs(point.x()) < kWidth / 2 && std::abs(point.y()) < kHeight / 2;
      const bool paper =
          std::abs(point.x()) < kWidth / 2 + 0.04 && std::abs(point.y()) < kHeight / 2 + 0.04;
      fine.at<unsigned char>(y, x) = black ? 25 : paper ? 230 : 110;
    }
  }
  cv::Mat out;
  cv::resize(fine, out, cv::Size(camera.width, camera.height), 0, 0, cv::INTER_AREA);
  return out;
}

TEST(StartTarget, ABlackRectangleGivesThePose) {
  const Camera camera = test::wide_angle();
  Vector6d disturbance;
  disturbance << 0.02, -0.03, 0.05, 0.15, -0.2, 0.1;
  for (const Vector6d& d : {Vector6d(Vector6d::Zero()), disturbance}) {
    const Pose truth = before_target(d);
    const auto fix = find_rectangle(picture_of_rectangle(camera, truth), camera, {kWidth, kHeight});
    ASSERT_TRUE(fix);
    // Corners to a quarter of a pixel; sideways shift and turn are told apart weakly.
    EXPECT_LT(fix->pose.rms, 0.3);
    const Vector6d error = (truth.inverse() * fix->pose.world_from_camera).log();
    EXPECT_LT(error.head<3>().norm(), 0.03);
    EXPECT_LT(error.tail<3>().norm(), 0.05);
    EXPECT_GT(fix->pose.covariance.diagonal().minCoeff(), 0);
  }
}

Pose in_front(double distance) {
  return Pose(before_target(Vector6d::Zero()).rotation(), Vector3d(0.03, 0.02, -distance));
}

TargetSight look(TargetWatch* watch, const cv::Mat& grey, const Camera& camera) {
  SearchImage image;
  image.set(grey);
  return watch->look(grey, image, camera);
}

TEST(TargetWatch, ASecondFrameConfirmsARectangle) {
  const Camera camera = test::wide_angle();
  StartTarget target;
  target.rectangle = StartTarget::Rectangle{kWidth, kHeight};
  TargetWatch watch(target);
  const cv::Mat near = picture_of_rectangle(camera, in_front(0.5));
  EXPECT_EQ(look(&watch, near, camera), TargetSight::once);
  EXPECT_EQ(look(&watch, near, camera), TargetSight::found);
  EXPECT_LT(position_sigma(watch.fix()), 0.05);
  // What was seen before a frame without it confirms nothing.
  EXPECT_EQ(look(&watch, test::speckles(320, 240, 3), camera), TargetSight::nothing);
  EXPECT_EQ(look(&watch, near, camera), TargetSight::once);
  // Nor does one that is elsewhere.
  EXPECT_EQ(look(&watch, picture_of_rectangle(camera, in_front(0.8)), camera), TargetSight::once);
}

// Seen frontally and small, shifts to the side and turns look alike.
TEST(TargetWatch, FromTooFarNothingStarts) {
  const Camera camera = test::wide_angle();
  StartTarget target;
  target.rectangle = StartTarget::Rectangle{kWidth, kHeight};
  TargetWatch watch(target);
  const cv::Mat far = picture_of_rectangle(camera, in_front(1.2));
  EXPECT_EQ(look(&watch, far, camera), TargetSight::once);
  EXPECT_EQ(look(&watch, far, camera), TargetSight::too_far);
  EXPECT_GT(position_sigma(watch.fix()), 0.05);
}

TEST(StartTarget, OfTwoRectanglesNoneIsTheTarget) {
  const Camera camera = test::wide_angle();
  const cv::Mat one = picture_of_rectangle(camera, in_front(0.8));
  cv::Mat two;
  cv::hconcat(one.colRange(80, 240), one.colRange(80, 240), two);
  ASSERT_TRUE(find_rectangle(one, camera, {kWidth, kHeight}));
  EXPECT_FALSE(find_rectangle(two, camera, {kWidth, kHeight}));
}

TEST(StartTarget, NoRectangleNoPose) {
  EXPECT_FALSE(find_rectangle(test::speckles(320, 240, 3), test::wide_angle(), {kWidth, kHeight}));
}

// Four patches pasted where a pose says, and each of them once more elsewhere.
TEST(StartTarget, MarksAreMatchedJointly) {
  const Camera camera = test::wide_angle();
  const Pose truth = before_target(Vector6d::Zero());
  cv::Mat image = test::speckles(320, 240, 11, 3);
  image.convertTo(image, -1, 0.3, 90);
  std::vector<StartTarget::Mark> marks;
  const double x = kWidth / 2;
  const double y = kHeight / 2;
  int seed = 20;
  for (const Vector3d& point :
       {Vector3d(x, y, 0), Vector3d(-x, y, 0), Vector3d(x, -y, 0), Vector3d(-x, -y, 0)}) {
    const cv::Mat patch = test::speckles(11, 11, seed, 1.2);
    const Vector2d pixel = *project(camera, truth.inverse() * point);
    const cv::Point at(static_cast<int>(std::lround(pixel.x())) - 5,
                       static_cast<int>(std::lround(pixel.y())) - 5);
    patch.copyTo(image(cv::Rect(at, cv::Size(11, 11))));
    patch.copyTo(image(cv::Rect(10 + 70 * (seed - 20), 200, 11, 11)));
    marks.push_back({patch, point});
    ++seed;
  }
  SearchImage search_image;
  search_image.set(image);
  const auto fix = find_marks(search_image, camera, marks);
  ASSERT_TRUE(fix);
  for (const SeenPoint& seen : fix->points) {
    const auto expected = project(camera, truth.inverse() * seen.point_in_world);
    EXPECT_LT((seen.pixel - *expected).norm(), 1.0);  // pasted at whole pixels
  }
  // With one of them covered there is no target.
  image(cv::Rect(0, 0, 320, 115)) = 100;
  search_image.set(image);
  EXPECT_FALSE(find_marks(search_image, camera, marks));
}

TEST(PoseFromPoints, CovarianceIsThatOfTheErrors) {
  const Camera camera = test::wide_angle();
  const Pose truth = before_target(Vector6d::Zero());
  std::vector<SeenPoint> points;
  for (int i = 0; i < 12; ++i) {
    const Vector3d point(0.1 * (i % 4) - 0.15, 0.1 * (i / 4) - 0.1, 0.05 * (i % 3));
    points.push_back({point, *project(camera, truth.inverse() * point)});
  }
  cv::RNG random(5);
  constexpr int kRuns = 300;
  Vector6d squares = Vector6d::Zero();
  Vector6d claimed = Vector6d::Zero();
  for (int run = 0; run < kRuns; ++run) {
    auto noisy = points;
    for (SeenPoint& p : noisy) p.pixel += Vector2d(random.gaussian(1), random.gaussian(1));
    const auto fix = refined_pose(camera, truth, noisy);
    ASSERT_TRUE(fix);
    Vector6d error;
    error << fix->world_from_camera.translation() - truth.translation(),
        so3_log(truth.rotation().conjugate() * fix->world_from_camera.rotation());
    squares += error.cwiseAbs2() / kRuns;
    claimed += fix->covariance.diagonal() / kRuns;
  }
  // The variance of 300 draws is known to 8 %, one deviation.
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(squares[i] / claimed[i], 1, 0.3) << i;
}

}  // namespace
}  // namespace armsreach::mono_slam
