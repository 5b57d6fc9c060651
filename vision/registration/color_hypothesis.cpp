#include "vision/registration/color_hypothesis.hpp"

#include <cmath>

namespace armsreach {
namespace {

constexpr double kLogFocalUnit = 0.02;   // at a third of the width from the centre
constexpr double kBaselineUnit = 0.008;  // m; at a depth of 1 m
constexpr double kRollUnit = 0.0125;     // rad; half the width from the centre

}  // namespace

ColorCamera color_camera(const ColorHypothesis& h, const Camera& assumed) {
  ColorCamera out{assumed, {}};
  out.camera.fx *= std::exp(kLogFocalUnit * h[0]);
  out.camera.fy *= std::exp(kLogFocalUnit * h[0]);
  out.camera.cx += hypothesis_unit(assumed) * h[1];
  out.camera.cy += hypothesis_unit(assumed) * h[2];
  const Eigen::Vector3d roll(0, 0, kRollUnit * h[4]);
  out.camera_from_depth = Pose(so3_exp(roll), {kBaselineUnit * h[3], 0, 0});
  return out;
}

double improbability(const ColorHypothesis& h) {
  // 12 % of focal length, 1/100 of the width (a lens is centred better than it is placed), 3 cm,
  // 0.01 rad.
  const ColorHypothesis usual{6, 1.5, 1.5, 4, 0.8};
  return h.cwiseQuotient(usual).squaredNorm();
}

double displacement(const ColorHypothesis& a, const ColorHypothesis& b, const Camera& assumed,
                    const std::vector<Eigen::Vector3d>& points_in_depth) {
  const ColorCamera first = color_camera(a, assumed);
  const ColorCamera second = color_camera(b, assumed);
  double sum = 0;
  int count = 0;
  for (const Eigen::Vector3d& point : points_in_depth) {
    const auto from = project(first.camera, first.camera_from_depth * point);
    const auto to = project(second.camera, second.camera_from_depth * point);
    if (!from || !to) continue;
    sum += (*to - *from).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace armsreach
