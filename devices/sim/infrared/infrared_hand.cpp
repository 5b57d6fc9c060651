#include "devices/sim/infrared/infrared_hand.hpp"

namespace armsreach::sim {
namespace {

HandSurfaceOptions options_for(const HandDescription& hand) {
  HandSurfaceOptions options;
  options.sleeve = hand.sleeve;
  options.forearm = 0.3;
  return options;
}

}  // namespace

InfraredHand::InfraredHand(const HandDescription& hand, const InfraredDescription& infrared,
                           const ThingPoses& world_from_thing)
    : actor_(hand, {world_from_thing, {}}),
      surface_(actor_.anatomy(), options_for(hand)),
      bracelet_(infrared.bracelet),
      glove_(infrared.glove) {
  for (const auto& triangle : surface_.rest().triangles) {
    const std::uint32_t corner = triangle[0];
    const bool gloved = glove_ && surface_.rest().vertices[corner].y() > kGloveHem;
    const Cover cover = surface_.is_sleeve(corner) ? Cover::sleeve
                        : gloved                   ? Cover::glove
                                                   : Cover::skin;
    triangles_[static_cast<std::size_t>(cover)].push_back(triangle);
  }
}

InfraredHand::Moment InfraredHand::at(double time) const {
  Moment moment;
  const HandMoment hand = actor_.at(time, Pose());
  moment.world_from_hand = hand.world_from_hand;
  moment.truth = actor_.truth(time, Pose());
  moment.skeleton = skeleton_of(actor_.anatomy(), hand.pose);
  surface_.pose(moment.skeleton, moment.surface);
  if (bracelet_) wear(*bracelet_, moment.skeleton, moment.worn);
  if (glove_) wear(*glove_, surface_, moment.skeleton, moment.worn);
  return moment;
}

}  // namespace armsreach::sim
