#include "devices/sim/hand_contacts.hpp"

#include <algorithm>
#include <array>

#include "devices/sim/contacts.hpp"
#include "devices/sim/patches.hpp"
#include "devices/sim/shape_distance.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

HandPart part_of(Bone bone) {
  if (bone == kForearmBone) return HandPart::arm;
  for (const Finger finger :
       {Finger::thumb, Finger::index, Finger::middle, Finger::ring, Finger::little}) {
    const Bone first = static_cast<Bone>(joint_of(finger, 1));
    const Bone tip = static_cast<Bone>(tip_of(finger));
    if (bone >= first && bone <= tip) return static_cast<HandPart>(finger);
  }
  return HandPart::palm;
}

// The thing's box seen from the world, as a box there.
bool box_reached(const Eigen::AlignedBox3d& in_thing, const Pose& world_from_thing,
                 const Eigen::AlignedBox3d& in_world) {
  Eigen::AlignedBox3d around;
  for (int corner = 0; corner < 8; ++corner) {
    const auto type = static_cast<Eigen::AlignedBox3d::CornerType>(corner);
    around.extend(world_from_thing * Vector3d(in_thing.corner(type)));
  }
  return around.intersects(in_world);
}

}  // namespace

std::string_view name(HandPart part) {
  constexpr std::array<std::string_view, kHandPartCount> kNames{"thumb",  "index", "middle", "ring",
                                                                "little", "palm",  "arm"};
  return kNames[static_cast<std::size_t>(part)];
}

HandContactFinder::HandContactFinder(const World& world)
    : world_(world), bodies_(world.things.size()) {
  for (std::size_t i = 0; i < world.parts.size(); ++i) {
    const Part& part = world.parts[i];
    Body& body = bodies_[static_cast<std::size_t>(part.thing)];
    body.parts.push_back(static_cast<int>(i));
    for (const Patch& patch : patches_of(part.shape)) {
      const int steps = patch.triangle ? 1 : 16;
      for (int row = 0; row <= steps; ++row) {
        for (int column = 0; column <= steps; ++column) {
          const double u = static_cast<double>(column) / steps;
          const double v = static_cast<double>(row) / steps;
          body.box.extend(part.thing_from_part * patch.at(u, v).position);
        }
      }
    }
  }
  for (Body& body : bodies_) {
    body.box.min().array() -= kTouching;
    body.box.max().array() += kTouching;
  }
}

bool HandContactFinder::touches(const Body& body, const Vector3d& point_in_thing) const {
  return std::any_of(body.parts.begin(), body.parts.end(), [&](int i) {
    const Part& part = world_.parts[static_cast<std::size_t>(i)];
    const Vector3d point = part.thing_from_part.inverse() * point_in_thing;
    return signed_distance(part.shape, point) <= kTouching;
  });
}

std::vector<std::pair<int, HandPart>> HandContactFinder::at(
    const HandSurface& surface, std::span<const Vector3f> skin,
    const std::vector<Pose>& world_from_thing) const {
  Eigen::AlignedBox3d hand;
  for (const Vector3f& point : skin) hand.extend(point.cast<double>());
  std::vector<std::pair<int, HandPart>> touching;
  for (std::size_t thing = 0; thing < bodies_.size(); ++thing) {
    const Body& body = bodies_[thing];
    if (!box_reached(body.box, world_from_thing[thing], hand)) continue;
    const Pose thing_from_world = world_from_thing[thing].inverse();
    std::array<bool, kHandPartCount> found{};
    for (std::size_t i = 0; i < skin.size(); ++i) {
      bool& known = found[static_cast<std::size_t>(part_of(surface.bone_of(i)))];
      if (known) continue;
      const Vector3d point = thing_from_world * Vector3d(skin[i].cast<double>());
      known = body.box.contains(point) && touches(body, point);
    }
    for (int part = 0; part < kHandPartCount; ++part) {
      if (found[static_cast<std::size_t>(part)])
        touching.emplace_back(static_cast<int>(thing), static_cast<HandPart>(part));
    }
  }
  return touching;
}

}  // namespace armsreach::sim
