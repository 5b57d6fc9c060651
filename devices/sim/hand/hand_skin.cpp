#include "devices/sim/hand/hand_skin.hpp"

#include "devices/sim/hand/skin_look.hpp"

namespace armsreach::sim {
namespace {

HandSurfaceOptions surface_options(const HandDescription& hand, double cell) {
  HandSurfaceOptions options;
  options.sleeve = hand.sleeve;
  options.cell = cell;
  return options;
}

void put_on_glove(const HandSurface& surface, std::vector<Eigen::Vector3f>& colors) {
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (!surface.is_sleeve(i) && surface.rest().vertices[i].y() > kGloveHem)
      colors[i] = {0.07F, 0.07F, 0.08F};
  }
}

}  // namespace

HandSkin::HandSkin(const HandDescription& hand, const HandAnatomy& anatomy, double cell)
    : surface_(anatomy, surface_options(hand, cell)),
      colors_(colors_of(surface_, hand.skin, hand.sleeve_color)) {
  if (hand.glove) put_on_glove(surface_, colors_);
}

void HandSkin::take_up(const HandPose& posture) {
  if (posture_ == posture) return;
  posture_ = posture;
  surface_.pose(skeleton_of(surface_.anatomy(), posture), posed_);
  openness_.clear();
}

const std::vector<float>& HandSkin::openness() {
  if (openness_.empty()) {
    const HandSkeleton skeleton = skeleton_of(surface_.anatomy(), *posture_);
    openness_ = sim::openness(skeleton, surface_.anatomy(), posed_);
  }
  return openness_;
}

}  // namespace armsreach::sim
