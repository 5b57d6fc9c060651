#include "vision/mapping/ray_cast.hpp"

#include <algorithm>
#include <limits>

#include "vision/mapping/depth_bounds.hpp"
#include "vision/mapping/ray_march.hpp"

namespace armsreach::mapping {
namespace {

// The surface may have come nearer by this much [m] where the last frame was sure of its depth.
constexpr float kAhead = 0.05F;

// Where the last frame was sure of its depth, the search starts just in front of it.
float sure_start(const RayCastOptions& options, int u, int v) {
  if (options.expected_depth.empty() || options.weights.empty()) return 0;
  const float depth = options.expected_depth.at<float>(v, u);
  const float weight = options.weights.at<float>(v, u);
  if (!(depth > 0) || !(weight > static_cast<float>(options.sure))) return 0;
  return 0.97F * depth - kAhead;
}

}  // namespace

ReferenceView cast(const VoxelGrid& grid, const Camera& camera, const Pose& world_from_camera,
                   const RayCastOptions& options, cv::Mat* normals) {
  CV_Assert(!camera.has_distortion());
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  ReferenceView view;
  view.camera = camera;
  view.world_from_reference = world_from_camera;
  view.depth = cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar::all(kUnknown));
  view.intensity = view.depth.clone();
  if (normals) normals->create(camera.height, camera.width, CV_32FC3);
  if (normals) normals->setTo(cv::Scalar::all(kUnknown));

  // Rays have z = 1 in the camera's frame, so that their parameter is the depth.
  const double per_metre = 1 / grid.resolution;
  const Eigen::Matrix3f rotation = (world_from_camera.rotation_matrix() * per_metre).cast<float>();
  MapRay ray;
  ray.origin = (world_from_camera.translation() * per_metre).cast<float>();
  Sampler sampler(grid);
  const DepthBounds depths(grid, camera, world_from_camera);
  const auto near = static_cast<float>(options.near);
  const auto far = static_cast<float>(options.far);
  for (int v = 0; v < camera.height; ++v) {
    const auto y = static_cast<float>((v - camera.cy) / camera.fy);
    for (int u = 0; u < camera.width; ++u) {
      const auto x = static_cast<float>((u - camera.cx) / camera.fx);
      ray.direction = rotation * Eigen::Vector3f(x, y, 1);
      const DepthBounds::Interval& bounds = depths.at(u, v);
      const float from = std::max({near, bounds.near, sure_start(options, u, v)});
      const auto hit = march(sampler, grid, ray, from, std::min(far, bounds.far));
      if (!hit) continue;
      view.depth.at<float>(v, u) = hit->t;
      view.intensity.at<float>(v, u) = hit->intensity;
      if (normals) {
        normals->at<cv::Vec3f>(v, u) = {hit->normal.x(), hit->normal.y(), hit->normal.z()};
      }
    }
  }
  return view;
}

}  // namespace armsreach::mapping
