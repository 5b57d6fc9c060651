// How a view maps the world to a picture: one camera model for all, with lens distortion or
// orthographic, and one shader (assets/shaders/view.glsl) that applies it.
//
// OpenGL's axes exist only in that shader's clip_from_pixel(). Everything is drawn with row 0 as
// the picture's upper edge; only showing a finished picture in a window turns it over.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "render/gl_objects.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::render {

// Pixels of a target, corner and extent.
struct Rectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

struct View {
  Camera camera;
  Pose world_from_camera;
  bool orthographic = false;  // fx, fy are then pixels per metre
  double near = 0.02;         // m along z
  double far = 50;

  // target pixel = target_offset + target_scale .* camera pixel, both with (0,0) at the centre of
  // the first pixel; letterboxing a video is such a map.
  Eigen::Vector2d target_scale{1, 1};
  Eigen::Vector2d target_offset{0, 0};
  int target_width = 0;  // px
  int target_height = 0;
};

// The view of a camera onto a picture of its own size.
View view_of(const Camera& camera, const Pose& world_from_camera);

// The largest centred copy of the camera's image in a picture of another shape, on whole pixels.
void letterbox(View& view, int width, int height);
// Where the camera's image lies in the target.
Rectangle image_rectangle(const View& view);

// Sets view.glsl's uniforms of the program in use.
void set_view(const Program& program, const View& view);

// Where a point is drawn, in target pixels; nothing when it is behind the camera or outside the
// lens model. Orthographic views show what is behind them too.
std::optional<Eigen::Vector2d> project_to_target(const View& view,
                                                 const Eigen::Vector3d& point_in_world);
Eigen::Vector2d camera_pixel_from_target(const View& view, const Eigen::Vector2d& target_pixel);

}  // namespace armsreach::render
