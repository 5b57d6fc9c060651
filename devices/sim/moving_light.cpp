#include "devices/sim/moving_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "devices/sim/shaded_region.hpp"

namespace armsreach::sim {
namespace {

constexpr int kStillSide = 1024;  // px
constexpr int kMoversSide = 512;
constexpr int kUnderSide = 128;

constexpr int kMaskSide = 128;

constexpr double kSearched = 0.2;  // m, as in sim_shadow.glsl
constexpr double kCovers = 0.05;   // m, kReach in sim_light_beside.glsl

constexpr int kMoversMaskUnit = 5;
constexpr int kUnderMaskUnit = 6;
constexpr int kMoversUnit = 2;
constexpr int kUnderUnit = 3;
constexpr int kStillUnit = 4;

bool same(const Pose& a, const Pose& b) {
  return a.translation() == b.translation() && a.rotation().coeffs() == b.rotation().coeffs();
}

// From a box along the light's way down to the floor, and as far aside as penumbra and dimness
// reach.
Eigen::AlignedBox3d box_of_shadow(const Eigen::AlignedBox3d& box, const Light& light) {
  constexpr double kLongest = 4.0;  // m
  const double down = std::max(0.0, box.max().z()) / std::max(1e-3, light.towards.z());
  const double length = std::min(kLongest, down);
  Eigen::AlignedBox3d swept = box;
  for (const Eigen::Vector3d& corner : corners_of(box))
    swept.extend(Eigen::Vector3d(corner - length * light.towards));
  const double reach = kCovers + std::tan(light.spread) * length;
  swept.min().array() -= reach;
  swept.max().array() += reach;
  return swept;
}

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
  constexpr render::TextureFormat kMask{GL_R8, GL_RED, GL_UNSIGNED_BYTE};
  for (Map* map : {&made.movers_, &made.under_})
    map->mask = render::Texture(gl, kMaskSide, kMaskSide, kMask, GL_NEAREST);
  made.boxes_.resize(world.things.size());
  std::vector<Pose> at_start;
  for (const Thing& thing : world.things) at_start.push_back(thing.world_from_thing);
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const std::size_t thing = static_cast<std::size_t>(world.parts[i].thing);
    if (!world.things[thing].moves) continue;
    const MeshRange& range = mesh.parts[i];
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k)
      made.boxes_[thing].extend(mesh.vertices[mesh.indices[k]].position.cast<double>());
  }
  const WantedPart still = part_that(world, false);
  made.still_.draw(world, gpu_world, at_start, still, world.light.towards,
                   ball_around(world, mesh, at_start, still));
  return made;
}

void MovingLight::follow(const World& world, const GpuWorld& gpu_world,
                         const std::vector<Pose>& poses) {
  if (std::equal(poses.begin(), poses.end(), poses_.begin(), poses_.end(), same)) return;
  poses_ = poses;
  shaded_.clear();
  Eigen::AlignedBox3d all;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (boxes_[i].isEmpty()) continue;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : corners_of(boxes_[i])) box.extend(poses[i] * corner);
    shaded_.push_back(box_of_shadow(box, world.light));
    all.extend(box);
  }
  const Ball around_all{all.center(), 0.5 * all.diagonal().norm()};
  const WantedPart moving = part_that(world, true);
  movers_.draw(world, gpu_world, poses, moving, world.light.towards, around_all);
  under_.draw(world, gpu_world, poses, moving, -Eigen::Vector3d::UnitZ(), around_all);
  mark(movers_, kSearched * std::tan(world.light.spread) + 4 * static_cast<double>(movers_.texel));
  mark(under_, kCovers);
}

void MovingLight::mark(Map& map, double margin) const {
  cv::Mat mask = cv::Mat::zeros(kMaskSide, kMaskSide, CV_8U);
  const double pixels_per_metre = kMaskSide / (map.camera.side() * static_cast<double>(map.texel));
  const int outline = 2 * static_cast<int>(std::ceil(margin * pixels_per_metre)) + 2;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (boxes_[i].isEmpty()) continue;
    std::vector<cv::Point> corners;
    for (const Eigen::Vector3d& corner : corners_of(boxes_[i])) {
      const Eigen::Vector3f in_world = (poses_[i] * corner).cast<float>();
      const Eigen::Vector4f place = map.map_from_world * in_world.homogeneous();
      corners.emplace_back(static_cast<int>(place.x() * kMaskSide),
                           static_cast<int>(place.y() * kMaskSide));
    }
    std::vector<cv::Point> hull;
    cv::convexHull(corners, hull);
    cv::fillConvexPoly(mask, hull, cv::Scalar(255));
    cv::polylines(mask, hull, true, cv::Scalar(255), outline);
  }
  map.mask.upload(mask.data);
}

bool MovingLight::reaches(const Eigen::AlignedBox3d& box) const {
  return std::any_of(shaded_.begin(), shaded_.end(),
                     [&](const Eigen::AlignedBox3d& shaded) { return shaded.intersects(box); });
}

std::vector<cv::Rect> MovingLight::seen_in(const Camera& camera, const Pose& world_from_camera,
                                           const std::vector<Eigen::AlignedBox3d>& beside,
                                           const Light& light) const {
  const double margin = std::max(
      kCovers, kSearched * std::tan(light.spread) + 4 * static_cast<double>(movers_.texel));
  std::vector<Corners> shading;
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (boxes_[i].isEmpty()) continue;
    Eigen::AlignedBox3d grown = boxes_[i];
    grown.min().array() -= margin;
    grown.max().array() += margin;
    Corners& corners = shading.emplace_back(corners_of(grown));
    for (Eigen::Vector3d& corner : corners) corner = poses_[i] * corner;
  }
  return shaded_rectangles(camera, world_from_camera, shading, beside, light.towards);
}

void MovingLight::bind() const {
  movers_.camera.texture().bind(kMoversUnit);
  under_.camera.texture().bind(kUnderUnit);
  still_.camera.texture().bind(kStillUnit);
  movers_.mask.bind(kMoversMaskUnit);
  under_.mask.bind(kUnderMaskUnit);
}

void MovingLight::set(const render::Program& program, const Light& light) const {
  program.set("movers_map", kMoversUnit);
  program.set("under_map", kUnderUnit);
  program.set("still_map", kStillUnit);
  program.set("movers_mask", kMoversMaskUnit);
  program.set("under_mask", kUnderMaskUnit);
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
