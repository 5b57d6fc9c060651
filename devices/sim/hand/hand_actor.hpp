// One simulated hand that follows its script.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "devices/sim/hand/hand_script.hpp"
#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/hand/skeleton.hpp"
#include "vision/core/pose.hpp"

namespace armsreach::sim {

// What is true of a hand at one instant.
struct HandTruth {
  bool left = false;
  std::optional<Gesture> gesture;  // none on the way from one to another
  HandPose pose;                   // joint angles
  std::array<Pose, kHandJointCount> world_from_joint;
  std::string holds;  // the thing's name, or empty
};

class HandActor {
 public:
  explicit HandActor(const HandDescription& description);

  const HandDescription& description() const { return description_; }
  const HandAnatomy& anatomy() const { return anatomy_; }

  // Places and postures change with a smooth start and stop between two keys.
  HandPose pose(double time) const;
  // `world_from_camera`: where the camera is at that time; of a left hand, the frame of the right
  // one that it is the mirror image of.
  Pose world_from_hand(double time, const Pose& world_from_camera) const;
  HandTruth truth(double time, const Pose& world_from_camera) const;

 private:
  struct Stretch {  // between two keys
    std::size_t from = 0;
    std::size_t to = 0;
    double fraction = 0;  // eased
  };
  Stretch stretch(double time) const;
  Pose frame_from_hand(std::size_t key) const;

  HandDescription description_;
  HandAnatomy anatomy_;
  std::vector<HandPose> poses_;  // of the keys
};

}  // namespace armsreach::sim
