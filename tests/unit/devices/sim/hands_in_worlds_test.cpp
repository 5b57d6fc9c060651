// Hands of the shipped worlds, all along their scripts: they stay out of what they do not hold, out
// of the camera, and their arms belong to somebody.
#include <algorithm>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "devices/sim/carrier.hpp"
#include "devices/sim/hand/hand_painter.hpp"
#include "devices/sim/motion.hpp"
#include "devices/sim/shape_distance.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kStep = 0.1;  // s

// What a hand may be in at a time: what it holds, is about to take or has just let go of, on which
// its fingers close.
bool in_hand(const HandDescription& hand, const std::string& thing, double time) {
  constexpr double kClosing = 0.7;  // s
  for (std::size_t i = 0; i < hand.keys.size(); ++i) {
    if (hand.keys[i].hold != thing) continue;
    const double end = i + 1 < hand.keys.size() ? hand.keys[i + 1].time : hand.keys[i].time;
    if (time > hand.keys[i].time - kClosing && time < end + kClosing) return true;
  }
  return false;
}

constexpr double kAllowedDepth = 0.004;  // m: flesh and cloth give way where they lie on something

class HandsOf {
 public:
  explicit HandsOf(const std::string& name)
      : world_(*load_world(name)),
        carrier_(carrier_of(world_, world_.sensor, 1)),
        painter_(world_.hands, {poses_of(world_.things), shoulders_of(world_, world_.sensor, 1)}) {}

  const World& world() const { return world_; }
  HandPainter& painter() { return painter_; }
  Pose world_from_camera(double time) const {
    return carrier_(time) * world_.sensor.mount_from_camera;
  }
  void set_time(double time) { painter_.set_time(time, world_from_camera(time)); }

  // How deep the skin of a hand is in a thing.
  double depth_in(const FeltSkin& skin, int thing, const Pose& world_from_thing,
                  bool arm_too) const {
    double deepest = 0;
    for (const Part& part : world_.parts) {
      if (part.thing != thing) continue;
      const Pose part_from_world = (world_from_thing * part.thing_from_part).inverse();
      for (std::size_t i = 0; i < skin.points.size(); ++i) {
        if (skin.surface.bone_of(i) == kForearmBone && !arm_too) continue;
        const Vector3d point = part_from_world * Vector3d(skin.points[i].cast<double>());
        if (point.squaredNorm() > 1) continue;  // no part reaches as far but walls and floors
        deepest = std::max(deepest, -signed_distance(part.shape, point));
      }
    }
    return deepest;
  }

 private:
  World world_;
  Carrier carrier_;
  HandPainter painter_;
};

class HandsInWorlds : public testing::TestWithParam<std::string> {};

TEST_P(HandsInWorlds, StayOutOfWhatTheyDoNotHold) {
  HandsOf hands(GetParam());
  const World& world = hands.world();
  std::map<std::string, std::string> found;
  for (double time = 0; time < world.path.duration; time += kStep) {
    hands.set_time(time);
    const std::vector<Pose> things = poses_at(world, time);
    for (std::size_t hand = 0; hand < world.hands.size(); ++hand) {
      const FeltSkin skin = hands.painter().skin(hand);
      for (std::size_t thing = 0; thing < things.size(); ++thing) {
        const std::string& name = world.things[thing].name;
        if (in_hand(world.hands[hand], name, time)) continue;
        const double deep =
            hands.depth_in(skin, static_cast<int>(thing), things[thing], name == "table top");
        if (deep < kAllowedDepth) continue;
        found[(world.hands[hand].left ? "left in " : "right in ") + name] +=
            " " + std::to_string(time).substr(0, 4) +
            "s:" + std::to_string(static_cast<int>(1000 * deep));
      }
    }
  }
  for (const auto& [what, when] : found) ADD_FAILURE() << what << " (mm)" << when;
}

TEST_P(HandsInWorlds, ComeNoNearerToTheCameraThanTenCentimetres) {
  HandsOf hands(GetParam());
  for (double time = 0; time < hands.world().path.duration; time += kStep) {
    hands.set_time(time);
    const Vector3f eye = hands.world_from_camera(time).translation().cast<float>();
    for (std::size_t hand = 0; hand < hands.world().hands.size(); ++hand) {
      float nearest = std::numeric_limits<float>::infinity();
      for (const std::span<const Vector3f> points :
           {hands.painter().skin(hand).points, hands.painter().upper_arm(hand)}) {
        for (const Vector3f& point : points) nearest = std::min(nearest, (point - eye).norm());
      }
      EXPECT_GT(nearest, 0.1F) << "hand " << hand << " at " << time << " s";
    }
  }
}

// An arm that ended within the picture would be a sausage.
TEST_P(HandsInWorlds, HaveShouldersOutsideThePicture) {
  HandsOf hands(GetParam());
  const Camera camera = camera_of(hands.world().sensor);
  for (double time = 0; time < hands.world().path.duration; time += kStep) {
    for (const HandActor& actor : hands.painter().actors()) {
      const HandMoment moment = actor.at(time, hands.world_from_camera(time));
      ASSERT_TRUE(moment.arm.has_value());
      Vector3d shoulder = moment.arm->shoulder;
      if (actor.description().left) shoulder.x() = -shoulder.x();
      const Vector3d seen =
          hands.world_from_camera(time).inverse() * (moment.world_from_hand * shoulder);
      const auto pixel = project(camera, seen);
      EXPECT_FALSE(pixel && seen.z() > 0 && camera.contains(*pixel))
          << (actor.description().left ? "left" : "right") << " at " << time << " s";
    }
  }
}

// Where a wrist is at its limit the forearm misses the elbow that the upper arm hangs from, and who
// reaches far brings the shoulder along: by a trunk's and a collar bone's share.
TEST_P(HandsInWorlds, ReachNoFartherThanPeopleDo) {
  // Whoever reaches over the haptic table stands out of its camera's wide sight, too far away.
  if (GetParam() == "haptic-table") return;
  HandsOf hands(GetParam());
  for (double time = 0; time < hands.world().path.duration; time += kStep) {
    for (const HandActor& actor : hands.painter().actors()) {
      const Arm arm = *actor.at(time, hands.world_from_camera(time)).arm;
      const double bone = upper_arm_bone(actor.anatomy());
      EXPECT_GT((arm.elbow - arm.shoulder).norm(), bone - 0.08)
          << (actor.description().left ? "left" : "right") << " at " << time << " s";
      EXPECT_LT((arm.elbow - arm.shoulder).norm(), bone + 0.22)
          << (actor.description().left ? "left" : "right") << " at " << time << " s";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, HandsInWorlds,
                         testing::Values("kitchen-table", "assembly", "packaging", "haptic-table"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace armsreach::sim
