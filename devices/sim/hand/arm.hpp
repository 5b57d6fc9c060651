// The arm behind a hand: two bones between shoulder and wrist, and the upper one's surface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "devices/sim/hand/anatomy.hpp"
#include "devices/sim/hand/hand_pose.hpp"
#include "devices/sim/hand/hand_surface.hpp"

namespace armsreach::sim {

double forearm_bone(const HandAnatomy& anatomy);    // m, from the wrist to the elbow's joint
double upper_arm_bone(const HandAnatomy& anatomy);  // m, from there to the shoulder's joint

// In the frame of a right hand, m.
struct Arm {
  double wrist_flexion = 0;  // rad, as in HandPose
  double wrist_deviation = 0;
  Eigen::Vector3d elbow{0, 0, 0};
  Eigen::Vector3d shoulder{0, 0, 0};
};

// The elbow may swing round the line from the shoulder to the wrist: it goes where the hand keeps
// straightest behind it (bent only as `scripted` is) and hangs down. Who cannot reach as far
// stretches: the forearm points at the shoulder, and the upper arm is as long as it must be, which
// stands for a shoulder and a trunk that come along. A wrist at its limit bends no further; the
// elbow is then a little off. `down` is a unit vector in the hand's frame.
Arm arm_to_shoulder(const HandAnatomy& anatomy, const HandPose& scripted,
                    const Eigen::Vector3d& shoulder, const Eigen::Vector3d& down);

// From the elbow to behind the shoulder: round, thicker upwards, rounded off at both ends.
class UpperArm {
 public:
  UpperArm(const HandAnatomy& anatomy, bool sleeve);

  const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return rest_.triangles; }
  std::size_t size() const { return rest_.vertices.size(); }
  // In the hand's frame, like `arm`.
  void pose(const Arm& arm, PosedSurface& out) const;

 private:
  float length_;       // m, of its bone
  TriangleMesh rest_;  // y from the elbow to the shoulder
  std::vector<Eigen::Vector3f> normals_;
};

}  // namespace armsreach::sim
