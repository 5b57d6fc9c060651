#include "devices/sim/hand/flesh.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

constexpr double kMillimetre = 1e-3;

Bone bone_of(Finger finger, int part) { return static_cast<Bone>(joint_of(finger, part)); }

// A ball of a lobe: millimetres in a bone's frame.
struct Ball {
  Bone bone;
  Vector3d centre;
  double radius;
};

class Builder {
 public:
  explicit Builder(const HandAnatomy& anatomy) : anatomy_(anatomy) {}

  void add(const Ball& a, const Ball& b, double melt) {
    const auto metres = [](const Vector3d& v) {
      return Eigen::Vector3f((v * kMillimetre).cast<float>());
    };
    lobes_.push_back({a.bone, b.bone, metres(a.centre), metres(b.centre),
                      static_cast<float>(a.radius * kMillimetre),
                      static_cast<float>(b.radius * kMillimetre),
                      static_cast<float>(melt * kMillimetre)});
  }

  // In the hand frame, for the mean hand; scaled to this one.
  Ball carpus(double x, double y, double z, double radius) const {
    const double palm = anatomy_.fingers[1].base.y() / (29 * kMillimetre);
    return {0, {x * anatomy_.breadth, y * palm, z * anatomy_.flesh}, radius * anatomy_.flesh};
  }
  // `along` is a share of the bone's length; `side` and `pad` are mm across it for the mean hand.
  Ball metacarpal(Finger finger, double along, double side, double pad, double radius) const {
    const FingerAnatomy& one = of(finger);
    return {bone_of(finger, 0),
            {side * anatomy_.breadth, along * (one.knuckle - one.base).norm() / kMillimetre,
             pad * anatomy_.flesh},
            radius * anatomy_.flesh};
  }
  Ball phalanx(Finger finger, int part, double along, double pad, double girth) const {
    const FingerAnatomy& one = of(finger);
    const std::size_t i = static_cast<std::size_t>(part) - 1;
    const double radius = one.radii[i] + along * (one.radii[i + 1] - one.radii[i]);
    return {bone_of(finger, part),
            {0, along * one.lengths[i] / kMillimetre, pad * anatomy_.flesh},
            girth * radius / kMillimetre};
  }
  Ball thumb(int part, double along, double side, double pad, double girth) const {
    const ThumbAnatomy& one = anatomy_.thumb;
    const std::size_t i = static_cast<std::size_t>(part);
    const double radius = one.radii[i] + along * (one.radii[i + 1] - one.radii[i]);
    return {bone_of(Finger::thumb, part),
            {side * anatomy_.breadth, along * one.lengths[i] / kMillimetre, pad * anatomy_.flesh},
            girth * radius / kMillimetre};
  }
  // A share of the last phalanx at which a ball of its tip's radius touches the tip from inside.
  double tip_share(double length, double radius) const { return 1 - radius / length; }

  const FingerAnatomy& of(Finger finger) const {
    return anatomy_.fingers[static_cast<std::size_t>(finger) - 1];
  }
  std::vector<Lobe> take() { return std::move(lobes_); }

 private:
  const HandAnatomy& anatomy_;
  std::vector<Lobe> lobes_;
};

// Radius and ulna side by side, swelling towards the elbow.
void add_forearm(Builder& b, const HandAnatomy& anatomy) {
  const double full = anatomy.forearm_length / kMillimetre;
  const double thick = anatomy.forearm_radius / kMillimetre;
  const double wide = anatomy.breadth;
  const auto ball = [&](double side, double share, double apart, double radius) {
    return Ball{kForearmBone, {side * apart, -share * full, 0}, radius};
  };
  for (const double side : {1.0, -1.0}) {
    b.add(ball(side, 0, 9.5 * wide, 19 * wide), ball(side, 0.75, 0.24 * thick, 0.86 * thick), 4);
    b.add(ball(side, 0.75, 0.24 * thick, 0.86 * thick), ball(side, 1.1, 0.2 * thick, 0.84 * thick),
          2);
  }
  b.add(ball(0, 0.3, 0, 20 * wide), ball(0, 0.62, 0, 0.93 * thick), 25);
}

void add_palm(Builder& b) {
  b.add(b.carpus(10, -3, 0, 18.5), b.carpus(10, 24, 1, 15), 6);
  b.add(b.carpus(-10, -3, 0, 18.5), b.carpus(-12, 24, 1, 15), 6);
  for (const Finger finger : kFingers)
    b.add(b.metacarpal(finger, 0.0, 0, 1, 12.5), b.metacarpal(finger, 0.96, 0, 1.5, 9.2), 8);
  // Between the metacarpals and their heads.
  for (std::size_t i = 0; i + 1 < kFingers.size(); ++i) {
    const Finger one = kFingers[i];
    const Finger next = kFingers[i + 1];
    b.add(b.metacarpal(one, 0.55, 0, 2, 11), b.metacarpal(next, 0.55, 0, 2, 11), 9);
    b.add(b.metacarpal(one, 0.97, 0, 2.5, 9), b.metacarpal(next, 0.97, 0, 2.5, 9), 5);
  }
  // The ball of the little finger.
  b.add(b.carpus(-22, 9, 4, 15), b.metacarpal(Finger::little, 0.35, -6, 6, 14), 9);
  b.add(b.metacarpal(Finger::little, 0.35, -6, 6, 14),
        b.metacarpal(Finger::little, 0.9, -0.5, 3.5, 10.8), 8);
  // The pad below the fingers' roots.
  b.add(b.metacarpal(Finger::index, 0.97, 0, 4.5, 8.4),
        b.metacarpal(Finger::little, 0.97, 0, 5, 8.8), 6);
}

void add_thumb(Builder& b) {
  // The ball of the thumb, and the web towards the index finger.
  b.add(b.carpus(13, 10, 6, 14.5), b.thumb(0, 0.5, 0, 2, 1.18), 10);
  b.add(b.thumb(0, 0.08, 0, 1, 1.1), b.thumb(0, 0.97, 0, 0, 1.0), 8);
  b.add(b.thumb(0, 0.22, 3, 5, 1.12), b.thumb(0, 0.75, 1.5, 4, 1.0), 10);
  b.add(b.thumb(0, 0.45, 0, 3, 0.95), b.metacarpal(Finger::index, 0.4, 0, 3, 12), 12);
  b.add(b.thumb(0, 0.75, 0, 2, 0.7), b.metacarpal(Finger::index, 0.62, 0, 2, 9.5), 14);
  b.add(b.thumb(0, 0.97, 0, 2, 0.42), b.metacarpal(Finger::index, 0.8, 0, 2, 6), 12);
}

void add_thumb_phalanges(Builder& b, const HandAnatomy& anatomy) {
  b.add(b.thumb(1, 0.02, 0, 0, 1.0), b.thumb(1, 1.0, 0, 0, 1.0), 6);
  b.add(b.thumb(1, 0.4, 0, 2, 0.82), b.thumb(1, 0.75, 0, 2, 0.85), 5);
  const ThumbAnatomy& thumb = anatomy.thumb;
  const double tip = b.tip_share(thumb.lengths[2], thumb.radii[3]);
  b.add(b.thumb(2, 0.0, 0, 0, 0.98), b.thumb(2, tip, 0, 0.3, 1.0), 4);
  b.add(b.thumb(2, 0.3, 0, 2.2, 0.86), b.thumb(2, 0.6, 0, 2.0, 0.92), 4);
}

void add_finger(Builder& b, Finger finger) {
  const FingerAnatomy& one = b.of(finger);
  b.add(b.phalanx(finger, 1, 0.0, 0, 0.86), b.phalanx(finger, 1, 1.0, 0, 0.98), 5);
  // Its knuckle, which stands out when it bends.
  b.add(b.phalanx(finger, 1, -0.01, -2.2, 0.66), b.phalanx(finger, 1, 0.06, -2.0, 0.68), 4);
  b.add(b.phalanx(finger, 1, 0.4, 2.2, 0.86), b.phalanx(finger, 1, 0.72, 2.0, 0.84), 5);
  b.add(b.phalanx(finger, 2, 0.0, 0, 0.99), b.phalanx(finger, 2, 1.0, 0, 0.97), 3);
  b.add(b.phalanx(finger, 2, 0.3, 1.7, 0.85), b.phalanx(finger, 2, 0.7, 1.6, 0.86), 4);
  const double tip = b.tip_share(one.lengths[2], one.radii[3]);
  b.add(b.phalanx(finger, 3, 0.0, 0, 0.98), b.phalanx(finger, 3, tip, 0.2, 1.0), 3);
  b.add(b.phalanx(finger, 3, 0.35, 1.6, 0.86), b.phalanx(finger, 3, 0.6, 1.6, 0.9), 4);
}

void add_webs(Builder& b) {
  for (std::size_t i = 0; i + 1 < kFingers.size(); ++i) {
    b.add(b.phalanx(kFingers[i], 1, 0.3, 2.0, 0.62), b.phalanx(kFingers[i + 1], 1, 0.3, 2.0, 0.62),
          6);
  }
}

}  // namespace

std::vector<Lobe> flesh_of(const HandAnatomy& anatomy) {
  Builder builder(anatomy);
  add_forearm(builder, anatomy);
  add_palm(builder);
  add_thumb(builder);
  add_thumb_phalanges(builder, anatomy);
  for (const Finger finger : kFingers) add_finger(builder, finger);
  add_webs(builder);
  return builder.take();
}

}  // namespace armsreach::sim
