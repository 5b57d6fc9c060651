// Exact depth images of simple shapes, for tests of the map.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/mapping/voxel_map.hpp"

namespace armsreach::mapping::test {

// Distance along a ray from its origin, in units of its direction, to the first surface.
using Shape = std::function<std::optional<double>(const Eigen::Vector3d& origin,
                                                  const Eigen::Vector3d& direction)>;

Shape plane(const Eigen::Vector3d& normal, double offset);  // normal . p = offset
Shape sphere(const Eigen::Vector3d& centre, double radius);
Shape box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);
Shape nearest_of(std::vector<Shape> shapes);

cv::Mat depth_of(const Shape& shape, const Camera& camera, const Pose& world_from_camera);

// 80x60 pixels and the Kinect's field of view.
Camera small_camera();
// At `eye`, looking at `target`, the world's z upwards.
Pose looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

// The shape seen once from each pose.
VoxelMap map_of(const Shape& shape, const std::vector<Pose>& poses,
                const VoxelMapOptions& options = {}, const Camera& camera = small_camera());

}  // namespace armsreach::mapping::test
