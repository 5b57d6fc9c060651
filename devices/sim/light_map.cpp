#include "devices/sim/light_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "devices/sim/shadow_camera.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

constexpr int kKeyDirections = 24;
constexpr int kRoomDirections = 72;
constexpr int kMapSide = 512;       // px, of the depths seen from a light
constexpr int kSmallMapSide = 128;  // px, the same around a single thing
constexpr float kOffset = 0.005F;   // m, off the surface, so that it does not shade itself
constexpr double kGoldenAngle = 2.39996322972865332;

struct FarLight {
  Vector3d towards;  // unit
  Color radiance;    // on a surface that faces it
  bool key = false;  // of the key light, not of the room
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
    lights.push_back({turn * local, light.key / kKeyDirections, true});
  }
  for (int i = 0; i < kRoomDirections; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kRoomDirections;
    const double radius = std::sqrt(1 - z * z);
    const double turned = i * kGoldenAngle;
    const Color radiance = light.below + (0.5 + 0.5 * z) * (light.above - light.below);
    // Irradiance is the integral of radiance times cosine; a radiance of 1 all around makes pi,
    // which counts as a light of 1.
    lights.push_back({{radius * std::cos(turned), radius * std::sin(turned), z},
                      radiance * 4 / kRoomDirections,
                      false});
  }
  return lights;
}

// What has arrived at a texel, red first; the key light also by itself.
struct Gathered {
  Eigen::Array3f all = Eigen::Array3f::Zero();
  float key = 0;  // mean of the colours
};

// Adds one light to all texels of the wanted things that see it.
template <class Wanted>
void add_light(const FarLight& light, const render::View& view, const cv::Mat& depths,
               const WorldMesh& mesh, const Wanted& wanted_thing, std::vector<Gathered>& sum) {
  const Eigen::Vector3f towards = light.towards.cast<float>();
  const Eigen::Array3f radiance = light.radiance.array().cast<float>();
  const Eigen::Matrix<float, 3, 4> camera_from_world =
      view.world_from_camera.inverse().matrix().topRows<3>().cast<float>();
  const float scale = static_cast<float>(view.camera.fx);
  const float centre = static_cast<float>(view.camera.cx);
  for (std::size_t i = 0; i < mesh.texels.size(); ++i) {
    if (!wanted_thing(mesh.texel_things[i])) continue;
    const LightTexel& texel = mesh.texels[i];
    const float facing = texel.normal.head<3>().dot(towards);
    if (facing <= 0) continue;
    const Eigen::Vector3f seen =
        camera_from_world * (texel.position + kOffset * texel.normal);  // normal's w is 0
    const auto pixel = [&](float metres) {
      return std::clamp(static_cast<int>(scale * metres + centre + 0.5F), 0, depths.cols - 1);
    };
    const float nearest = depths.at<float>(pixel(seen.y()), pixel(seen.x()));
    if (seen.z() >= nearest + 0.5F * kOffset) continue;
    sum[i].all += facing * radiance;
    if (light.key) sum[i].key += facing * radiance.mean();
  }
}

// Square roots of light, and in alpha the key light's share of it.
cv::Mat coded(const std::vector<Gathered>& light, int width, int height) {
  cv::Mat image(height, width, CV_8UC4);
  cv::Vec4b* pixel = image.ptr<cv::Vec4b>();
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Eigen::Array3f code = 255 / kLightRange * light[i].all.sqrt();
    for (int channel = 0; channel < 3; ++channel)
      pixel[i][channel] = cv::saturate_cast<std::uint8_t>(code[2 - channel]);
    const float all = light[i].all.mean();
    pixel[i][3] = cv::saturate_cast<std::uint8_t>(all > 0 ? 255 * light[i].key / all : 0);
  }
  return image;
}

std::vector<Pose> poses_at_start(const World& world) {
  std::vector<Pose> poses;
  for (const Thing& thing : world.things) poses.push_back(thing.world_from_thing);
  return poses;
}

const Thing& thing_of(const World& world, const Part& part) {
  return world.things[static_cast<std::size_t>(part.thing)];
}

Status gather_on_still_things(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                              const GpuWorld& gpu_world, std::vector<Gathered>& sum) {
  auto camera = ShadowCamera::make(gl, kMapSide);
  if (!camera) return camera.error();
  const std::vector<Pose> poses = poses_at_start(world);
  const auto still_caster = [&](const Part& part) {
    return casts_shadow(part) && !thing_of(world, part).moves;
  };
  const auto still = [&](int thing) {
    return thing >= 0 && !world.things[static_cast<std::size_t>(thing)].moves;
  };
  const Ball ball = ball_around(world, mesh, poses, still_caster);
  for (const FarLight& light : far_lights(world.light)) {
    const render::View view = view_from(light.towards, ball, kMapSide);
    camera->draw(view, world, gpu_world, poses, still_caster);
    add_light(light, view, camera->read(), mesh, still, sum);
  }
  return ok();
}

// How much of a white room each place on a moving thing sees past the thing itself.
Status gather_on_moving_things(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                               const GpuWorld& gpu_world, std::vector<Gathered>& sum) {
  auto camera = ShadowCamera::make(gl, kSmallMapSide);
  if (!camera) return camera.error();
  Light white;
  white.key = Color::Zero();
  white.above = white.below = Color::Ones();
  const std::vector<Pose> at_origin(world.things.size());
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    if (!world.things[i].moves) continue;
    const int index = static_cast<int>(i);
    const auto own_part = [index](const Part& part) { return part.thing == index; };
    const Ball ball = ball_around(world, mesh, at_origin, own_part);
    for (const FarLight& light : far_lights(white)) {
      if (light.key) continue;
      const render::View view = view_from(light.towards, ball, kSmallMapSide);
      camera->draw(view, world, gpu_world, at_origin, own_part);
      add_light(
          light, view, camera->read(), mesh, [index](int thing) { return thing == index; }, sum);
    }
  }
  return ok();
}

}  // namespace

Result<cv::Mat> gather_light(const render::Gl& gl, const World& world, const WorldMesh& mesh,
                             const GpuWorld& gpu_world) {
  std::vector<Gathered> sum(mesh.texels.size());
  if (auto done = gather_on_still_things(gl, world, mesh, gpu_world, sum); !done)
    return done.error();
  if (auto done = gather_on_moving_things(gl, world, mesh, gpu_world, sum); !done)
    return done.error();
  return coded(sum, mesh.atlas_width, mesh.atlas_height);
}

}  // namespace armsreach::sim
