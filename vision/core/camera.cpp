#include "vision/core/camera.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace armsreach {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Normalised image coordinates after distortion, and their Jacobian by the undistorted ones.
struct Distorted {
  Vector2d xy;
  Matrix2d by_undistorted;
  bool valid = true;  // false beyond the radius at which the model folds back on itself
};

// plumb_bob is the rational model with k4 = k5 = k6 = 0.
Distorted distort_polynomial(const std::array<double, 8>& c, const Vector2d& p) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double numerator = 1 + r2 * (c[0] + r2 * (c[1] + r2 * c[4]));
  const double denominator = 1 + r2 * (c[5] + r2 * (c[6] + r2 * c[7]));
  const double radial = numerator / denominator;
  const double numerator_by_r2 = c[0] + r2 * (2 * c[1] + 3 * c[4] * r2);
  const double denominator_by_r2 = c[5] + r2 * (2 * c[6] + 3 * c[7] * r2);
  const double radial_by_r2 = (numerator_by_r2 - radial * denominator_by_r2) / denominator;
  const double p1 = c[2];
  const double p2 = c[3];

  Distorted d;
  d.xy = {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
  d.by_undistorted << radial + 2 * x * x * radial_by_r2 + 2 * p1 * y + 6 * p2 * x,
      2 * x * y * radial_by_r2 + 2 * p1 * x + 2 * p2 * y,
      2 * x * y * radial_by_r2 + 2 * p1 * x + 2 * p2 * y,
      radial + 2 * y * y * radial_by_r2 + 6 * p1 * y + 2 * p2 * x;
  // d(r radial)/dr > 0: the radial part still grows outwards.
  d.valid = radial > 0 && radial + 2 * r2 * radial_by_r2 > 0;
  return d;
}

// theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8), cv::fisheye.
double fisheye_angle(const std::array<double, 8>& c, double theta, double* by_theta) {
  const double t2 = theta * theta;
  *by_theta = 1 + t2 * (3 * c[0] + t2 * (5 * c[1] + t2 * (7 * c[2] + t2 * 9 * c[3])));
  return theta * (1 + t2 * (c[0] + t2 * (c[1] + t2 * (c[2] + t2 * c[3]))));
}

Distorted distort_fisheye(const std::array<double, 8>& c, const Vector2d& p) {
  const double r = p.norm();
  Distorted d;
  if (r < 1e-8) {
    d.xy = p;
    d.by_undistorted.setIdentity();
    return d;
  }
  double angle_by_theta = 0;
  const double angle = fisheye_angle(c, std::atan(r), &angle_by_theta);
  const double scale = angle / r;
  const double scale_by_r = (angle_by_theta / (1 + r * r) - scale) / r;
  d.xy = scale * p;
  d.by_undistorted = scale * Matrix2d::Identity() + (scale_by_r / r) * p * p.transpose();
  d.valid = angle_by_theta > 0;
  return d;
}

// Davison's one-parameter wide-angle model; kd1 is in px^-2, so radii are taken in pixels.
Distorted distort_monoslam(const Camera& camera, const Vector2d& p) {
  const double k = 2 * camera.coefficients[0];
  const double fx2 = camera.fx * camera.fx;
  const double fy2 = camera.fy * camera.fy;
  const double square = 1 + k * (fx2 * p.x() * p.x() + fy2 * p.y() * p.y());
  Distorted d;
  d.valid = square > 0;
  const double scale = 1 / std::sqrt(std::max(square, 1e-12));
  d.xy = scale * p;
  const Eigen::RowVector2d square_by_p(2 * k * fx2 * p.x(), 2 * k * fy2 * p.y());
  d.by_undistorted = scale * Matrix2d::Identity() - 0.5 * scale * scale * scale * p * square_by_p;
  return d;
}

Distorted distort(const Camera& camera, const Vector2d& p) {
  switch (camera.distortion) {
    case Distortion::plumb_bob:
    case Distortion::rational_polynomial:
      return distort_polynomial(camera.coefficients, p);
    case Distortion::fisheye:
      return distort_fisheye(camera.coefficients, p);
    case Distortion::monoslam:
      return distort_monoslam(camera, p);
  }
  return {};
}

// Newton's method; a step that would leave the one-to-one region is halved.
Vector2d undistort_iteratively(const Camera& camera, const Vector2d& distorted) {
  Vector2d p = distorted;
  for (int halvings = 0; halvings < 20 && !distort(camera, p).valid; ++halvings) p *= 0.7;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Distorted d = distort(camera, p);
    const Vector2d error = d.xy - distorted;
    if (error.squaredNorm() < 1e-26) break;
    Vector2d step = d.by_undistorted.inverse() * error;
    if (!step.allFinite()) break;
    for (int halvings = 0; halvings < 8 && !distort(camera, p - step).valid; ++halvings) {
      step *= 0.5;
    }
    p -= step;
  }
  return p;
}

Vector2d undistort_fisheye(const std::array<double, 8>& c, const Vector2d& distorted) {
  const double angle = distorted.norm();
  if (angle < 1e-8) return distorted;
  double theta = std::min(angle, 1.5);
  for (int iteration = 0; iteration < 30; ++iteration) {
    double by_theta = 0;
    const double error = fisheye_angle(c, theta, &by_theta) - angle;
    if (std::abs(error) < 1e-14 || by_theta <= 0) break;
    theta = std::clamp(theta - error / by_theta, 0.0, 1.57);
  }
  return std::tan(theta) / angle * distorted;
}

Vector2d undistort_monoslam(const Camera& camera, const Vector2d& distorted) {
  const double r2 = std::pow(camera.fx * distorted.x(), 2) + std::pow(camera.fy * distorted.y(), 2);
  return distorted / std::sqrt(std::max(1 - 2 * camera.coefficients[0] * r2, 1e-6));
}

Vector2d undistort(const Camera& camera, const Vector2d& distorted) {
  switch (camera.distortion) {
    case Distortion::plumb_bob:
    case Distortion::rational_polynomial:
      return undistort_iteratively(camera, distorted);
    case Distortion::fisheye:
      return undistort_fisheye(camera.coefficients, distorted);
    case Distortion::monoslam:
      return undistort_monoslam(camera, distorted);
  }
  return distorted;
}

}  // namespace

std::string_view name(Distortion distortion) {
  switch (distortion) {
    case Distortion::plumb_bob:
      return "plumb_bob";
    case Distortion::rational_polynomial:
      return "rational_polynomial";
    case Distortion::fisheye:
      return "fisheye";
    case Distortion::monoslam:
      return "monoslam";
  }
  return "";
}

int coefficient_count(Distortion distortion) {
  switch (distortion) {
    case Distortion::plumb_bob:
      return 5;
    case Distortion::rational_polynomial:
      return 8;
    case Distortion::fisheye:
      return 4;
    case Distortion::monoslam:
      return 1;
  }
  return 0;
}

bool Camera::has_distortion() const {
  // A fisheye with zero coefficients is still not a pinhole.
  return distortion == Distortion::fisheye ||
         std::any_of(coefficients.begin(), coefficients.end(), [](double c) { return c != 0; });
}

Camera pinhole(int width, int height, double fx, double fy, double cx, double cy) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = fx;
  camera.fy = fy;
  camera.cx = cx;
  camera.cy = cy;
  return camera;
}

std::optional<Vector2d> project(const Camera& camera, const Vector3d& point_in_camera,
                                Eigen::Matrix<double, 2, 3>* pixel_by_point) {
  if (!(point_in_camera.z() > 1e-6)) return std::nullopt;
  const double inverse_z = 1 / point_in_camera.z();
  const Vector2d undistorted = point_in_camera.head<2>() * inverse_z;
  Distorted d;
  if (camera.has_distortion()) {
    d = distort(camera, undistorted);
    if (!d.valid) return std::nullopt;
  } else {
    d.xy = undistorted;
    d.by_undistorted.setIdentity();
  }
  if (pixel_by_point) {
    Eigen::Matrix<double, 2, 3> undistorted_by_point;
    undistorted_by_point << inverse_z, 0, -undistorted.x() * inverse_z, 0, inverse_z,
        -undistorted.y() * inverse_z;
    *pixel_by_point =
        Vector2d(camera.fx, camera.fy).asDiagonal() * d.by_undistorted * undistorted_by_point;
  }
  return Vector2d(camera.fx * d.xy.x() + camera.cx, camera.fy * d.xy.y() + camera.cy);
}

Vector3d unproject(const Camera& camera, const Vector2d& pixel, Matrix2d* ray_by_pixel) {
  const Vector2d distorted((pixel.x() - camera.cx) / camera.fx,
                           (pixel.y() - camera.cy) / camera.fy);
  Vector2d p = distorted;
  Matrix2d distorted_by_p = Matrix2d::Identity();
  if (camera.has_distortion()) {
    p = undistort(camera, distorted);
    if (ray_by_pixel) distorted_by_p = distort(camera, p).by_undistorted;
  }
  if (ray_by_pixel) {
    *ray_by_pixel = distorted_by_p.inverse() * Vector2d(1 / camera.fx, 1 / camera.fy).asDiagonal();
  }
  return {p.x(), p.y(), 1};
}

Camera resized(const Camera& camera, int width, int height) {
  const double sx = static_cast<double>(width) / camera.width;
  const double sy = static_cast<double>(height) / camera.height;
  Camera out = camera;
  out.width = width;
  out.height = height;
  out.fx *= sx;
  out.fy *= sy;
  out.cx = (camera.cx + 0.5) * sx - 0.5;
  out.cy = (camera.cy + 0.5) * sy - 0.5;
  if (camera.distortion == Distortion::monoslam) out.coefficients[0] /= sx * sy;
  return out;
}

}  // namespace armsreach
