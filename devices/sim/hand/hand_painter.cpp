#include "devices/sim/hand/hand_painter.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "devices/sim/hand/arm.hpp"
#include "devices/sim/hand/hand_skin.hpp"
#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {
namespace {

// Triangle sides in m: the finest that shows nails and wrinkles, and for hands seen from afar.
constexpr std::array kCells{0.0035, 0.005, 0.007};
constexpr double kClose = 0.05;  // m, nearer than any hand is looked at

// One surface as it is and as a camera sees it.
struct Cover {
  PosedSurface in_world;
  std::vector<Eigen::Vector3f> in_camera;
  std::vector<Eigen::Vector3f> seen;

  void look(const std::vector<Eigen::Vector3f>& colors, const std::vector<float>& openness,
            const Pose& camera_from_world, const Lighting& lighting) {
    seen = lit(colors, openness, in_world, lighting);
    const Eigen::Matrix3f turn = camera_from_world.rotation_matrix().cast<float>();
    const Eigen::Vector3f shift = camera_from_world.translation().cast<float>();
    in_camera.resize(in_world.positions.size());
    for (std::size_t i = 0; i < in_camera.size(); ++i)
      in_camera[i] = turn * in_world.positions[i] + shift;
  }
};

}  // namespace

struct HandPainter::Body {
  Body(const HandActor& actor, HandMoment now)
      : moment(std::move(now)), upper_arm(actor.anatomy(), actor.description().sleeve) {
    const HandDescription& script = actor.description();
    const Eigen::Vector3f bare = colors_of(script.skin).back;
    arm_colors.assign(upper_arm.size(),
                      script.sleeve ? Eigen::Vector3f(script.sleeve_color.cast<float>()) : bare);
    arm_openness.assign(upper_arm.size(), 1.0F);
  }

  // In the posture of now; each is made when it is first asked for.
  HandSkin& skin(const HandActor& actor, std::size_t level) {
    std::unique_ptr<HandSkin>& skin = skins[level];
    if (!skin)
      skin = std::make_unique<HandSkin>(actor.description(), actor.anatomy(), kCells[level]);
    skin->take_up(moment.pose);
    return *skin;
  }

  HandMoment moment;  // now
  std::array<std::unique_ptr<HandSkin>, kCells.size()> skins;
  UpperArm upper_arm;
  std::vector<Eigen::Vector3f> arm_colors;
  std::vector<float> arm_openness;
  PosedSurface felt;
  Cover hand;
  Cover arm;
};

namespace {

std::size_t level_for(double pixels_per_metre) {
  constexpr double kSide = 2.8;  // px that a triangle's side may have
  std::size_t level = kCells.size() - 1;
  while (level > 0 && kCells[level] * pixels_per_metre > kSide) --level;
  return level;
}

}  // namespace

HandPainter::HandPainter(const std::vector<HandDescription>& hands,
                         const HandSurroundings& surroundings) {
  for (const HandDescription& hand : hands) {
    const HandActor& actor = actors_.emplace_back(hand, surroundings);
    bodies_.emplace_back(actor, actor.at(0, Pose()));
  }
}
HandPainter::~HandPainter() = default;
HandPainter::HandPainter(HandPainter&&) noexcept = default;
HandPainter& HandPainter::operator=(HandPainter&&) noexcept = default;

std::vector<HandTruth> HandPainter::truth(double time, const Pose& world_from_camera) const {
  std::vector<HandTruth> all;
  for (const HandActor& actor : actors_) all.push_back(actor.truth(time, world_from_camera));
  return all;
}

void HandPainter::set_time(double time, const Pose& world_from_camera) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    Body& body = bodies_[i];
    body.moment = actors_[i].at(time, world_from_camera);
    body.arm.in_world = {};
    if (!body.moment.arm) continue;
    body.upper_arm.pose(*body.moment.arm, body.arm.in_world);
    place(body.moment.world_from_hand, actors_[i].description().left, body.arm.in_world);
  }
}

FeltSkin HandPainter::skin(std::size_t hand) {
  Body& body = bodies_[hand];
  const HandSkin& skin = body.skin(actors_[hand], kCells.size() - 1);
  body.felt = skin.posed();
  place(body.moment.world_from_hand, actors_[hand].description().left, body.felt);
  return {skin.surface(), body.felt.positions};
}

std::span<const Eigen::Vector3f> HandPainter::upper_arm(std::size_t hand) const {
  return bodies_[hand].arm.in_world.positions;
}

Raster::Images HandPainter::draw(Raster& raster, const Pose& world_from_camera,
                                 const Lighting& lighting) {
  raster.clear();
  const Pose camera_from_world = world_from_camera.inverse();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const bool left = actors_[i].description().left;
    const auto id = static_cast<std::uint8_t>(i + 1);
    const Pose& world_from_hand = body.moment.world_from_hand;
    const double away = (camera_from_world * world_from_hand.translation()).norm();
    HandSkin& skin = body.skin(actors_[i], level_for(raster.camera().fx / std::max(away, kClose)));
    body.hand.in_world = skin.posed();
    place(world_from_hand, left, body.hand.in_world);
    body.hand.look(skin.colors(), skin.openness(), camera_from_world, lighting);
    raster.draw({body.hand.in_camera, body.hand.seen, skin.surface().rest().triangles, left, id});
    if (!body.moment.arm) continue;
    body.arm.look(body.arm_colors, body.arm_openness, camera_from_world, lighting);
    raster.draw({body.arm.in_camera, body.arm.seen, body.upper_arm.triangles(), left, id});
  }
  return raster.images();
}

}  // namespace armsreach::sim
