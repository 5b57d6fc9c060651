#include "vision/registration/color_hypothesis.hpp"

#include <cmath>

namespace armsreach {
namespace {

constexpr double kLogFocalUnit = 0.02;   // at a third of the width from the centre
constexpr double kBaselineUnit = 0.008;  // m; at a depth of 1 m
constexpr double kRollUnit = 0.0125;     // rad; half the width from the centre

// m. PrimeSense's sensors (Kinect v1, Xtion, Carmine) have 25 mm, others 15 to 32 mm.
constexpr double kUsualBaseline = 0.025;

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

const ColorHypothesis& usual_deviation() {
  // 12 % of focal length, 1/100 of the width, 5 mm, 0.01 rad.
  static const ColorHypothesis usual{6, 1.5, 1.5, 0.005 / kBaselineUnit, 0.8};
  return usual;
}

double improbability(const ColorHypothesis& h) {
  ColorHypothesis from_usual = h;
  from_usual[3] = std::abs(h[3]) - kUsualBaseline / kBaselineUnit;
  return from_usual.cwiseQuotient(usual_deviation()).squaredNorm();
}

ColorHypothesis with_baseline(const ColorHypothesis& h, double baseline, const Camera& assumed,
                              double z) {
  const double focal_length = color_camera(h, assumed).camera.fx;
  ColorHypothesis other = h;
  other[1] += kBaselineUnit * (h[3] - baseline) * focal_length / z / hypothesis_unit(assumed);
  other[3] = baseline;
  return other;
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
