#include "devices/sim/light_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "render/view.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

constexpr int kKeyDirections = 40;
constexpr int kRoomDirections = 120;
constexpr int kMapSide = 768;      // px, of the depths seen from a light
constexpr float kOffset = 0.004F;  // m, a pixel or two of those
constexpr double kGoldenAngle = 2.39996322972865332;

struct FarLight {
  Vector3d towards;  // unit
  Color radiance;    // on a surface that faces it
};

// Directions spread evenly over the key light's disc and over the sphere, on Fermat's and
// Fibonacci's spirals.
std::vector<FarLight> far_lights(const Light& light) {
  std::vector<FarLight> lights;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), light.towards);
  for (int i = 0; i < kKeyDirections; ++i) {
    const double tilt = light.spread * std::sqrt((i + 0.5) / kKeyDirections);
    const double turned = i * kGoldenAngle;
    const Vector3d local(std::sin(tilt) * std::cos(turned), std::sin(tilt) * std::sin(turned),
                         std::cos(tilt));
    lights.push_back({turn * local, light.key / kKeyDirections});
  }
  for (int i = 0; i < kRoomDirections; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kRoomDirections;
    const double radius = std::sqrt(1 - z * z);
    const double turned = i * kGoldenAngle;
    const Color radiance = light.below + (0.5 + 0.5 * z) * (light.above - light.below);
    // Irradiance is the integral of radiance times cosine; a radiance of 1 all around makes pi,
    // which counts as a light of 1.
    lights.push_back({{radius * std::cos(turned), radius * std::sin(turned), z},
                      radiance * 4 / kRoomDirections});
  }
  return lights;
}

struct Ball {
  Vector3d centre{0, 0, 0};
  double radius = 0;
};

bool casts_shadow(const Thing& thing) { return !std::holds_alternative<Panel>(thing.shape); }

Ball ball_around_casters(const World& world, const WorldMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    if (!casts_shadow(world.things[i])) continue;
    const MeshRange& range = mesh.things[i];
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      box.extend(world.things[i].world_from_thing *
                 mesh.vertices[mesh.indices[k]].position.cast<double>());
    }
  }
  if (box.isEmpty()) return {};
  return {box.center(), 0.5 * box.diagonal().norm()};
}

render::View view_from(const Vector3d& towards_light, const Ball& ball) {
  const Eigen::Quaterniond rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), -towards_light);
  const double radius = 1.05 * ball.radius + 0.01;  // the map's rim stays empty
  const double pixels_per_metre = kMapSide / (2 * radius);
  const Camera camera = pinhole(kMapSide, kMapSide, pixels_per_metre, pixels_per_metre,
                                0.5 * kMapSide - 0.5, 0.5 * kMapSide - 0.5);
  render::View view = render::view_of(camera, {rotation, ball.centre + radius * towards_light});
  view.orthographic = true;
  view.near = 0;
  view.far = 2 * radius;
  return view;
}

constexpr render::TextureFormat kFloats4{GL_RGBA32F, GL_RGBA, GL_FLOAT};
constexpr render::TextureFormat kFloats1{GL_R32F, GL_RED, GL_FLOAT};

// The passes that gather light, with what they draw into.
class Gatherer {
 public:
  static Result<Gatherer> make(const render::Gl& gl, const WorldMesh& mesh) {
    Gatherer made;
    made.gl_ = &gl;
    auto depth =
        render::Program::from_assets(gl, {"shaders/view.glsl", "shaders/sim_surface.vertex.glsl"},
                                     {"shaders/sim_depth.fragment.glsl"});
    if (!depth) return depth.error();
    auto gather =
        render::Program::from_assets(gl, {"shaders/sim_gather.vertex.glsl"},
                                     {"shaders/view.glsl", "shaders/sim_gather.fragment.glsl"});
    if (!gather) return gather.error();
    auto depths = render::Framebuffer::make(gl, {kMapSide, kMapSide, 0, {kFloats1}, true});
    if (!depths) return depths.error();
    auto sum =
        render::Framebuffer::make(gl, {mesh.atlas_width, mesh.atlas_height, 0, {kFloats4}, false});
    if (!sum) return sum.error();
    made.depth_ = std::move(*depth);
    made.gather_ = std::move(*gather);
    made.depths_ = std::move(*depths);
    made.sum_ = std::move(*sum);
    made.upload_texels(mesh);
    made.sum_.bind();
    gl.ClearColor(0, 0, 0, 0);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    return made;
  }

  void draw_depths(const render::View& view, const World& world, const GpuWorld& gpu_world) const {
    depths_.bind();
    gl_->ClearColor(1e6F, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->Disable(GL_BLEND);
    gl_->Disable(GL_CULL_FACE);
    depth_.use();
    render::set_view(depth_, view);
    gpu_world.bind();
    for (std::size_t i = 0; i < world.things.size(); ++i) {
      if (!casts_shadow(world.things[i])) continue;
      depth_.set("world_from_thing",
                 Eigen::Matrix4f(world.things[i].world_from_thing.matrix().cast<float>()));
      gpu_world.draw(i);
    }
  }

  void add(const FarLight& light, const render::View& view) const {
    sum_.bind();
    gl_->Disable(GL_DEPTH_TEST);
    gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_ONE, GL_ONE);
    gather_.use();
    render::set_view(gather_, view);
    gather_.set("positions", 0);
    gather_.set("normals", 1);
    gather_.set("nearest", 2);
    gather_.set("towards_light", Eigen::Vector3f(light.towards.cast<float>()));
    gather_.set("radiance", Eigen::Vector3f(light.radiance.cast<float>()));
    gather_.set("offset", kOffset);
    positions_.bind(0);
    normals_.bind(1);
    depths_.color().bind(2);
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
    gl_->Disable(GL_BLEND);
  }

  cv::Mat read() const {
    cv::Mat light(sum_.height(), sum_.width(), CV_32FC4);
    sum_.read(GL_RGBA, GL_FLOAT, light.data);
    cv::Mat coded(light.size(), CV_8UC3);
    const auto code = [](float value) {
      return cv::saturate_cast<std::uint8_t>(255 / kLightRange * std::sqrt(value));
    };
    for (int y = 0; y < light.rows; ++y) {
      for (int x = 0; x < light.cols; ++x) {
        const cv::Vec4f& rgb = light.at<cv::Vec4f>(y, x);
        coded.at<cv::Vec3b>(y, x) = {code(rgb[2]), code(rgb[1]), code(rgb[0])};
      }
    }
    return coded;
  }

 private:
  void upload_texels(const WorldMesh& mesh) {
    std::vector<Eigen::Vector4f> positions;
    std::vector<Eigen::Vector4f> normals;
    for (const LightTexel& texel : mesh.texels) {
      positions.push_back(texel.position);
      normals.push_back(texel.normal);
    }
    positions_ = render::Texture(*gl_, mesh.atlas_width, mesh.atlas_height, kFloats4, GL_NEAREST);
    positions_.upload(positions.data());
    normals_ = render::Texture(*gl_, mesh.atlas_width, mesh.atlas_height, kFloats4, GL_NEAREST);
    normals_.upload(normals.data());
  }

  const render::Gl* gl_ = nullptr;
  render::Program depth_;
  render::Program gather_;
  render::Framebuffer depths_;
  render::Framebuffer sum_;
  render::Texture positions_;
  render::Texture normals_;
};

}  // namespace

Result<cv::Mat> gather_light(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                             const GpuWorld& gpu_world) {
  auto gatherer = Gatherer::make(gl, mesh);
  if (!gatherer) return gatherer.error();
  const Ball ball = ball_around_casters(world, mesh);
  for (const FarLight& light : far_lights(world.light)) {
    const render::View view = view_from(light.towards, ball);
    gatherer->draw_depths(view, world, gpu_world);
    gatherer->add(light, view);
  }
  return gatherer->read();
}

}  // namespace armsreach::sim
