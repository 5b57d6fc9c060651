// One hand's skin on one mesh: its colours, and its shape in the posture that it is in.
#pragma once

#include <optional>
#include <vector>

#include "devices/sim/hand/hand_pose.hpp"
#include "devices/sim/hand/hand_script.hpp"
#include "devices/sim/hand/hand_surface.hpp"

namespace armsreach::sim {

class HandSkin {
 public:
  // `cell`: about the length of a triangle's side, m.
  HandSkin(const HandDescription& hand, const HandAnatomy& anatomy, double cell);

  // Quick where it is in that posture already.
  void take_up(const HandPose& posture);

  const HandSurface& surface() const { return surface_; }
  const std::vector<Eigen::Vector3f>& colors() const { return colors_; }
  const PosedSurface& posed() const { return posed_; }  // a right hand, in its frame
  const std::vector<float>& openness();                 // of posed(), see skin_look.hpp

 private:
  HandSurface surface_;
  std::vector<Eigen::Vector3f> colors_;
  std::optional<HandPose> posture_;
  PosedSurface posed_;
  std::vector<float> openness_;  // empty: not yet known
};

}  // namespace armsreach::sim
