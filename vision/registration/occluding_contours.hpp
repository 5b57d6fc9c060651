// Where a near surface ends in front of a far one: places that a colour image shows too, whatever
// the light and the texture.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vision/core/camera.hpp"

namespace armsreach {

enum class Across { columns, rows };  // the image direction in which depth jumps

struct ContourPoint {
  Eigen::Vector3f point_in_depth;  // m, on the near surface's border
  Eigen::Vector2f pixel;           // of the depth image
  Across across = Across::columns;
};

// At most `most` points of either direction, spread evenly over those that there are. `depth` is
// CV_32F metres, NaN unknown. A strip of unknown depth, such as a projector's shadow, may lie
// between the two surfaces; both must be whole for a few pixels, and the near one within 4 m, since
// the borders of structured light are ragged beyond.
std::vector<ContourPoint> occluding_contours(const cv::Mat& depth, const Camera& camera,
                                             std::size_t most);

}  // namespace armsreach
