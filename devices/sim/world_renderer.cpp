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
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

Result<render::Program> surface_program(const render::Gl& gl, std::string_view highlight) {
  return render::Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/sim_surface.vert.glsl"},
      {highlight, "shaders/sim_surface.frag.glsl"});
}

}  // namespace

WorldRenderer::WorldRenderer(const render::Gl& gl, const World& world, const Camera& camera)
    : gl_(gl), world_(world), camera_(camera) {}

Result<std::unique_ptr<WorldRenderer>> WorldRenderer::make(const render::Gl& gl, const World& world,
                                                           const Camera& camera,
                                                           std::uint64_t seed) {
  std::unique_ptr<WorldRenderer> made(new WorldRenderer(gl, world, camera));
  if (auto status = made->make_programs(); !status) return status.error();
  if (auto status = made->make_target(); !status) return status.error();
  if (auto status = made->paint(seed); !status) return status.error();
  return made;
}

Status WorldRenderer::make_programs() {
  auto dull = surface_program(gl_, "shaders/sim_dull.glsl");
  if (!dull) return dull.error();
  auto shiny = surface_program(gl_, "shaders/sim_shiny.glsl");
  if (!shiny) return shiny.error();
  dull_ = std::move(*dull);
  shiny_ = std::move(*shiny);
  return ok();
}

Status WorldRenderer::make_target() {
  auto target =
      render::Framebuffer::make(gl_, {camera_.width, camera_.height, 0, {kColor, kDepth}, true});
  if (!target) return target.error();
  target_ = std::move(*target);
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
  target_.bind();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  // Row 0 of the target is the picture's upper edge, which turns the sense of rotation over.
  gl_.Enable(GL_CULL_FACE);
  gl_.FrontFace(GL_CW);
  constexpr std::array kBlack{0.0F, 0.0F, 0.0F, 0.0F};
  constexpr std::array kUnknown{std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F, 0.0F};
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.ClearBufferfv(GL_COLOR, 0, kBlack.data());
  gl_.ClearBufferfv(GL_COLOR, 1, kUnknown.data());
  gpu_world_.bind();
  light_map_.bind(1);
  draw_things(shiny_, world_from_camera,
              [](const Thing&, const Material& material) { return material.shine > 0; });
  // Floor and walls come last: most of them is hidden and then costs nothing.
  for (const bool panels : {false, true}) {
    draw_things(dull_, world_from_camera, [panels](const Thing& thing, const Material& material) {
      return material.shine == 0 && std::holds_alternative<Panel>(thing.shape) == panels;
    });
  }
  return read();
}

ExactImages WorldRenderer::read() const {
  cv::Mat color(camera_.height, camera_.width, CV_8UC4);
  target_.read(GL_BGRA, GL_UNSIGNED_BYTE, color.data, 0);
  ExactImages images;
  images.depth.create(color.size(), CV_32F);
  target_.read(GL_RED, GL_FLOAT, images.depth.data, 1);
  images.color.create(color.size(), CV_8UC3);
  images.returned.create(color.size(), CV_8U);
  std::array<cv::Mat, 2> parts{images.color, images.returned};
  constexpr std::array kChannels{0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(&color, 1, parts.data(), parts.size(), kChannels.data(), 4);
  return images;
}

template <class Wanted>
void WorldRenderer::draw_things(const render::Program& program, const Pose& world_from_camera,
                                const Wanted& wanted) const {
  program.use();
  render::set_view(program, render::view_of(camera_, world_from_camera));
  program.set("pattern", 0);
  program.set("light_map", 1);
  program.set("light_range", kLightRange);
  program.set("eye_in_world", Eigen::Vector3f(world_from_camera.translation().cast<float>()));
  program.set("towards_light", Eigen::Vector3f(world_.light.towards.cast<float>()));
  for (std::size_t i = 0; i < world_.things.size(); ++i) {
    const Thing& thing = world_.things[i];
    const std::size_t material_index = static_cast<std::size_t>(thing.material);
    const Material& material = world_.materials[material_index];
    if (!wanted(thing, material)) continue;
    program.set("world_from_thing", Eigen::Matrix4f(thing.world_from_thing.matrix().cast<float>()));
    program.set("infrared", static_cast<float>(material.infrared));
    program.set("shine", static_cast<float>(material.shine));
    patterns_[material_index].bind(0);
    gpu_world_.draw(i);
  }
}

}  // namespace armsreach::sim
