#include "devices/sim/world_renderer.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "devices/sim/light_map.hpp"
#include "devices/sim/pattern.hpp"
#include "devices/sim/random.hpp"
#include "render/view.hpp"

namespace armsreach::sim {
namespace {

constexpr int kSamples = 4;
constexpr render::TextureFormat kColor{GL_RGBA8, GL_BGRA, GL_UNSIGNED_BYTE};
constexpr render::TextureFormat kDepth{GL_R32F, GL_RED, GL_FLOAT};

// A texture that repeats, with all its reductions.
render::Texture make_texture(const render::Gl& gl, const cv::Mat& bgr) {
  cv::Mat image;
  cv::cvtColor(bgr, image, cv::COLOR_BGR2BGRA);
  render::Texture texture(gl, image.cols, image.rows, kColor);
  texture.upload(image.data);
  for (int level = 1; image.cols > 1 || image.rows > 1; ++level) {
    cv::Mat half;
    cv::resize(image, half, {std::max(1, image.cols / 2), std::max(1, image.rows / 2)}, 0, 0,
               cv::INTER_AREA);
    image = half;
    gl.TexImage2D(GL_TEXTURE_2D, level, kColor.internal, image.cols, image.rows, 0, kColor.format,
                  kColor.type, image.data);
  }
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

Result<render::Program> surface_program(const render::Gl& gl,
                                        const std::vector<std::string_view>& fragment) {
  return render::Program::from_assets(gl, {"shaders/view.glsl", "shaders/sim_surface.vertex.glsl"},
                                      fragment);
}

}  // namespace

WorldRenderer::WorldRenderer(const render::Gl& gl, const World& world, const Camera& camera)
    : gl_(gl), world_(world), camera_(camera) {}

Result<std::unique_ptr<WorldRenderer>> WorldRenderer::make(const render::Gl& gl, const World& world,
                                                           const Camera& camera,
                                                           std::uint64_t seed) {
  std::unique_ptr<WorldRenderer> made(new WorldRenderer(gl, world, camera));
  if (auto status = made->make_programs(); !status) return status.error();
  if (auto status = made->make_targets(); !status) return status.error();
  if (auto status = made->paint(seed); !status) return status.error();
  return made;
}

Status WorldRenderer::make_programs() {
  auto dull = surface_program(gl_, {"shaders/sim_dull.glsl", "shaders/sim_color.fragment.glsl"});
  if (!dull) return dull.error();
  auto shiny = surface_program(gl_, {"shaders/sim_shiny.glsl", "shaders/sim_color.fragment.glsl"});
  if (!shiny) return shiny.error();
  auto depth = surface_program(gl_, {"shaders/sim_depth.fragment.glsl"});
  if (!depth) return depth.error();
  dull_ = std::move(*dull);
  shiny_ = std::move(*shiny);
  depth_ = std::move(*depth);
  return ok();
}

Status WorldRenderer::make_targets() {
  auto color =
      render::Framebuffer::make(gl_, {camera_.width, camera_.height, kSamples, {kColor}, true});
  if (!color) return color.error();
  // Depth is that of the ray through the pixel's centre: an average over samples would lie in
  // mid-air at edges.
  auto depth = render::Framebuffer::make(gl_, {camera_.width, camera_.height, 0, {kDepth}, true});
  if (!depth) return depth.error();
  color_target_ = std::move(*color);
  depth_target_ = std::move(*depth);
  return ok();
}

Status WorldRenderer::paint(std::uint64_t seed) {
  for (std::size_t i = 0; i < world_.materials.size(); ++i)
    patterns_.push_back(make_texture(gl_, paint_pattern(world_.materials[i], mixed(seed, i))));
  const WorldMesh mesh = mesh_of(world_);
  gpu_world_ = GpuWorld(gl_, mesh);
  auto light = gather_light(gl_, world_, mesh, gpu_world_);
  if (!light) return light.error();
  cv::Mat image;
  cv::cvtColor(*light, image, cv::COLOR_BGR2BGRA);
  light_map_ = render::Texture(gl_, image.cols, image.rows, kColor);
  light_map_.upload(image.data);
  return ok();
}

ExactImages WorldRenderer::draw(const Pose& world_from_camera) const {
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  // Row 0 of a target is the picture's upper edge, which turns the sense of rotation over.
  gl_.Enable(GL_CULL_FACE);
  gl_.FrontFace(GL_CW);
  gpu_world_.bind();
  draw_color(world_from_camera);
  draw_depth(world_from_camera);

  cv::Mat color(camera_.height, camera_.width, CV_8UC4);
  color_target_.read(GL_BGRA, GL_UNSIGNED_BYTE, color.data);
  ExactImages images;
  images.depth.create(camera_.height, camera_.width, CV_32F);
  depth_target_.read(GL_RED, GL_FLOAT, images.depth.data);
  images.color.create(color.size(), CV_8UC3);
  images.returned.create(color.size(), CV_8U);
  std::array<cv::Mat, 2> parts{images.color, images.returned};
  constexpr std::array kChannels{0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(&color, 1, parts.data(), parts.size(), kChannels.data(), 4);
  return images;
}

void WorldRenderer::draw_color(const Pose& world_from_camera) const {
  color_target_.bind();
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  light_map_.bind(1);
  for (const bool shiny : {false, true}) {
    const render::Program& program = shiny ? shiny_ : dull_;
    program.use();
    render::set_view(program, render::view_of(camera_, world_from_camera));
    program.set("pattern", 0);
    program.set("light_map", 1);
    program.set("light_range", kLightRange);
    program.set("eye_in_world", Eigen::Vector3f(world_from_camera.translation().cast<float>()));
    program.set("towards_light", Eigen::Vector3f(world_.light.towards.cast<float>()));
    draw_things(program, shiny);
  }
  color_target_.resolve();
}

void WorldRenderer::draw_things(const render::Program& program, bool shiny) const {
  for (std::size_t i = 0; i < world_.things.size(); ++i) {
    const Thing& thing = world_.things[i];
    const Material& material = material_of(thing);
    if ((material.shine > 0) != shiny) continue;
    program.set("world_from_thing", Eigen::Matrix4f(thing.world_from_thing.matrix().cast<float>()));
    program.set("infrared", static_cast<float>(material.infrared));
    program.set("shine", static_cast<float>(material.shine));
    patterns_[static_cast<std::size_t>(thing.material)].bind(0);
    gpu_world_.draw(i);
  }
}

void WorldRenderer::draw_depth(const Pose& world_from_camera) const {
  depth_target_.bind();
  gl_.ClearColor(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  depth_.use();
  render::set_view(depth_, render::view_of(camera_, world_from_camera));
  for (std::size_t i = 0; i < world_.things.size(); ++i) {
    depth_.set("world_from_thing",
               Eigen::Matrix4f(world_.things[i].world_from_thing.matrix().cast<float>()));
    gpu_world_.draw(i);
  }
}

}  // namespace armsreach::sim
