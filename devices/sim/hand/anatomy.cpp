#include "devices/sim/hand/anatomy.hpp"

#include <algorithm>

#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr double kMillimetre = 1e-3;

FingerAnatomy finger(Eigen::Vector3d base, Eigen::Vector3d knuckle, std::array<double, 3> lengths,
                     std::array<double, 4> radii) {
  FingerAnatomy made{base * kMillimetre, knuckle * kMillimetre, lengths, radii};
  for (double& length : made.lengths) length *= kMillimetre;
  for (double& radius : made.radii) radius *= kMillimetre;
  return made;
}

// The normal distribution's middle, in units of sigma.
double spread(Random& random) { return std::clamp(random.normal(), -2.5, 2.5); }

void scale_finger(FingerAnatomy& finger, double palm, double breadth, double length, double girth) {
  for (Eigen::Vector3d* point : {&finger.base, &finger.knuckle})
    *point = point->cwiseProduct(Eigen::Vector3d(breadth, palm, palm));
  for (double& one : finger.lengths) one *= length;
  for (double& one : finger.radii) one *= girth;
}

}  // namespace

double HandAnatomy::length() const {
  const FingerAnatomy& middle = fingers[1];
  return middle.knuckle.y() + middle.lengths[0] + middle.lengths[1] + middle.lengths[2];
}

double HandAnatomy::palm_breadth() const {
  const FingerAnatomy& index = fingers[0];
  const FingerAnatomy& little = fingers[3];
  return index.knuckle.x() + index.radii[0] - little.knuckle.x() + little.radii[0];
}

HandAnatomy mean_anatomy() {
  HandAnatomy hand;
  hand.fingers = {finger({13, 28, 0}, {25.5, 95, -1}, {39.8, 22.4, 19.7}, {10.3, 9.2, 8.4, 7.0}),
                  finger({2, 29, -2}, {3.5, 93.5, -3}, {44.6, 26.3, 21.4}, {10.3, 9.4, 8.6, 7.2}),
                  finger({-9, 27, -1}, {-17, 85, -1}, {41.4, 25.7, 21.3}, {9.9, 8.9, 8.1, 6.8}),
                  finger({-18, 25, 1}, {-35, 76, 3}, {32.7, 18.6, 19.7}, {9.2, 7.8, 7.1, 6.0})};
  const FingerAnatomy thumb =
      finger({19, 17, 8}, {0, 0, 0}, {46.2, 31.6, 27.0}, {13.5, 11.2, 10.2, 8.4});
  hand.thumb = {thumb.base, thumb.lengths, thumb.radii};
  hand.forearm_length = 0.255;
  hand.forearm_radius = 0.044;
  return hand;
}

HandAnatomy random_anatomy(std::uint64_t seed) {
  Random random(seed);
  const auto around = [&random](double mean, double sigma) {
    return mean + sigma * spread(random);
  };
  const bool man = random.uniform() < 0.5;
  // Lengths 193.8 +- 9.8 and 180.5 +- 9.7 mm, breadths 90.4 +- 4.2 and 79.4 +- 3.8 mm; half of a
  // breadth's spread goes with the length's.
  const double stature = spread(random);
  const double size = man ? 1.036 + 0.052 * stature : 0.965 + 0.052 * stature;
  const double breadth = (man ? 1.065 : 0.935) * (1 + 0.023 * stature) * around(1, 0.04);
  const double palm = size * around(1, 0.02);
  const double girth = breadth * around(1, 0.03);

  HandAnatomy hand = mean_anatomy();
  hand.breadth = breadth;
  hand.flesh = breadth * around(1, 0.08);
  hand.forearm_length *= size * around(1, 0.03);
  hand.forearm_radius *= breadth * around(1, 0.06);
  const double fingers = size * around(1, 0.025);
  for (FingerAnatomy& one : hand.fingers) {
    scale_finger(one, palm, breadth, fingers * around(1, 0.02), girth);
    for (double& length : one.lengths) length *= around(1, 0.025);
  }
  hand.thumb.base = hand.thumb.base.cwiseProduct(Eigen::Vector3d(breadth, palm, palm));
  const double thumb = size * around(1, 0.035);
  for (double& length : hand.thumb.lengths) length *= thumb * around(1, 0.02);
  for (double& radius : hand.thumb.radii) radius *= girth;
  return hand;
}

}  // namespace armsreach::sim
