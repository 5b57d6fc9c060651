#include "vision/mono_slam/filter.hpp"

#include <numeric>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"
#include "tests/unit/vision/mono_slam/numeric.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPixelSigma = 0.5;

CameraCovariance some_covariance() {
  CameraCovariance root;
  for (int i = 0; i < root.size(); ++i) root(i) = 0.02 * std::sin(1.0 + 3.7 * i);
  return root * root.transpose() + 1e-4 * CameraCovariance::Identity();
}

// Points of all kinds that can be measured.
Filter some_filter() {
  Filter filter(test::wide_angle(), 20, kPixelSigma);
  filter.start(test::moving_state(), some_covariance());
  filter.add_point({60, 50}, 1.0, 0.1);
  filter.add_inverse_depth({200, 90}, 0.8, 0.3);
  filter.add_point({250, 180}, 1.5, 0.3);
  filter.add_known(test::moving_state().world_from_camera() * Vector3d(0.1, 0.2, 1), 1e-3);
  filter.predict(1.0 / 30, MotionNoise(), std::nullopt);
  return filter;
}

std::vector<Measurement> shifted_measurements(const Filter& filter, const Vector2d& shift) {
  std::vector<Measurement> out;
  for (const PointId id : filter.ids()) {
    const auto prediction = filter.predict(id);
    if (prediction) out.push_back({*prediction, prediction->sighting.pixel + shift});
  }
  return out;
}

std::vector<int> all(const std::vector<Measurement>& measurements) {
  std::vector<int> out(measurements.size());
  std::iota(out.begin(), out.end(), 0);
  return out;
}

void expect_symmetric_positive(const Filter& filter) {
  const MatrixXd p = filter.covariance();
  EXPECT_EQ((p - p.transpose()).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(Eigen::LLT<MatrixXd>(p).info(), Eigen::Success);
}

// Rows of H for a measurement, as a textbook writes it.
MatrixXd dense_jacobian(const Filter& filter, const std::vector<Measurement>& measurements) {
  MatrixXd h = MatrixXd::Zero(2 * static_cast<Eigen::Index>(measurements.size()), filter.rows());
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const Prediction& prediction = measurements[i].prediction;
    int row = kCameraRows;
    for (const PointId id : filter.ids()) {
      if (id == prediction.id) break;
      row += rows_of(filter.point(id).kind);
    }
    auto line = h.middleRows<2>(2 * static_cast<Eigen::Index>(i));
    line.leftCols<kCameraRows>() = prediction.sighting.by_camera;
    line.middleCols(row, prediction.sighting.by_point.cols()) = prediction.sighting.by_point;
  }
  return h;
}

TEST(Filter, TheTurningOfWholePicturesIsTakenAsTheTextbookTakesIt) {
  Filter filter = some_filter();
  Turning turning;
  turning.rate = {0.7, 1.0, -0.9};
  turning.covariance = 1e-3 * Eigen::Matrix3d::Identity();
  turning.axis = Vector3d(0.1, 0, 0.98);
  turning.inverse_distance = 0.5;
  const CameraState before = filter.camera_state();
  const MatrixXd p = filter.covariance();
  const auto seen = [&](const VectorXd& error) -> VectorXd {
    const CameraState state = corrected(before, error);
    return state.angular_velocity +
           turning.inverse_distance *
               turning.axis.cross(state.rotation.conjugate() * state.velocity);
  };
  MatrixXd h = MatrixXd::Zero(3, filter.rows());
  h.leftCols<kCameraRows>() = test::numeric_jacobian(seen, kCameraRows);
  const MatrixXd s = h * p * h.transpose() + turning.covariance;
  const MatrixXd gain = p * h.transpose() * s.inverse();
  const VectorXd correction = gain * (turning.rate - seen(VectorXd::Zero(kCameraRows)));
  filter.observe_turning(turning);
  const CameraError left =
      difference(filter.camera_state(), corrected(before, correction.head<kCameraRows>()));
  EXPECT_LT(left.norm(), 1e-7);  // of a numeric derivative
  EXPECT_LT((filter.covariance() - (p - gain * h * p)).cwiseAbs().maxCoeff(), 1e-8);
  expect_symmetric_positive(filter);
}

TEST(Filter, UpdateIsTheTextbooks) {
  Filter filter = some_filter();
  const auto measurements = shifted_measurements(filter, {0.7, -0.4});
  ASSERT_EQ(measurements.size(), 4U);
  const MatrixXd h = dense_jacobian(filter, measurements);
  const MatrixXd p = filter.covariance();
  const MatrixXd s =
      h * p * h.transpose() + kPixelSigma * kPixelSigma * MatrixXd::Identity(h.rows(), h.rows());
  const MatrixXd gain = p * h.transpose() * s.inverse();
  const MatrixXd expected = (MatrixXd::Identity(p.rows(), p.cols()) - gain * h) * p;
  VectorXd innovation(h.rows());
  for (Eigen::Index i = 0; i < h.rows(); i += 2) innovation.segment<2>(i) = Vector2d(0.7, -0.4);
  const CameraState before = filter.camera_state();

  const JointInnovation& joint = filter.innovation(measurements);
  // Entries are up to some px^2.
  EXPECT_LT((joint.covariance - s).cwiseAbs().maxCoeff(), 1e-9);
  filter.update(all(measurements));
  EXPECT_LT((filter.covariance() - expected).cwiseAbs().maxCoeff(), 1e-12);
  const CameraError moved = difference(filter.camera_state(), before);
  EXPECT_LT((moved - (gain * innovation).head<kCameraRows>()).norm(), 1e-12);
  expect_symmetric_positive(filter);
}

TEST(Filter, PredictedCovarianceIsThatOfTheJointInnovation) {
  Filter filter = some_filter();
  const auto measurements = shifted_measurements(filter, Vector2d::Zero());
  const JointInnovation& joint = filter.innovation(measurements);
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    const auto block = joint.covariance.block<2, 2>(2 * static_cast<Eigen::Index>(i),
                                                    2 * static_cast<Eigen::Index>(i));
    EXPECT_LT((block - measurements[i].prediction.covariance).norm(), 1e-9);
  }
}

TEST(Filter, MeasuringAsChosenLeavesTheRestOut) {
  Filter one = some_filter();
  Filter other = some_filter();
  auto measurements = shifted_measurements(one, {0.3, 0.2});
  one.innovation(measurements);
  one.update({0, 2});
  other.innovation({measurements[0], measurements[2]});
  other.update({0, 1});
  EXPECT_LT((one.covariance() - other.covariance()).norm(), 1e-15);
}

TEST(Filter, PredictionGrowsUncertaintyAndKeepsTheMap) {
  Filter filter = some_filter();
  const auto ids = filter.ids();
  const MatrixXd map = filter.joint_covariance({ids[0], ids[2]});
  const double before = filter.camera_covariance().topLeftCorner<6, 6>().trace();
  MotionNoise noise;
  noise.point_wander = 0;
  filter.predict(0.1, noise, std::nullopt);
  const double after = filter.camera_covariance().topLeftCorner<6, 6>().trace();
  EXPECT_GT(after, before);
  EXPECT_EQ(filter.joint_covariance({ids[0], ids[2]}), map);
  expect_symmetric_positive(filter);
}

// Doubts about the motion that a mount was commanded make the pose less certain by just that.
TEST(Filter, ControlAddsItsOwnUncertainty) {
  Filter exact = some_filter();
  Filter doubtful = some_filter();
  CameraControl control;
  exact.predict(0.1, MotionNoise(), control);
  control.rotation_sigma = 0.02;
  control.translation_sigma = 0.003;
  doubtful.predict(0.1, MotionNoise(), control);
  const CameraCovariance added = doubtful.camera_covariance() - exact.camera_covariance();
  EXPECT_NEAR(added(0, 0), 9e-6, 1e-12);
  EXPECT_NEAR(added(4, 4), 4e-4, 1e-12);
  EXPECT_NEAR(added(7, 7), 0, 1e-12);
}

TEST(Filter, RemovingAPointLeavesTheOthersAsTheyWere) {
  Filter filter = some_filter();
  const auto ids = filter.ids();
  const MatrixXd before = filter.joint_covariance({ids[0], ids[2], ids[3]});
  filter.remove(ids[1]);
  EXPECT_EQ(filter.joint_covariance({ids[0], ids[2], ids[3]}), before);
  EXPECT_EQ(filter.ids(), (std::vector<PointId>{ids[0], ids[2], ids[3]}));
  expect_symmetric_positive(filter);
}

// A ray with a distance found elsewhere is the same as a point put there from the start.
TEST(Filter, ARayWithItsDistanceIsAPoint) {
  Filter ray(test::wide_angle(), 20, kPixelSigma);
  ray.start(test::moving_state(), some_covariance());
  Filter point = ray;
  const auto id = ray.add_ray({220, 60});
  ASSERT_TRUE(id);
  ray.fix_distance(*id, 1.2, 0.1);
  point.add_point({220, 60}, 1.2, 0.1);
  // A ray's origin has a tenth of a millimetre of its own.
  EXPECT_LT((ray.covariance() - point.covariance()).cwiseAbs().maxCoeff(), 2e-8);
  EXPECT_LT((ray.point(*id).position() - point.point(point.ids()[0]).position()).norm(), 1e-12);
}

TEST(Filter, AnInverseDepthBecomesThePointItWas) {
  Filter filter = some_filter();
  const PointId id = filter.ids()[1];
  const Vector3d position = filter.point(id).position();
  const Eigen::Matrix3d covariance = filter.position_covariance(id);
  const auto seen = filter.predict(id);
  filter.make_position(id);
  EXPECT_LT((filter.point(id).position() - position).norm(), 1e-12);
  EXPECT_LT((filter.position_covariance(id) - covariance).norm(), 1e-12);
  const auto again = filter.predict(id);
  ASSERT_TRUE(seen && again);
  EXPECT_LT((seen->covariance - again->covariance).norm(), 1e-9);
  expect_symmetric_positive(filter);
}

TEST(Filter, IsFullWhenItIsFull) {
  Filter filter(test::wide_angle(), 4, kPixelSigma);
  filter.start(CameraState(), some_covariance());
  EXPECT_TRUE(filter.add_inverse_depth({100, 100}, 1, 0.3));
  EXPECT_TRUE(filter.add_ray({120, 100}));
  EXPECT_FALSE(filter.add_point({140, 100}, 1, 0.1));
  EXPECT_EQ(filter.ids().size(), 2U);
}

// Ten minutes at 30 Hz: a camera swings before twelve points, one of which is replaced now and
// then.
TEST(Filter, StaysSymmetricAndPositiveForTenMinutes) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, kPixelSigma);
  Filter filter(test::wide_angle(), 20, kPixelSigma);
  CameraState truth;
  filter.start(truth, 1e-8 * CameraCovariance::Identity());
  std::vector<std::pair<PointId, Vector3d>> points;
  const auto add = [&](const Vector2d& pixel) {
    const double z = 1 + 0.5 * std::abs(std::sin(pixel.x()));
    const Vector3d ray = unproject(filter.camera(), pixel);
    const Vector3d point = truth.world_from_camera() * (z * ray);
    const auto id = filter.add_inverse_depth(pixel, 1 / (z * ray.norm()), 0.1);
    if (id) points.emplace_back(*id, point);
  };
  for (int i = 0; i < 12; ++i) add({50.0 + 60 * (i % 4), 60.0 + 60 * (i / 4)});
  constexpr int kFrames = 18000;
  MotionNoise noise_of_motion;
  noise_of_motion.point_wander = 0;  // these points stay where they are
  for (int frame = 1; frame <= kFrames; ++frame) {
    const double t = frame / 30.0;
    truth.position = Vector3d(0.15 * std::sin(0.9 * t), 0.1 * std::sin(1.3 * t), 0);
    truth.rotation = so3_exp({0.1 * std::sin(0.7 * t), 0.15 * std::sin(0.5 * t), 0});
    filter.predict(1.0 / 30, noise_of_motion, std::nullopt);
    std::vector<Measurement> measurements;
    for (const auto& [id, place] : points) {
      const auto prediction = filter.predict(id);
      const auto pixel = project(filter.camera(), truth.world_from_camera().inverse() * place);
      if (!prediction || !pixel || !filter.camera().contains(*pixel)) continue;
      measurements.push_back({*prediction, *pixel + Vector2d(noise(random), noise(random))});
    }
    filter.innovation(measurements);
    filter.update(all(measurements));
    if (frame == 60) {
      for (const auto& [id, place] : points) filter.make_position(id);
    }
    if (frame % 900 == 0) {
      filter.remove(points.front().first);
      points.erase(points.begin());
      add({160, 120});
      expect_symmetric_positive(filter);
    }
  }
  const Pose error =
      truth.world_from_camera().inverse() * filter.camera_state().world_from_camera();
  // It has drifted by the points that were replaced, but it is still there.
  EXPECT_LT(error.translation().norm(), 0.3);
}

}  // namespace
}  // namespace armsreach::mono_slam
