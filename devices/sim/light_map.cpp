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

constexpr int kKeyDirections = 24;
constexpr int kRoomDirections = 72;
constexpr int kMapSide = 512;      // px, of the depths seen from a light
constexpr float kOffset = 0.005F;  // m, off the surface, so that it does not shade itself
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

// Draws depths as seen from a light.
class ShadowCamera {
 public:
  static Result<ShadowCamera> make(const render::Gl& gl) {
    auto program = render::Program::from_assets(
        gl, {"shaders/target.glsl", "shaders/view.glsl", "shaders/sim_surface.vert.glsl"},
        {"shaders/sim_depth.frag.glsl"});
    if (!program) return program.error();
    constexpr render::TextureFormat kFloats{GL_R32F, GL_RED, GL_FLOAT};
    auto target = render::Framebuffer::make(gl, {kMapSide, kMapSide, 0, {kFloats}, true});
    if (!target) return target.error();
    ShadowCamera made;
    made.gl_ = &gl;
    made.program_ = std::move(*program);
    made.target_ = std::move(*target);
    made.depths_.create(kMapSide, kMapSide, CV_32F);
    return made;
  }

  // CV_32F m along the light's way; far where nothing is.
  const cv::Mat& draw(const render::View& view, const World& world, const GpuWorld& gpu_world) {
    target_.bind();
    gl_->ClearColor(1e6F, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_->Enable(GL_DEPTH_TEST);
    gl_->Disable(GL_BLEND);
    gl_->Disable(GL_CULL_FACE);
    program_.use();
    render::set_view(program_, view);
    gpu_world.bind();
    for (std::size_t i = 0; i < world.things.size(); ++i) {
      if (!casts_shadow(world.things[i])) continue;
      program_.set("world_from_thing",
                   Eigen::Matrix4f(world.things[i].world_from_thing.matrix().cast<float>()));
      gpu_world.draw(i);
    }
    target_.read(GL_RED, GL_FLOAT, depths_.data);
    return depths_;
  }

 private:
  const render::Gl* gl_ = nullptr;
  render::Program program_;
  render::Framebuffer target_;
  cv::Mat depths_;
};

// Adds one light to all texels that see it.
void add_light(const FarLight& light, const render::View& view, const cv::Mat& depths,
               const std::vector<LightTexel>& texels, std::vector<Eigen::Array3f>& sum) {
  const Eigen::Vector3f towards = light.towards.cast<float>();
  const Eigen::Array3f radiance = light.radiance.array().cast<float>();
  const Eigen::Matrix<float, 3, 4> camera_from_world =
      view.world_from_camera.inverse().matrix().topRows<3>().cast<float>();
  const float scale = static_cast<float>(view.camera.fx);
  const float centre = static_cast<float>(view.camera.cx);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const LightTexel& texel = texels[i];
    const float facing = texel.normal.head<3>().dot(towards);
    if (facing <= 0) continue;
    const Eigen::Vector3f seen =
        camera_from_world * (texel.position + kOffset * texel.normal);  // normal's w is 0
    const auto pixel = [&](float metres) {
      return std::clamp(static_cast<int>(scale * metres + centre + 0.5F), 0, kMapSide - 1);
    };
    const float nearest = depths.at<float>(pixel(seen.y()), pixel(seen.x()));
    if (seen.z() < nearest + 0.5F * kOffset) sum[i] += facing * radiance;
  }
}

cv::Mat coded(const std::vector<Eigen::Array3f>& light, int width, int height) {
  cv::Mat image(height, width, CV_8UC3);
  cv::Vec3b* pixel = image.ptr<cv::Vec3b>();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Eigen::Array3f code = 255 / kLightRange * light[i].sqrt();
    for (int channel = 0; channel < 3; ++channel)
      pixel[i][channel] = cv::saturate_cast<std::uint8_t>(code[2 - channel]);
  }
  return image;
}

}  // namespace

Result<cv::Mat> gather_light(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                             const GpuWorld& gpu_world) {
  auto camera = ShadowCamera::make(gl);
  if (!camera) return camera.error();
  const Ball ball = ball_around_casters(world, mesh);
  std::vector<Eigen::Array3f> sum(mesh.texels.size(), Eigen::Array3f::Zero());
  for (const FarLight& light : far_lights(world.light)) {
    const render::View view = view_from(light.towards, ball);
    add_light(light, view, camera->draw(view, world, gpu_world), mesh.texels, sum);
  }
  return coded(sum, mesh.atlas_width, mesh.atlas_height);
}

}  // namespace armsreach::sim
