#include "devices/sim/hand/silhouette.hpp"

#include <numbers>

#include <Eigen/Geometry>

#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {
namespace {

Camera square_camera(int side) {
  return pinhole(side, side, 2.2 * side, 2.2 * side, 0.5 * side - 0.5, 0.5 * side - 0.5);
}

}  // namespace

Pose camera_from_hand(const HandView& view, const HandAnatomy& anatomy) {
  const auto about = [](int axis, double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis));
  };
  const Eigen::Quaterniond rotation =
      about(2, view.roll) * about(0, view.tilt) * about(0, std::numbers::pi) * about(1, view.turn);
  const Eigen::Vector3d middle(0, 0.42 * anatomy.length(), 0);
  return {rotation, Eigen::Vector3d(0, 0, view.distance) - rotation * middle};
}

SilhouetteCamera::SilhouetteCamera(int side) : raster_(square_camera(side)) {}

cv::Mat SilhouetteCamera::draw(const HandSurface& surface, const HandPose& pose,
                               const HandView& view) {
  surface.pose(skeleton_of(surface.anatomy(), pose), posed_);
  place(camera_from_hand(view, surface.anatomy()), view.left, posed_);
  raster_.clear();
  raster_.draw({posed_.positions, {}, surface.rest().triangles, view.left, 255});
  return raster_.ids();
}

}  // namespace armsreach::sim
