// One simulated hand that follows its script.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "devices/sim/hand/arm.hpp"
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

// Of a thing by its name, at a time.
using ThingPoses = std::function<Pose(const std::string&, double)>;
// In the world, of whoever has the hands, at a time.
using Shoulders = std::function<Eigen::Vector3d(bool left, double time)>;

// What hands hang on and act on. Without shoulders they have those of their scripts, if any.
struct HandSurroundings {
  ThingPoses world_from_thing;
  Shoulders shoulders;
};

// How a hand and its arm are at one instant. Of a left hand, the right one's whose mirror image it
// is.
struct HandMoment {
  Pose world_from_hand;
  HandPose pose;
  std::optional<Arm> arm;  // none: it ends behind the elbow
};

class HandActor {
 public:
  // Surroundings have `world_from_thing` where the script has keys on things.
  explicit HandActor(const HandDescription& description, HandSurroundings surroundings = {});

  const HandDescription& description() const { return description_; }
  const HandAnatomy& anatomy() const { return anatomy_; }

  // Places and postures change with a smooth start and stop between two keys. This is the script's
  // posture, whatever the arm does to the wrist.
  HandPose pose(double time) const;
  // `world_from_camera`: where the camera is at that time; of a left hand, the frame of the right
  // one that it is the mirror image of.
  Pose world_from_hand(double time, const Pose& world_from_camera) const;
  HandMoment at(double time, const Pose& world_from_camera) const;
  HandTruth truth(double time, const Pose& world_from_camera) const;

 private:
  struct Stretch {  // between two keys
    std::size_t from = 0;
    std::size_t to = 0;
    double fraction = 0;  // eased
  };
  Stretch stretch(double time) const;
  Eigen::Vector3d palm() const;  // its middle, in the hand's frame
  Pose frame_from_hand(const HandKey& key) const;
  Pose thing_from_hand(const HandKey& key) const;
  // Where a key puts the hand, at any time.
  Pose world_from_key(const HandKey& key, double time, const Pose& world_from_camera) const;

  std::optional<Eigen::Vector3d> world_shoulder(double time, const Pose& world_from_camera) const;

  HandDescription description_;
  HandSurroundings surroundings_;
  HandAnatomy anatomy_;
  std::vector<HandPose> poses_;  // of the keys
};

}  // namespace armsreach::sim
