#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {

void place(const Pose& world_from_hand, bool left, PosedSurface& surface) {
  Eigen::Matrix3f turn = world_from_hand.rotation_matrix().cast<float>();
  if (left) turn.col(0) = -turn.col(0);
  const Eigen::Vector3f shift = world_from_hand.translation().cast<float>();
  for (Eigen::Vector3f& position : surface.positions) position = turn * position + shift;
  for (Eigen::Vector3f& normal : surface.normals) normal = turn * normal;
}

}  // namespace armsreach::sim
