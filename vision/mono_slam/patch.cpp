#include "vision/mono_slam/patch.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

float sample(const cv::Mat& grey, double x, double y) {
  const double greatest = 2 * Patch::kReach - 1e-6;
  x = std::clamp(x, 0.0, greatest);
  y = std::clamp(y, 0.0, greatest);
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const double fx = x - x0;
  const double fy = y - y0;
  const auto* const above = grey.ptr<unsigned char>(y0) + x0;
  const auto* const below = grey.ptr<unsigned char>(y0 + 1) + x0;
  return static_cast<float>((1 - fy) * ((1 - fx) * above[0] + fx * above[1]) +
                            fy * ((1 - fx) * below[0] + fx * below[1]));
}

// How a pixel moves with two directions of the surface.
std::optional<Matrix2d> pixel_by_surface(const Camera& camera, const Pose& world_from_camera,
                                         const Vector3d& point_in_world,
                                         const Eigen::Matrix<double, 3, 2>& tangents_in_world) {
  Eigen::Matrix<double, 2, 3> pixel_by_point;
  const Pose camera_from_world = world_from_camera.inverse();
  if (!project(camera, camera_from_world * point_in_world, &pixel_by_point)) return std::nullopt;
  return pixel_by_point * (camera_from_world.rotation_matrix() * tangents_in_world);
}

}  // namespace

Template halved(const Template& pattern) {
  Template out;
  const int half = (pattern.half() - 1) / 2;
  out.size = 2 * half + 1;
  out.pixel_from_centre = 0.5 * pattern.pixel_from_centre;
  const auto at = [&](int x, int y) {
    const int centre = pattern.half();
    return pattern.samples[static_cast<std::size_t>((centre + y) * pattern.size + centre + x)];
  };
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      float sum = 8;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          sum += static_cast<float>((2 - dx * dx) * (2 - dy * dy)) * at(2 * x + dx, 2 * y + dy);
        }
      }
      out.samples[static_cast<std::size_t>((y + half) * out.size + x + half)] =
          std::floor(sum / 16);
    }
  }
  return out;
}

Template Patch::original() const { return warped(*this, Matrix2d::Identity()); }

Patch patch_at(const cv::Mat& image, const Vector2d& pixel, int size, const Camera& camera,
               const Pose& world_from_camera) {
  CV_Assert(image.type() == CV_8UC1 && size % 2 == 1 && size <= 15);
  Patch out;
  out.size = size;
  out.pixel = pixel;
  out.world_from_camera = world_from_camera;
  out.normal_in_world = -(world_from_camera.rotation() * unproject(camera, pixel)).normalized();
  const int side = 2 * Patch::kReach + 1;
  out.grey.create(side, side, CV_8UC1);
  const int left = static_cast<int>(std::lround(pixel.x())) - Patch::kReach;
  const int top = static_cast<int>(std::lround(pixel.y())) - Patch::kReach;
  for (int y = 0; y < side; ++y) {
    const auto* const line = image.ptr<unsigned char>(std::clamp(top + y, 0, image.rows - 1));
    auto* const to = out.grey.ptr<unsigned char>(y);
    for (int x = 0; x < side; ++x) to[x] = line[std::clamp(left + x, 0, image.cols - 1)];
  }
  return out;
}

Template template_of(const cv::Mat& grey) {
  CV_Assert(grey.type() == CV_8UC1 && grey.cols == grey.rows && grey.cols % 2 == 1 &&
            grey.cols <= 15);
  Template out;
  out.size = grey.cols;
  for (int y = 0; y < out.size; ++y) {
    for (int x = 0; x < out.size; ++x) {
      out.samples[static_cast<std::size_t>(y * out.size + x)] = grey.at<unsigned char>(y, x);
    }
  }
  return out;
}

Matrix2d warp(const Patch& patch, const Vector3d& point_in_world, const Camera& camera,
              const Pose& world_from_camera) {
  const Vector3d& normal = patch.normal_in_world;
  Eigen::Matrix<double, 3, 2> tangents;
  tangents.col(0) =
      normal.cross(std::abs(normal.x()) < 0.7 ? Vector3d::UnitX() : Vector3d::UnitY()).normalized();
  tangents.col(1) = normal.cross(tangents.col(0));
  const auto first = pixel_by_surface(camera, patch.world_from_camera, point_in_world, tangents);
  const auto now = pixel_by_surface(camera, world_from_camera, point_in_world, tangents);
  if (!first || !now) return Matrix2d::Identity();
  // Nearly edge on, or too large a change to be the same picture.
  const Matrix2d out = *first * now->inverse();
  if (!out.allFinite() || out.cwiseAbs().maxCoeff() > 4) return Matrix2d::Identity();
  return out;
}

Template warped(const Patch& patch, const Matrix2d& first_from_now) {
  Template out;
  out.size = patch.size;
  const Vector2d rest =
      patch.pixel - Vector2d(std::round(patch.pixel.x()), std::round(patch.pixel.y()));
  out.pixel_from_centre = first_from_now.inverse() * rest;
  const int half = out.half();
  for (int y = -half; y <= half; ++y) {
    for (int x = -half; x <= half; ++x) {
      const Vector2d in_first = first_from_now * Vector2d(x, y);
      out.samples[static_cast<std::size_t>((y + half) * out.size + x + half)] = std::round(
          sample(patch.grey, Patch::kReach + in_first.x(), Patch::kReach + in_first.y()));
    }
  }
  return out;
}

}  // namespace armsreach::mono_slam
