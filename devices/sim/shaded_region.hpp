// Where in a picture the shadows of things that move can fall: elsewhere light need not be asked
// for them.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

using Corners = std::array<Eigen::Vector3d, 8>;

Corners corners_of(const Eigen::AlignedBox3d& box);

// Around all pixels where something in one of the `still` boxes may be seen on the far light's way
// behind one of the `shading`. All boxes in the world; shading ones by their eight corners, grown
// by as far as shadows reach aside. Rectangles may overlap.
std::vector<cv::Rect> shaded_rectangles(const Camera& camera, const Pose& world_from_camera,
                                        const std::vector<Corners>& shading,
                                        const std::vector<Eigen::AlignedBox3d>& still,
                                        const Eigen::Vector3d& towards_light);

}  // namespace armsreach::sim
