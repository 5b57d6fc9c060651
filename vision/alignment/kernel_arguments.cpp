#include "vision/alignment/kernel_arguments.hpp"

namespace armsreach {

Planes planes(const Level& level) {
  const Camera& camera = level.camera();
  return {level.width(),
          level.height(),
          level.stride(),
          static_cast<float>(camera.fx),
          static_cast<float>(camera.fy),
          static_cast<float>(camera.cx),
          static_cast<float>(camera.cy),
          level.greatest_step(),
          level.inverse_depth.data(),
          level.inverse_depth_x.data(),
          level.inverse_depth_y.data(),
          level.intensity.data(),
          level.intensity_x.data(),
          level.intensity_y.data()};
}

Warp warp_from(const Pose& target_from_source, double intensity_offset) {
  const Eigen::Matrix3f rotation = target_from_source.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = target_from_source.translation().cast<float>();
  Warp warp{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) warp.rotation[i][j] = rotation(i, j);
    warp.translation[i] = translation(i);
  }
  warp.intensity_offset = static_cast<float>(intensity_offset);
  return warp;
}

}  // namespace armsreach
