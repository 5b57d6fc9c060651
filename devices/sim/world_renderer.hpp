// Draws a simulated world as a camera sees it: colour, exact depth, which thing is where, and how
// much of a depth camera's light comes back.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/gpu_world.hpp"
#include "devices/sim/moving_light.hpp"
#include "devices/sim/world.hpp"
#include "render/gl_objects.hpp"
#include "vision/core/camera.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach::sim {

struct ExactImages {
  cv::Mat color;     // CV_8UC3 BGR
  cv::Mat depth;     // CV_32F m along z, NaN where the world is open
  cv::Mat returned;  // CV_8U, share of infra-red light in 255ths
  cv::Mat masks;     // CV_16U, the thing's index + 1; 0 where the world is open
};

// Lives and dies on the thread of its context.
class WorldRenderer {
 public:
  // Paints all textures and gathers the light. `camera` is a plain pinhole.
  static Result<std::unique_ptr<WorldRenderer>> make(const render::Gl& gl, const World& world,
                                                     const Camera& camera, std::uint64_t seed);
  // `world_from_thing`: of all things; those that do not move are where they were at the start.
  ExactImages draw(const Pose& world_from_camera, const std::vector<Pose>& world_from_thing);

 private:
  WorldRenderer(const render::Gl& gl, const World& world, const Camera& camera);
  Status make_programs();
  Status make_target();
  Status paint(std::uint64_t seed);

  // Where a part's light comes from, and whether it mirrors any.
  enum LightKind { kStill, kBeside, kMoving, kLightKinds };
  struct Kind {
    LightKind light = kStill;
    bool shiny = false;
    bool panel = false;
    bool operator==(const Kind&) const = default;
  };
  Kind kind_of(std::size_t part) const;
  std::vector<Eigen::AlignedBox3d> boxes_beside() const;  // of what moving things may shade
  // `light`: how they are lit, which for kBeside may be as if nothing moved.
  void draw_shadows(const Pose& world_from_camera, const std::vector<Pose>& world_from_thing) const;
  void draw_parts(const Kind& kind, LightKind light, const Pose& world_from_camera,
                  const std::vector<Pose>& world_from_thing) const;
  void use(const render::Program& program, const Pose& world_from_camera) const;
  ExactImages read() const;

  const render::Gl& gl_;
  World world_;
  Camera camera_;
  GpuWorld gpu_world_;
  std::vector<Eigen::AlignedBox3d> boxes_;  // in the world, of the parts that stay where they are
  bool anything_moves_ = false;
  MovingLight moving_light_;                                          // where anything moves
  std::array<std::array<render::Program, 2>, kLightKinds> programs_;  // dull, shiny
  std::vector<render::Texture> patterns_;                             // by material
  render::Texture light_map_;
  render::Framebuffer target_;  // colour, with infra-red in its alpha; depth and instance
};

}  // namespace armsreach::sim
