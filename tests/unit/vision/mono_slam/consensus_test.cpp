#include "vision/mono_slam/consensus.hpp"

#include <random>

#include <gtest/gtest.h>

#include "tests/unit/vision/mono_slam/cameras.hpp"

namespace armsreach::mono_slam {
namespace {

using Eigen::Vector2d;

// Twenty well-known points before a camera that has moved by a frame's impulses.
class Scene {
 public:
  Scene() : filter_(test::wide_angle(), 30, 0.5), random_(7) {
    filter_.start(CameraState(), 1e-6 * CameraCovariance::Identity());
    for (int i = 0; i < 20; ++i) {
      filter_.add_point({40.0 + 60 * (i % 5), 40.0 + 50 * (i / 5)}, 1 + 0.1 * (i % 7), 0.005);
    }
    filter_.predict(1.0 / 30, MotionNoise(), std::nullopt);
    CameraError impulse = CameraError::Zero();
    impulse.head<6>() << 0.005, -0.004, 0.003, 0.006, -0.005, 0.004;
    truth_ = corrected(filter_.camera_state(), impulse);
  }

  std::vector<Measurement> measurements() {
    std::normal_distribution<double> noise(0, 0.3);
    std::vector<Measurement> out;
    for (const PointId id : filter_.ids()) {
      const auto seen = sighting(filter_.camera(), truth_, filter_.point(id));
      out.push_back({*filter_.predict(id), seen->pixel + Vector2d(noise(random_), noise(random_))});
    }
    return out;
  }

  std::vector<int> agreeing(const std::vector<Measurement>& measurements) {
    return consensus(filter_.innovation(measurements), 0.5, ConsensusOptions());
  }

 private:
  Filter filter_;
  CameraState truth_;
  std::mt19937 random_;
};

TEST(Consensus, RightMatchesAgree) {
  Scene scene;
  EXPECT_GE(scene.agreeing(scene.measurements()).size(), 19U);
}

TEST(Consensus, WrongMatchesAreFoundOutThoughTheyAreTheMany) {
  Scene scene;
  auto measurements = scene.measurements();
  std::mt19937 random(5);
  // Twelve of twenty, each somewhere else in its search region, three to six pixels off.
  for (std::size_t i = 0; i < 12; ++i) {
    const double angle = 0.001 * static_cast<double>(random() % 6283);
    const double radius = 3 + 0.001 * static_cast<double>(random() % 3000);
    measurements[i].pixel += radius * Vector2d(std::cos(angle), std::sin(angle));
  }
  const auto agreeing = scene.agreeing(measurements);
  int wrong = 0;
  int right = 0;
  for (const int i : agreeing) ++(i < 12 ? wrong : right);
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(right, 7);
}

TEST(Consensus, OneAloneAgreesWithItself) {
  Scene scene;
  auto measurements = scene.measurements();
  measurements.resize(1);
  EXPECT_EQ(scene.agreeing(measurements), std::vector<int>{0});
}

TEST(Consensus, OfTwoThatDisagreeNeitherIsBelieved) {
  Scene scene;
  auto measurements = scene.measurements();
  measurements.resize(2);
  EXPECT_EQ(scene.agreeing(measurements).size(), 2U);
  measurements[0].pixel.x() += 4;
  EXPECT_TRUE(scene.agreeing(measurements).empty());
}

}  // namespace
}  // namespace armsreach::mono_slam
