#include "devices/sim/hand/hand_painter.hpp"

#include "devices/sim/hand/arm.hpp"
#include "devices/sim/hand/place.hpp"

namespace armsreach::sim {

// One surface as it is now.
struct HandPainter::Cover {
  std::vector<Eigen::Vector3f> colors;
  PosedSurface in_world;
  std::vector<float> openness;
  std::vector<Eigen::Vector3f> in_camera;
  std::vector<Eigen::Vector3f> seen;

  void look(const Pose& camera_from_world, const Lighting& lighting) {
    seen = lit(colors, openness, in_world, lighting);
    const Eigen::Matrix3f turn = camera_from_world.rotation_matrix().cast<float>();
    const Eigen::Vector3f shift = camera_from_world.translation().cast<float>();
    in_camera.resize(in_world.positions.size());
    for (std::size_t i = 0; i < in_camera.size(); ++i)
      in_camera[i] = turn * in_world.positions[i] + shift;
  }
};

struct HandPainter::Body {
  HandSurface surface;
  UpperArm upper_arm;
  Cover hand;
  Cover arm;
  bool has_arm = false;  // now
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
                         const HandSurroundings& surroundings) {
  for (const HandDescription& hand : hands) {
    const HandActor& actor = actors_.emplace_back(hand, surroundings);
    HandSurfaceOptions options;
    options.sleeve = hand.sleeve;
    Body body{
        HandSurface(actor.anatomy(), options), UpperArm(actor.anatomy(), hand.sleeve), {}, {}};
    body.hand.colors = colors_of(body.surface, hand.skin, hand.sleeve_color);
    if (hand.glove) put_on_glove(body.surface, body.hand.colors);
    const Eigen::Vector3f bare = colors_of(hand.skin).back;
    body.arm.colors.assign(body.upper_arm.size(),
                           hand.sleeve ? Eigen::Vector3f(hand.sleeve_color.cast<float>()) : bare);
    body.arm.openness.assign(body.upper_arm.size(), 1.0F);
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

const HandSurface& HandPainter::surface(std::size_t hand) const { return bodies_[hand].surface; }
const PosedSurface& HandPainter::skin(std::size_t hand) const {
  return bodies_[hand].hand.in_world;
}
const PosedSurface& HandPainter::upper_arm(std::size_t hand) const {
  return bodies_[hand].arm.in_world;
}

void HandPainter::set_time(double time, const Pose& world_from_camera) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const HandActor& actor = actors_[i];
    const bool left = actor.description().left;
    Body& body = bodies_[i];
    const HandMoment moment = actor.at(time, world_from_camera);
    const HandSkeleton skeleton = skeleton_of(actor.anatomy(), moment.pose);
    body.surface.pose(skeleton, body.hand.in_world);
    body.hand.openness = openness(skeleton, actor.anatomy(), body.hand.in_world);
    place(moment.world_from_hand, left, body.hand.in_world);
    body.has_arm = moment.arm.has_value();
    if (!body.has_arm) continue;
    body.upper_arm.pose(*moment.arm, body.arm.in_world);
    place(moment.world_from_hand, left, body.arm.in_world);
  }
}

Raster::Images HandPainter::draw(Raster& raster, const Pose& world_from_camera,
                                 const Lighting& lighting) {
  raster.clear();
  const Pose camera_from_world = world_from_camera.inverse();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    const bool left = actors_[i].description().left;
    const auto id = static_cast<std::uint8_t>(i + 1);
    body.hand.look(camera_from_world, lighting);
    raster.draw({body.hand.in_camera, body.hand.seen, body.surface.rest().triangles, left, id});
    if (!body.has_arm) continue;
    body.arm.look(camera_from_world, lighting);
    raster.draw({body.arm.in_camera, body.arm.seen, body.upper_arm.triangles(), left, id});
  }
  return raster.images();
}

}  // namespace armsreach::sim
