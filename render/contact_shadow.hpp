// The soft shadow under a thing that stands on a plane, baked once per mesh: the footprint seen
// from above, weighted by how low the mesh hangs over it, blurred.
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "render/mesh.hpp"

namespace armsreach::render {

struct ContactShadow {
  cv::Mat darkness;  // CV_8U, 255 black; row along +y, column along +x of the object
  Eigen::Vector4f footprint{0, 0, 0,
                            0};  // corner x, y and extent x, y [m, object frame] of the image
};

ContactShadow bake_contact_shadow(const Mesh& mesh);

}  // namespace armsreach::render
