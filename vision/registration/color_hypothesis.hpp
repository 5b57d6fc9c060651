// A guess at the colour camera beside a depth camera, in five numbers.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach {

// Departure from coinciding cameras: focal length, centre x and y, baseline, roll. The unit of each
// moves the picture by about 1/160 of its width, so that one step means the same in any direction.
// Pitch and yaw look like the centre, forward offset like the focal length, and are left out.
using ColorHypothesis = Eigen::Matrix<double, 5, 1>;

struct ColorCamera {
  Camera camera;
  Pose camera_from_depth;
};

// Half a pixel where images are tracked at a width of 80.
inline double hypothesis_unit(const Camera& camera) { return camera.width / 160.0; }  // px

// `assumed` is the camera that the colour image would have if it were registered.
ColorCamera color_camera(const ColorHypothesis& hypothesis, const Camera& assumed);

// What is usual among sensors with two cameras side by side: a standard deviation of each number.
// Baselines of either sign are about 25 mm; the others are about zero.
const ColorHypothesis& usual_deviation();

// How unusual the hypothesis is among them: squared, in standard deviations.
double improbability(const ColorHypothesis& hypothesis);

// With another baseline, in its unit, and the centre such that what is at a depth of `z` (m) stays.
ColorHypothesis with_baseline(const ColorHypothesis& hypothesis, double baseline,
                              const Camera& assumed, double z);

// How far apart two hypotheses put points of the scene: px rms.
double displacement(const ColorHypothesis& a, const ColorHypothesis& b, const Camera& assumed,
                    const std::vector<Eigen::Vector3d>& points_in_depth);

}  // namespace armsreach
