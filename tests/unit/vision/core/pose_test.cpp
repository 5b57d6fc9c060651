// The group laws of SE(3) at identity, near zero, at random and near a half turn.
#include "vision/core/pose.hpp"

#include <random>

#include <gtest/gtest.h>

namespace armsreach {
namespace {

std::vector<Vector6d> tangents() {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vector6d> all = {Vector6d::Zero()};
  for (double size : {1e-12, 1e-7, 1e-4, 0.9e-4, 1.1e-4, 0.9e-2, 1.1e-2, 0.1, 1.0, 3.0, 3.14159}) {
    Vector6d t;
    for (int i = 0; i < 6; ++i) t[i] = normal(random);
    t.tail<3>() *= size / t.tail<3>().norm();
    all.push_back(t);
  }
  return all;
}

void expect_same(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  EXPECT_LT((a.matrix() - b.matrix()).norm(), tolerance);
}

TEST(Pose, ExpAndLogInvertEachOther) {
  for (const Vector6d& t : tangents()) {
    EXPECT_LT((Pose::exp(t).log() - t).norm(), 1e-8 * (1 + t.norm())) << t.transpose();
  }
}

TEST(Pose, GroupLaws) {
  for (const Vector6d& a : tangents()) {
    const Pose pa = Pose::exp(a);
    expect_same(pa * pa.inverse(), Pose());
    expect_same(Pose() * pa, pa);
    expect_same(Pose::exp(-a), pa.inverse());
    for (const Vector6d& b : tangents()) {
      const Pose pb = Pose::exp(b);
      const Eigen::Vector3d x(0.3, -2, 5);
      EXPECT_LT(((pa * pb) * x - pa * (pb * x)).norm(), 1e-12);
      expect_same((pa * pb).inverse(), pb.inverse() * pa.inverse());
    }
  }
}

TEST(Pose, MatchesTheMatrixExponentialSeries) {
  for (const Vector6d& t : tangents()) {
    Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
    generator.topLeftCorner<3, 3>() = skew(t.tail<3>());
    generator.topRightCorner<3, 1>() = t.head<3>();
    Eigen::Matrix4d sum = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    for (int n = 1; n < 60; ++n) {
      term = term * generator / n;
      sum += term;
    }
    EXPECT_LT((Pose::exp(t).matrix() - sum).norm(), 1e-11);
  }
}

TEST(Pose, AdjointMovesTangentsAcross) {
  for (const Vector6d& a : tangents()) {
    const Pose p = Pose::exp(a);
    const Vector6d t = 0.1 * Vector6d::Ones();
    expect_same(p * Pose::exp(t), Pose::exp(p.adjoint() * t) * p, 1e-11);
  }
}

TEST(Pose, StaysARotationOverManyProducts) {
  Pose p;
  const Pose step = Pose::exp((Vector6d() << 0.01, 0, 0, 0.1, 0.2, 0.3).finished());
  for (int i = 0; i < 100000; ++i) p = p * step;
  EXPECT_NEAR(p.rotation().norm(), 1, 1e-14);
}

TEST(Pose, InterpolatesOnTheGeodesic) {
  const Pose a = Pose::exp((Vector6d() << 1, 2, 3, 0.1, 0.5, -0.2).finished());
  const Pose b = Pose::exp((Vector6d() << -1, 0, 3, 0.4, -0.5, 0.7).finished());
  expect_same(interpolate(a, b, 0), a);
  expect_same(interpolate(a, b, 1), b);
  const Pose middle = interpolate(a, b, 0.5);
  EXPECT_NEAR((a.inverse() * middle).log().norm(), (middle.inverse() * b).log().norm(), 1e-12);
}

}  // namespace
}  // namespace armsreach
