// What the skin of a hand touches.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "devices/sim/hand/hand_surface.hpp"
#include "devices/sim/world.hpp"

namespace armsreach::sim {

// The palm is what hangs on the metacarpals and the wrist; the arm is what hangs on the forearm.
enum class HandPart { thumb, index, middle, ring, little, palm, arm };
inline constexpr int kHandPartCount = 7;
std::string_view name(HandPart part);

class HandContactFinder {
 public:
  explicit HandContactFinder(const World& world);

  // Things (by index, rising) and the parts of the hand of which a point of the skin is within
  // kTouching (contacts.hpp) of the thing or inside of it. `skin` is the surface as it is placed.
  std::vector<std::pair<int, HandPart>> at(const HandSurface& surface,
                                           std::span<const Eigen::Vector3f> skin,
                                           const std::vector<Pose>& world_from_thing) const;

 private:
  struct Body {
    std::vector<int> parts;
    Eigen::AlignedBox3d box;  // in the thing's frame, as large as what counts as a touch
  };
  bool touches(const Body& body, const Eigen::Vector3d& point_in_thing) const;

  World world_;
  std::vector<Body> bodies_;
};

}  // namespace armsreach::sim
