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
constexpr render::TextureFormat kDepthAndInstance{GL_RG32F, GL_RG, GL_FLOAT};

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

Result<render::Program> surface_program(const render::Gl& gl, std::string_view light, bool shiny) {
  std::vector<std::string_view> parts{"shaders/sim_inputs.glsl"};
  if (light != "shaders/sim_light_still.glsl") parts.push_back("shaders/sim_shadow.glsl");
  parts.push_back(light);
  parts.push_back(shiny ? "shaders/sim_shiny.glsl" : "shaders/sim_dull.glsl");
  parts.push_back("shaders/sim_surface.frag.glsl");
  return render::Program::from_assets(
      gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/sim_surface.vert.glsl"}, parts);
}

std::vector<Eigen::AlignedBox3d> boxes_of_parts(const World& world, const WorldMesh& mesh) {
  std::vector<Eigen::AlignedBox3d> boxes(world.parts.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Pose& pose =
        world.things[static_cast<std::size_t>(world.parts[i].thing)].world_from_thing;
    const MeshRange& range = mesh.parts[i];
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k)
      boxes[i].extend(pose * mesh.vertices[mesh.indices[k]].position.cast<double>());
  }
  return boxes;
}

}  // namespace

WorldRenderer::WorldRenderer(const render::Gl& gl, const World& world, const Camera& camera)
    : gl_(gl),
      world_(world),
      camera_(camera),
      anything_moves_(std::any_of(world.things.begin(), world.things.end(),
                                  [](const Thing& thing) { return thing.moves; })) {}

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
  constexpr std::array<std::string_view, kLightKinds> kLights{"shaders/sim_light_still.glsl",
                                                              "shaders/sim_light_beside.glsl",
                                                              "shaders/sim_light_moving.glsl"};
  for (std::size_t light = 0; light < kLights.size(); ++light) {
    if (light != kStill && !anything_moves_) continue;
    for (const bool shiny : {false, true}) {
      auto program = surface_program(gl_, kLights[light], shiny);
      if (!program) return program.error();
      programs_[light][shiny] = std::move(*program);
    }
  }
  return ok();
}

Status WorldRenderer::make_target() {
  auto target = render::Framebuffer::make(
      gl_, {camera_.width, camera_.height, 0, {kColor, kDepthAndInstance}, true});
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
  light_map_ = render::Texture(gl_, light->cols, light->rows, kColor);
  light_map_.upload(light->data);
  if (!anything_moves_) return ok();
  boxes_ = boxes_of_parts(world_, mesh);
  auto moving = MovingLight::make(gl_, world_, mesh, gpu_world_);
  if (!moving) return moving.error();
  moving_light_ = std::move(*moving);
  return ok();
}

ExactImages WorldRenderer::draw(const Pose& world_from_camera,
                                const std::vector<Pose>& world_from_thing) {
  if (anything_moves_) moving_light_.follow(world_, gpu_world_, world_from_thing);
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
  if (anything_moves_) moving_light_.bind();
  // Floor and walls come last: most of them is hidden and then costs nothing.
  for (const bool panel : {false, true}) {
    for (const LightKind light : {kMoving, kBeside, kStill}) {
      for (const bool shiny : {true, false})
        draw_parts({light, shiny, panel}, light == kMoving ? kMoving : kStill, world_from_camera,
                   world_from_thing);
    }
  }
  if (anything_moves_) draw_shadows(world_from_camera, world_from_thing);
  return read();
}

ExactImages WorldRenderer::read() const {
  cv::Mat color(camera_.height, camera_.width, CV_8UC4);
  target_.read(GL_BGRA, GL_UNSIGNED_BYTE, color.data, 0);
  ExactImages images;
  images.color.create(color.size(), CV_8UC3);
  images.returned.create(color.size(), CV_8U);
  std::array<cv::Mat, 2> parts{images.color, images.returned};
  constexpr std::array kChannels{0, 0, 1, 1, 2, 2, 3, 3};
  cv::mixChannels(&color, 1, parts.data(), parts.size(), kChannels.data(), 4);
  cv::Mat both(color.size(), CV_32FC2);
  target_.read(GL_RG, GL_FLOAT, both.data, 1);
  images.depth.create(color.size(), CV_32F);
  images.masks.create(color.size(), CV_16U);
  const cv::Vec2f* pixel = both.ptr<cv::Vec2f>();
  float* depth = images.depth.ptr<float>();
  std::uint16_t* mask = images.masks.ptr<std::uint16_t>();
  for (std::size_t i = 0; i < both.total(); ++i) {
    depth[i] = pixel[i][0];
    mask[i] = static_cast<std::uint16_t>(pixel[i][1]);
  }
  return images;
}

WorldRenderer::Kind WorldRenderer::kind_of(std::size_t index) const {
  const Part& part = world_.parts[index];
  Kind kind;
  kind.shiny = world_.materials[static_cast<std::size_t>(part.material)].shine > 0;
  kind.panel = std::holds_alternative<Panel>(part.shape);
  if (!anything_moves_) return kind;
  const bool moves = world_.things[static_cast<std::size_t>(part.thing)].moves;
  kind.light = moves ? kMoving : moving_light_.reaches(boxes_[index]) ? kBeside : kStill;
  return kind;
}

std::vector<Eigen::AlignedBox3d> WorldRenderer::boxes_beside() const {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (std::size_t i = 0; i < world_.parts.size(); ++i) {
    if (kind_of(i).light == kBeside) boxes.push_back(boxes_[i]);
  }
  return boxes;
}

// Once more what moving things may shade, where it is seen. With their shadows it costs four times
// as much as without.
void WorldRenderer::draw_shadows(const Pose& world_from_camera,
                                 const std::vector<Pose>& world_from_thing) const {
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Enable(GL_SCISSOR_TEST);
  for (const cv::Rect& place :
       moving_light_.seen_in(camera_, world_from_camera, boxes_beside(), world_.light)) {
    gl_.Scissor(place.x, place.y, place.width, place.height);
    for (const bool panel : {false, true}) {
      for (const bool shiny : {true, false})
        draw_parts({kBeside, shiny, panel}, kBeside, world_from_camera, world_from_thing);
    }
  }
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.DepthFunc(GL_LESS);
}

void WorldRenderer::draw_parts(const Kind& kind, LightKind light, const Pose& world_from_camera,
                               const std::vector<Pose>& world_from_thing) const {
  const render::Program& program = programs_[light][kind.shiny];
  bool ready = false;
  for (std::size_t i = 0; i < world_.parts.size(); ++i) {
    const Part& part = world_.parts[i];
    if (!(kind_of(i) == kind)) continue;
    if (!std::exchange(ready, true)) use(program, world_from_camera);
    const std::size_t material_index = static_cast<std::size_t>(part.material);
    const Material& material = world_.materials[material_index];
    const Pose& pose = world_from_thing[static_cast<std::size_t>(part.thing)];
    program.set("world_from_thing", Eigen::Matrix4f(pose.matrix().cast<float>()));
    program.set("instance", static_cast<float>(part.thing + 1));
    program.set("infrared", static_cast<float>(material.infrared));
    program.set("shine", static_cast<float>(material.shine));
    patterns_[material_index].bind(0);
    gpu_world_.draw(i);
  }
}

void WorldRenderer::use(const render::Program& program, const Pose& world_from_camera) const {
  program.use();
  render::set_view(program, render::view_of(camera_, world_from_camera));
  program.set("pattern", 0);
  program.set("light_map", 1);
  program.set("light_range", kLightRange);
  program.set("eye_in_world", Eigen::Vector3f(world_from_camera.translation().cast<float>()));
  program.set("highlight_from", Eigen::Vector3f(world_.light.towards.cast<float>()));
  if (anything_moves_) moving_light_.set(program, world_.light);
}

}  // namespace armsreach::sim
