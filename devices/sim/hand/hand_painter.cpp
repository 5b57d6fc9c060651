#include "devices/sim/hand/hand_painter.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {

// One hand's skin in meshes from fine to coarse; each is made when it is first seen.
struct HandPainter::Body {
  struct Skin {
    Skin(const HandActor& actor, double cell);
    void take_up(const HandPose& pose);  // quick where it is in that posture already

    HandSurface surface;
    std::vector<Eigen::Vector3f> colors;
    std::optional<HandPose> posture;  // of what follows
    PosedSurface posed;               // a right hand, in its frame
    std::vector<float> openness;
  };
  Skin& skin_for(const HandActor& actor, double pixels_per_metre);

  // Triangle sides in m: the finest that shows nails and wrinkles, and for hands seen from afar.
  static constexpr std::array kCells{0.0035, 0.005, 0.007};
  std::array<std::unique_ptr<Skin>, kCells.size()> skins;
  HandPose pose;  // at the time that is set
  Pose world_from_hand;
  PosedSurface in_world;
  std::vector<Eigen::Vector3f> in_camera;
  std::vector<Eigen::Vector3f> seen;
};

namespace {

void put_on_glove(const HandSurface& surface, std::vector<Eigen::Vector3f>& colors) {
  const Eigen::Vector3f knit(0.11F, 0.11F, 0.12F);  // sRGB
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (surface.rest().vertices[i].y() > kGloveHem) colors[i] = knit;
  }
}

HandSurfaceOptions surface_options(const HandDescription& hand, double cell) {
  HandSurfaceOptions options;
  options.sleeve = hand.sleeve;
  options.straight = hand.straight;
  options.cell = cell;
  return options;
}

constexpr double kClose = 0.05;  // m, nearer than any hand is looked at

}  // namespace

HandPainter::Body::Skin::Skin(const HandActor& actor, double cell)
    : surface(actor.anatomy(), surface_options(actor.description(), cell)) {
  const HandDescription& hand = actor.description();
  colors = colors_of(surface, hand.skin, hand.sleeve_color);
  if (hand.glove) put_on_glove(surface, colors);
}

void HandPainter::Body::Skin::take_up(const HandPose& pose) {
  if (posture == pose) return;
  posture = pose;
  const HandSkeleton skeleton = skeleton_of(surface.anatomy(), pose);
  surface.pose(skeleton, posed);
  openness = sim::openness(skeleton, surface.anatomy(), posed);
}

HandPainter::Body::Skin& HandPainter::Body::skin_for(const HandActor& actor,
                                                     double pixels_per_metre) {
  constexpr double kSide = 2.2;  // px that a triangle's side may have
  std::size_t level = kCells.size() - 1;
  while (level > 0 && kCells[level] * pixels_per_metre > kSide) --level;
  if (!skins[level]) skins[level] = std::make_unique<Skin>(actor, kCells[level]);
  return *skins[level];
}

HandPainter::HandPainter(const std::vector<HandDescription>& hands,
                         const ThingPoses& world_from_thing) {
  for (const HandDescription& hand : hands) actors_.emplace_back(hand, world_from_thing);
  bodies_.resize(hands.size());
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
    bodies_[i].pose = actors_[i].pose(time);
    bodies_[i].world_from_hand = actors_[i].world_from_hand(time, world_from_camera);
  }
}

Raster::Images HandPainter::draw(Raster& raster, const Pose& world_from_camera,
                                 const Lighting& lighting) {
  raster.clear();
  const Pose camera_from_world = world_from_camera.inverse();
  const Eigen::Matrix3f turn = camera_from_world.rotation_matrix().cast<float>();
  const Eigen::Vector3f shift = camera_from_world.translation().cast<float>();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const double away = (camera_from_world * body.world_from_hand.translation()).norm();
    Body::Skin& skin = body.skin_for(actors_[i], raster.camera().fx / std::max(away, kClose));
    skin.take_up(body.pose);
    const bool left = actors_[i].description().left;
    body.in_world = skin.posed;
    place(body.world_from_hand, left, body.in_world);
    body.seen = lit(skin.colors, skin.openness, body.in_world, lighting);
    body.in_camera.resize(body.in_world.positions.size());
    for (std::size_t k = 0; k < body.in_camera.size(); ++k)
      body.in_camera[k] = turn * body.in_world.positions[k] + shift;
    raster.draw({body.in_camera, body.seen, skin.surface.rest().triangles, left,
                 static_cast<std::uint8_t>(i + 1)});
  }
  return raster.images();
}

}  // namespace armsreach::sim
