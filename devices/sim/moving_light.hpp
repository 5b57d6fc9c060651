// Shadows to and from the things that move, drawn anew for each frame: the key light's, and the
// dimness close below them.
#pragma once

#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>

#include "devices/sim/gpu_world.hpp"
#include "devices/sim/shadow_camera.hpp"
#include "devices/sim/world.hpp"
#include "devices/sim/world_mesh.hpp"
#include "render/gl_objects.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

class MovingLight {
 public:
  MovingLight() = default;
  // Draws what the still things shade, once.
  static Result<MovingLight> make(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                                  const GpuWorld& gpu_world);

  // Takes up where the things are now; draws anew only when one has moved.
  void follow(const World& world, const GpuWorld& gpu_world, const std::vector<Pose>& poses);

  // Whether anything in this box can be other than it was gathered.
  bool reaches(const Eigen::AlignedBox3d& box) const;

  // The places in a picture where that may be seen on still parts in these boxes; they may overlap.
  std::vector<cv::Rect> seen_in(const Camera& camera, const Pose& world_from_camera,
                                const std::vector<Eigen::AlignedBox3d>& beside,
                                const Light& light) const;

  // The maps and masks, to units 2 to 6; then, for each program in use, the uniforms of
  // sim_shadow.glsl, sim_light_beside.glsl and sim_light_moving.glsl.
  void bind() const;
  void set(const render::Program& program, const Light& light) const;

 private:
  struct Map {
    ShadowCamera camera;
    render::Texture mask;  // coarse: 255 where anything may be shaded or covered
    Eigen::Matrix4f map_from_world = Eigen::Matrix4f::Identity();
    float texel = 0;  // m
    void draw(const World& world, const GpuWorld& gpu_world, const std::vector<Pose>& poses,
              const WantedPart& wanted, const Eigen::Vector3d& towards_light, const Ball& ball);
  };
  // Marks what lies along the map's way within `margin` m of any thing that moves.
  void mark(Map& map, double margin) const;

  std::vector<Eigen::AlignedBox3d> boxes_;   // of each thing that moves, in its frame; else empty
  std::vector<Pose> poses_;                  // that the maps are drawn for
  std::vector<Eigen::AlignedBox3d> shaded_;  // around what each of them may shade or cover
  Map still_;
  Map movers_;
  Map under_;
};

}  // namespace armsreach::sim
