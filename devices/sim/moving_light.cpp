#include "devices/sim/moving_light.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

constexpr int kStillSide = 1024;  // px
constexpr int kMoversSide = 512;
constexpr int kUnderSide = 128;

constexpr int kMoversUnit = 2;
constexpr int kUnderUnit = 3;
constexpr int kStillUnit = 4;

WantedPart part_that(const World& world, bool moves) {
  return [&world, moves](const Part& part) {
    return casts_shadow(part) && world.things[static_cast<std::size_t>(part.thing)].moves == moves;
  };
}

}  // namespace

void MovingLight::Map::draw(const World& world, const GpuWorld& gpu_world,
                            const std::vector<Pose>& poses, const WantedPart& wanted,
                            const Eigen::Vector3d& towards_light, const Ball& ball) {
  const render::View view = view_from(towards_light, ball, camera.side());
  camera.draw(view, world, gpu_world, poses, wanted);
  const double side = camera.side();
  // Pixels to 0..1, where pixel 0 is at its centre.
  Eigen::Matrix4d place_from_camera = Eigen::Matrix4d::Identity();
  place_from_camera(0, 0) = view.camera.fx / side;
  place_from_camera(1, 1) = view.camera.fy / side;
  place_from_camera(0, 3) = (view.camera.cx + 0.5) / side;
  place_from_camera(1, 3) = (view.camera.cy + 0.5) / side;
  map_from_world = (place_from_camera * view.world_from_camera.inverse().matrix()).cast<float>();
  texel = static_cast<float>(1 / view.camera.fx);
}

Result<MovingLight> MovingLight::make(const render::Gl& gl, const World& world,
                                      const WorldMesh& mesh, const GpuWorld& gpu_world) {
  MovingLight made;
  const std::array<std::pair<Map*, int>, 3> maps{
      {{&made.still_, kStillSide}, {&made.movers_, kMoversSide}, {&made.under_, kUnderSide}}};
  for (const auto& [map, side] : maps) {
    auto camera = ShadowCamera::make(gl, side);
    if (!camera) return camera.error();
    map->camera = std::move(*camera);
  }
  const std::vector<Pose> at_origin(world.things.size());
  std::vector<Pose> at_start;
  for (std::size_t i = 0; i < world.things.size(); ++i) {
    at_start.push_back(world.things[i].world_from_thing);
    const int index = static_cast<int>(i);
    const bool moves = world.things[i].moves;
    made.balls_.push_back(ball_around(
        world, mesh, at_origin, [&](const Part& part) { return moves && part.thing == index; }));
  }
  const WantedPart still = part_that(world, false);
  made.still_.draw(world, gpu_world, at_start, still, world.light.towards,
                   ball_around(world, mesh, at_start, still));
  return made;
}

void MovingLight::follow(const World& world, const GpuWorld& gpu_world,
                         const std::vector<Pose>& poses) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (balls_[i].radius == 0) continue;
    const Eigen::Vector3d centre = poses[i] * balls_[i].centre;
    box.extend(Eigen::Vector3d(centre.array() - balls_[i].radius));
    box.extend(Eigen::Vector3d(centre.array() + balls_[i].radius));
  }
  const Ball ball{box.center(), 0.5 * box.diagonal().norm()};
  const WantedPart moving = part_that(world, true);
  movers_.draw(world, gpu_world, poses, moving, world.light.towards, ball);
  under_.draw(world, gpu_world, poses, moving, -Eigen::Vector3d::UnitZ(), ball);
}

void MovingLight::bind() const {
  movers_.camera.texture().bind(kMoversUnit);
  under_.camera.texture().bind(kUnderUnit);
  still_.camera.texture().bind(kStillUnit);
}

void MovingLight::set(const render::Program& program, const Light& light) const {
  program.set("movers_map", kMoversUnit);
  program.set("under_map", kUnderUnit);
  program.set("still_map", kStillUnit);
  program.set("movers_from_world", movers_.map_from_world);
  program.set("movers_texel", movers_.texel);
  program.set("under_from_world", under_.map_from_world);
  program.set("still_from_world", still_.map_from_world);
  program.set("still_texel", still_.texel);
  program.set("light_spread", static_cast<float>(std::tan(light.spread)));
  program.set("towards_light", Eigen::Vector3f(light.towards.cast<float>()));
  program.set("key_light", Eigen::Vector3f(light.key.cast<float>()));
  program.set("room_above", Eigen::Vector3f(light.above.cast<float>()));
  program.set("room_below", Eigen::Vector3f(light.below.cast<float>()));
}

}  // namespace armsreach::sim
