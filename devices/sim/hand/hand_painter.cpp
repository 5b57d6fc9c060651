#include "devices/sim/hand/hand_painter.hpp"

#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {

struct HandPainter::Body {
  HandSurface surface;
  std::vector<Eigen::Vector3f> colors;
  PosedSurface in_world;
  std::vector<float> openness;
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

}  // namespace

HandPainter::HandPainter(const std::vector<HandDescription>& hands,
                         const ThingPoses& world_from_thing) {
  for (const HandDescription& hand : hands) {
    const HandActor& actor = actors_.emplace_back(hand, world_from_thing);
    HandSurfaceOptions options;
    options.sleeve = hand.sleeve;
    options.straight = hand.straight;
    Body body{HandSurface(actor.anatomy(), options), {}, {}, {}, {}, {}};
    body.colors = colors_of(body.surface, hand.skin, hand.sleeve_color);
    if (hand.glove) put_on_glove(body.surface, body.colors);
    bodies_.push_back(std::move(body));
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
    const HandActor& actor = actors_[i];
    Body& body = bodies_[i];
    const HandSkeleton skeleton = skeleton_of(actor.anatomy(), actor.pose(time));
    body.surface.pose(skeleton, body.in_world);
    body.openness = openness(skeleton, actor.anatomy(), body.in_world);
    place(actor.world_from_hand(time, world_from_camera), actor.description().left, body.in_world);
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
    body.seen = lit(body.colors, body.openness, body.in_world, lighting);
    body.in_camera.resize(body.in_world.positions.size());
    for (std::size_t k = 0; k < body.in_camera.size(); ++k)
      body.in_camera[k] = turn * body.in_world.positions[k] + shift;
    raster.draw({body.in_camera, body.seen, body.surface.rest().triangles,
                 actors_[i].description().left, static_cast<std::uint8_t>(i + 1)});
  }
  return raster.images();
}

}  // namespace armsreach::sim
