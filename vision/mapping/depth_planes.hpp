// A depth image as one small plane a pixel. A voxel that projects into a pixel is compared with
// that pixel's plane and not with its one depth: slanted surfaces keep their slope where pixels are
// wide (27 mm at 2 m and 80x60), and nothing is interpolated across a depth edge.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"
#include "vision/mapping/pixel_plane.hpp"

namespace armsreach::mapping {

// Component of a vector along a plane's normal; positive for the rays of the pixel itself.
inline double along(const PixelPlane& plane, const Eigen::Vector3d& v) {
  return Eigen::Vector3f(plane.x, plane.y, plane.z).cast<double>().dot(v);
}

struct DepthPlanes {
  int width = 0;
  int height = 0;
  std::vector<PixelPlane> planes;  // row by row, and one unknown plane at the end

  const PixelPlane& at(int u, int v) const {
    return planes[static_cast<std::size_t>(v) * width + u];
  }
};

// Planes of a depth image (CV_32F metres along z) of a pinhole camera; distances in units of `unit`
// metres. Depths beyond `max_range` are unknown. Pixels whose weight (CV_32F, may be empty) is
// below `min_trust` are not trusted; a weight of NaN was not judged and is.
DepthPlanes depth_planes(const cv::Mat& depth, const cv::Mat& weights, double min_trust,
                         const Camera& camera, double max_range, double unit);

}  // namespace armsreach::mapping
