// Draws a simulated world as a camera sees it: colour, exact depth, and how much of a depth
// camera's light comes back.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "devices/sim/gpu_world.hpp"
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
};

// Lives and dies on the thread of its context.
class WorldRenderer {
 public:
  // Paints all textures and gathers the light. `camera` is a plain pinhole.
  static Result<std::unique_ptr<WorldRenderer>> make(const render::Gl& gl, const World& world,
                                                     const Camera& camera, std::uint64_t seed);
  // Moves a thing of the world; the light on it stays as it was gathered.
  void place(std::size_t thing, const Pose& world_from_thing) {
    world_.things[thing].world_from_thing = world_from_thing;
  }
  ExactImages draw(const Pose& world_from_camera) const;

 private:
  WorldRenderer(const render::Gl& gl, const World& world, const Camera& camera);
  Status make_programs();
  Status make_target();
  Status paint(std::uint64_t seed);

  // Those things that `wanted(thing, material)` picks.
  template <class Wanted>
  void draw_things(const render::Program& program, const Pose& world_from_camera,
                   const Wanted& wanted) const;
  ExactImages read() const;

  const render::Gl& gl_;
  World world_;
  Camera camera_;
  GpuWorld gpu_world_;
  render::Program dull_;
  render::Program shiny_;
  std::vector<render::Texture> patterns_;  // by material
  render::Texture light_map_;
  render::Framebuffer target_;  // colour, with infra-red in its alpha; depth
};

}  // namespace armsreach::sim
