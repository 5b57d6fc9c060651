#include "devices/sim/hand/gesture.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "devices/sim/hand/contact.hpp"
#include "devices/sim/random.hpp"

namespace armsreach::sim {
namespace {

constexpr std::array<std::string_view, kGestureCount> kNames{
    "point", "L", "open", "fist", "grasp", "pinch", "0", "1",
    "2",     "3", "4",    "5",    "6",     "7",     "8", "9"};

constexpr double kDegree = std::numbers::pi / 180;

// Degrees.
struct Curl {
  double mcp;
  double pip;
  double dip;
};
struct Thumb {
  double radial;
  double palmar;
  double twist;
  double mcp;
  double ip;
};

constexpr Curl kStraight{2, 4, 2};
constexpr Curl kFolded{84, 105, 64};
constexpr Thumb kOut{52, 16, 22, 2, -4};           // away from the palm, as in 3 and 5
constexpr Thumb kAcrossPalm{28, 42, 5, 42, 45};    // towards the little finger's root, as in 4
constexpr Thumb kOverFingers{30, 42, 10, 42, 40};  // over folded fingers

class Posture {
 public:
  Posture& spread(double index, double middle, double ring, double little) {
    const std::array degrees{index, middle, ring, little};
    for (const Finger finger : kFingers) {
      pose_[angle_index(finger, FingerAngle::spread)] =
          degrees[static_cast<std::size_t>(finger) - 1] * kDegree;
    }
    return *this;
  }
  Posture& curl(Finger finger, const Curl& curl) {
    pose_[angle_index(finger, FingerAngle::mcp)] = curl.mcp * kDegree;
    pose_[angle_index(finger, FingerAngle::pip)] = curl.pip * kDegree;
    pose_[angle_index(finger, FingerAngle::dip)] = curl.dip * kDegree;
    return *this;
  }
  Posture& curl_all(const Curl& one) {
    for (const Finger finger : kFingers) curl(finger, one);
    return *this;
  }
  Posture& thumb(const Thumb& thumb) {
    pose_[thumb_radial] = thumb.radial * kDegree;
    pose_[thumb_palmar] = thumb.palmar * kDegree;
    pose_[thumb_twist] = thumb.twist * kDegree;
    pose_[thumb_mcp] = thumb.mcp * kDegree;
    pose_[thumb_ip] = thumb.ip * kDegree;
    return *this;
  }
  Posture& cupped(double degrees) {
    pose_[cup] = degrees * kDegree;
    return *this;
  }
  const HandPose& pose() const { return pose_; }

 private:
  HandPose pose_ = HandPose::Zero();
};

// Pad against pad.
Contact pads(Finger finger, double thumb_along, double finger_along) {
  return {{Finger::thumb, 2, thumb_along, {0, 0.15, 1}}, {finger, 3, finger_along, {0, 0.15, 1}}};
}
// The thumb's pad on the back of a folded finger's middle bone.
Contact on_back(Finger finger, double along) {
  return {{Finger::thumb, 2, 0.6, {0, 0, 1}}, {finger, 2, along, {0, 0, -1}}};
}

// What a gesture looks like, and what touches in it.
struct Recipe {
  Posture posture;
  std::vector<Contact> contacts = {};
};

// The thumb and one finger make a ring, the others are up.
Recipe ring_with(Finger finger) {
  Recipe recipe;
  const double reach = finger == Finger::index ? 0 : finger == Finger::middle ? 4 : 8;
  recipe.posture.spread(12, 0, -10, -26).curl_all(kStraight).thumb(kAcrossPalm);
  if (finger == Finger::little) recipe.posture.spread(16, 2, -10, -18);
  recipe.posture.curl(finger, {52 + reach, 62, 30}).cupped(finger == Finger::little ? 16 : 6);
  recipe.contacts = {pads(finger, 0.62, 0.6)};
  return recipe;
}

Recipe folded_but(const std::vector<Finger>& up) {
  Recipe recipe;
  recipe.posture.spread(5, 1, -4, -10).curl_all(kFolded).thumb(kOverFingers).cupped(4);
  for (const Finger finger : up) recipe.posture.curl(finger, kStraight);
  return recipe;
}

Recipe round_zero() {
  Recipe recipe;
  recipe.posture.spread(2, 0, 0, 2).thumb({38, 48, 0, 20, 25}).cupped(2);
  recipe.posture.curl(Finger::index, {50, 55, 30}).curl(Finger::middle, {52, 58, 32});
  recipe.posture.curl(Finger::ring, {50, 58, 32}).curl(Finger::little, {44, 50, 28});
  recipe.contacts = {pads(Finger::middle, 0.75, 0.8)};
  return recipe;
}

Recipe recipe_of(Gesture gesture) {
  using enum Finger;
  Recipe recipe;
  Posture& posture = recipe.posture;
  switch (gesture) {
    case Gesture::point:
    case Gesture::one:
      recipe = folded_but({index});
      recipe.contacts = {on_back(middle, 0.55)};
      break;
    case Gesture::two:
      recipe = folded_but({index, middle});
      posture.spread(14, -8, -6, -12);
      recipe.contacts = {on_back(ring, 0.4)};
      break;
    case Gesture::L:
      recipe = folded_but({index});
      posture.thumb({62, 8, 20, -2, -6});
      break;
    case Gesture::three:
      posture.spread(11, -7, -8, -12).curl_all({78, 92, 45}).thumb(kOut).cupped(5);
      posture.curl(index, kStraight).curl(middle, kStraight);
      break;
    case Gesture::four:
      posture.spread(9, 0, -9, -22).curl_all(kStraight).thumb({13, 42, 5, 44, 45});
      break;
    case Gesture::open:
    case Gesture::five:
      posture.spread(9, 0, -9, -24).curl_all(kStraight).thumb(kOut);
      break;
    case Gesture::fist:
      recipe = folded_but({});
      recipe.contacts = {on_back(index, 0.7)};
      break;
    case Gesture::grasp:
      posture.spread(2, 0, -3, -6).curl_all({70, 92, 50}).thumb({48, 34, 5, 10, 15});
      posture.curl(index, {38, 45, 25});
      break;
    case Gesture::pinch:
      posture.spread(2, 0, -5, -12).curl(index, {50, 50, 25}).curl(middle, {30, 35, 18});
      posture.curl(ring, {24, 30, 15}).curl(little, {18, 26, 12}).thumb({40, 40, 0, 15, 25});
      recipe.contacts = {pads(index, 0.72, 0.72)};
      break;
    case Gesture::zero:
      return round_zero();
    case Gesture::six:
      return ring_with(little);
    case Gesture::seven:
      return ring_with(ring);
    case Gesture::eight:
      return ring_with(middle);
    case Gesture::nine:
      return ring_with(index);
  }
  return recipe;
}

// Nobody makes a gesture twice in the same way.
HandPose varied(const HandPose& pose, std::uint64_t manner) {
  Random random(manner);
  HandPose varied = pose;
  const auto vary = [&](Eigen::Index angle, double degrees) {
    varied[angle] += degrees * kDegree * std::clamp(random.normal(), -2.0, 2.0);
  };
  for (const Eigen::Index angle : {thumb_radial, thumb_palmar, thumb_twist, thumb_mcp, thumb_ip})
    vary(angle, 4);
  for (const Finger finger : kFingers) {
    vary(angle_index(finger, FingerAngle::spread), 2.5);
    vary(angle_index(finger, FingerAngle::mcp), 3.5);
    vary(angle_index(finger, FingerAngle::pip), 3.5);
    vary(angle_index(finger, FingerAngle::dip), 3);
  }
  vary(wrist_flexion, 6);
  vary(wrist_deviation, 5);
  return within_limits(varied);
}

}  // namespace

std::string_view name(Gesture gesture) { return kNames[static_cast<std::size_t>(gesture)]; }

std::optional<Gesture> gesture_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Gesture>(i);
  }
  return std::nullopt;
}

HandPose pose_of(Gesture gesture, const HandAnatomy& anatomy, std::uint64_t manner) {
  const Recipe recipe = recipe_of(gesture);
  const HandPose& usual = recipe.posture.pose();
  const HandPose prior = manner == 0 ? usual : varied(usual, manner);
  return recipe.contacts.empty() ? prior : touching(anatomy, prior, recipe.contacts);
}

double shown_turn(Gesture gesture) { return gesture == Gesture::zero ? 45 * kDegree : 0; }

}  // namespace armsreach::sim
