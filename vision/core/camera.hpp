// Camera models. Pixel (0,0) is the centre of the top-left pixel; the camera looks along +z with
// x right and y down. Units: pixels, metres; distortion coefficients as OpenCV defines them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace armsreach {

enum class Distortion {
  plumb_bob,            // k1 k2 p1 p2 k3
  rational_polynomial,  // k1 k2 p1 p2 k3 k4 k5 k6
  fisheye,              // k1 k2 k3 k4, Kannala-Brandt as in cv::fisheye
  monoslam,             // kd1 [px^-2]: u_d = u_0 + (u_u - u_0) / sqrt(1 + 2 kd1 r_u^2)
};
std::string_view name(Distortion distortion);
int coefficient_count(Distortion distortion);

struct Camera {
  std::string name;
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  Distortion distortion = Distortion::plumb_bob;
  std::array<double, 8> coefficients{};
  double depth_units_per_metre = 1000;  // of 16-bit depth images; meaningless for colour cameras

  bool has_distortion() const;
  bool contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 &&
           pixel.y() < height - 0.5;
  }
};

Camera pinhole(int width, int height, double fx, double fy, double cx, double cy);

// Pixel of a point in the camera's frame; nothing when it is behind the camera or beyond the angle
// up to which the distortion is one-to-one. `pixel_by_point`, when given, receives the Jacobian.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point_in_camera,
                                       Eigen::Matrix<double, 2, 3>* pixel_by_point = nullptr);

// The ray (x, y, 1) through a pixel: depth [m] times the ray is the point. `ray_by_pixel`, when
// given, receives the Jacobian of (x, y) by the pixel.
Eigen::Vector3d unproject(const Camera& camera, const Eigen::Vector2d& pixel,
                          Eigen::Matrix2d* ray_by_pixel = nullptr);

// The same camera giving images of another size (area-averaged, so pixel centres shift by halves).
Camera resized(const Camera& camera, int width, int height);

}  // namespace armsreach
