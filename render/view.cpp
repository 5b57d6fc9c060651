#include "render/view.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace armsreach::render {
namespace {

enum class Model { pinhole, polynomial, fisheye, monoslam, orthographic };  // as in view.glsl

Model model_of(const View& view) {
  if (view.orthographic) return Model::orthographic;
  if (!view.camera.has_distortion()) return Model::pinhole;
  switch (view.camera.distortion) {
    case Distortion::plumb_bob:
    case Distortion::rational_polynomial:
      return Model::polynomial;
    case Distortion::fisheye:
      return Model::fisheye;
    case Distortion::monoslam:
      return Model::monoslam;
  }
  return Model::pinhole;
}

// The undistorted radius up to which points project in every direction that the image shows.
double max_radius(const Camera& camera) {
  const auto projects = [&camera](double radius) {
    const double step = 0.25 * 3.14159265358979323846;
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d ray(radius * std::cos(i * step), radius * std::sin(i * step), 1);
      if (!project(camera, ray)) return false;
    }
    return true;
  };
  double inside = 0;
  double outside = 20;
  if (projects(outside)) return outside;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (inside + outside);
    (projects(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

View view_of(const Camera& camera, const Pose& world_from_camera) {
  View view;
  view.camera = camera;
  view.world_from_camera = world_from_camera;
  view.target_width = camera.width;
  view.target_height = camera.height;
  return view;
}

void letterbox(View& view, int width, int height) {
  const Eigen::Array2d image(view.camera.width, view.camera.height);
  const Eigen::Array2d target(width, height);
  const Eigen::Array2d shown = (image * (target / image).minCoeff()).round().max(1);
  const Eigen::Array2d corner = ((target - shown) / 2).floor();
  view.target_scale = shown / image;
  // Edges correspond, so centres of first pixels are half a pixel inside on both sides.
  view.target_offset = corner + 0.5 * view.target_scale.array() - 0.5;
  view.target_width = width;
  view.target_height = height;
}

Rectangle image_rectangle(const View& view) {
  const Eigen::Array2d scale = view.target_scale;
  const Eigen::Array2i corner =
      (view.target_offset.array() - 0.5 * scale + 0.5).round().cast<int>();
  const Eigen::Array2i extent =
      (scale * Eigen::Array2d(view.camera.width, view.camera.height)).round().cast<int>();
  return {corner.x(), corner.y(), extent.x(), extent.y()};
}

void set_view(const Program& program, const View& view) {
  const Camera& camera = view.camera;
  const Model model = model_of(view);
  const Eigen::Matrix4f camera_from_world = view.world_from_camera.inverse().matrix().cast<float>();
  program.set("view_model", static_cast<int>(model));
  program.set("view_focal_centre",
              Eigen::Vector4d(camera.fx, camera.fy, camera.cx, camera.cy).cast<float>().eval());
  Eigen::Vector4d target_from_pixel;
  target_from_pixel << view.target_scale, view.target_offset;
  program.set("view_target_from_pixel", target_from_pixel.cast<float>().eval());
  program.set("target_size", Eigen::Vector2f(static_cast<float>(view.target_width),
                                             static_cast<float>(view.target_height)));
  program.set("view_near_far",
              Eigen::Vector2f(static_cast<float>(view.near), static_cast<float>(view.far)));
  program.set("view_camera_from_world", camera_from_world);
  if (model == Model::pinhole || model == Model::orthographic) return;
  program.set("view_coefficients",
              std::vector<float>(camera.coefficients.begin(), camera.coefficients.end()));
  program.set("view_max_radius", static_cast<float>(max_radius(camera)));
}

std::optional<Eigen::Vector2d> project_to_target(const View& view,
                                                 const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector3d p = view.world_from_camera.inverse() * point_in_world;
  const Camera& camera = view.camera;
  std::optional<Eigen::Vector2d> pixel;
  if (view.orthographic) {
    pixel = Eigen::Vector2d(camera.fx * p.x() + camera.cx, camera.fy * p.y() + camera.cy);
  } else {
    pixel = project(camera, p);
  }
  if (!pixel) return std::nullopt;
  return view.target_offset + view.target_scale.cwiseProduct(*pixel);
}

Eigen::Vector2d camera_pixel_from_target(const View& view, const Eigen::Vector2d& target_pixel) {
  return (target_pixel - view.target_offset).cwiseQuotient(view.target_scale);
}

}  // namespace armsreach::render
