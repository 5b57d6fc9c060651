#include "simulated_gestures.hpp"

#include <array>
#include <numbers>
#include <utility>

#include "devices/sim/hand/contact.hpp"
#include "devices/sim/hand/gesture.hpp"
#include "devices/sim/hand/silhouette.hpp"
#include "devices/sim/random.hpp"

namespace armsreach::tools {
namespace {

using namespace sim;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kSide = 160;    // px of the silhouettes
constexpr double kTilt = 20;  // deg to either side

struct Angle {
  Eigen::Index index;
  double degrees;
};
HandPose with(HandPose pose, std::initializer_list<Angle> angles) {
  for (const Angle& angle : angles) pose[angle.index] = angle.degrees * kDegree;
  return pose;
}
HandPose curled(const HandPose& pose, Finger finger, double mcp, double pip, double dip) {
  return with(pose, {{angle_index(finger, FingerAngle::mcp), mcp},
                     {angle_index(finger, FingerAngle::pip), pip},
                     {angle_index(finger, FingerAngle::dip), dip}});
}
HandPose closed_up(HandPose pose, double spread) {
  for (const Finger finger : kFingers) pose[angle_index(finger, FingerAngle::spread)] *= spread;
  return pose;
}

// One manner of making a gesture, and how far the hand may be turned about its fingers' direction.
using MakePose = HandPose (*)(const HandAnatomy&, Random&);
struct Manner {
  const char* gesture;
  MakePose pose;
  double least_turn;  // deg
  double most_turn;
};

std::uint64_t any(Random& random) { return 1 + random.bits() % 1000000; }

template <Gesture gesture>
HandPose usual(const HandAnatomy& anatomy, Random& random) {
  return pose_of(gesture, anatomy, any(random));
}

// The other fingers make a ring with the thumb.
HandPose point_over_ring(const HandAnatomy& anatomy, Random& random) {
  const HandPose ring = blend(usual<Gesture::zero>(anatomy, random),
                              usual<Gesture::fist>(anatomy, random), random.uniform(0, 0.5));
  return curled(ring, Finger::index, 2, 4, 2);
}
HandPose open_fingers_together(const HandAnatomy& anatomy, Random& random) {
  const HandPose open = closed_up(usual<Gesture::open>(anatomy, random), random.uniform(0, 0.25));
  return with(open, {{thumb_radial, random.uniform(5, 35)}, {thumb_palmar, random.uniform(0, 20)}});
}
HandPose fist_thumb_aside(const HandAnatomy& anatomy, Random& random) {
  return with(usual<Gesture::fist>(anatomy, random), {{thumb_radial, random.uniform(4, 14)},
                                                      {thumb_palmar, random.uniform(15, 30)},
                                                      {thumb_mcp, 5},
                                                      {thumb_ip, 5}});
}
// Index and thumb around something small, open or closed on it; the other fingers are folded.
HandPose grasp_index_arched(const HandAnatomy& anatomy, Random& random) {
  const HandPose pose =
      curled(usual<Gesture::grasp>(anatomy, random), Finger::index, random.uniform(0, 45),
             random.uniform(30, 70), random.uniform(10, 40));
  return with(pose, {{thumb_radial, random.uniform(30, 60)},
                     {thumb_palmar, random.uniform(15, 50)},
                     {thumb_mcp, random.uniform(-5, 15)},
                     {thumb_ip, random.uniform(-10, 20)}});
}
// Index and thumb meet before the folded fingers, as on a key or a pen.
HandPose grasp_index_on_thumb(const HandAnatomy& anatomy, Random& random) {
  HandPose pose = curled(usual<Gesture::fist>(anatomy, random), Finger::index,
                         random.uniform(45, 85), random.uniform(10, 45), random.uniform(5, 20));
  const double middle = random.uniform(60, 80);
  pose = curled(pose, Finger::middle, middle, random.uniform(60, 95), 35);
  pose = with(pose, {{thumb_radial, random.uniform(25, 40)},
                     {thumb_palmar, random.uniform(40, 55)},
                     {thumb_mcp, 10},
                     {thumb_ip, 10}});
  const Contact tips[]{
      {{Finger::thumb, 2, 0.7, {0, 0.15, 1}}, {Finger::index, 3, 0.7, {0, 0.15, 1}}}};
  return touching(anatomy, pose, tips);
}
// Around something the size of a glass.
HandPose grasp_round(const HandAnatomy& anatomy, Random& random) {
  const HandPose open = closed_up(usual<Gesture::open>(anatomy, random), 0);
  return blend(usual<Gesture::zero>(anatomy, random), open, random.uniform(0.1, 0.3));
}
// All four fingers alike, their tips on the thumb's. Degrees, each drawn from [low, high].
struct FingertipGrasp {
  std::array<double, 2> mcp, pip;
  double dip;
  std::array<double, 2> thumb_radial, thumb_palmar;
  double thumb_bend;
};
HandPose on_fingertips(const HandAnatomy& anatomy, Random& random, const FingertipGrasp& grasp) {
  const auto drawn = [&](const std::array<double, 2>& r) { return random.uniform(r[0], r[1]); };
  HandPose pose = usual<Gesture::zero>(anatomy, random);
  const double mcp = drawn(grasp.mcp);
  const double pip = drawn(grasp.pip);
  for (const Finger finger : kFingers) pose = curled(pose, finger, mcp, pip, grasp.dip);
  return with(pose, {{thumb_radial, drawn(grasp.thumb_radial)},
                     {thumb_palmar, drawn(grasp.thumb_palmar)},
                     {thumb_mcp, grasp.thumb_bend},
                     {thumb_ip, grasp.thumb_bend}});
}
// Straight fingers on the thumb, as around a sheet of paper.
HandPose grasp_flat(const HandAnatomy& anatomy, Random& random) {
  return on_fingertips(anatomy, random, {{45, 70}, {10, 35}, 10, {20, 35}, {48, 60}, 10});
}
// The same with fingers bent along their length, a beak in the arm's direction.
HandPose grasp_beak(const HandAnatomy& anatomy, Random& random) {
  return on_fingertips(anatomy, random, {{25, 50}, {25, 45}, 20, {12, 25}, {35, 50}, 5});
}

constexpr Manner kWearable[] = {{"point", usual<Gesture::point>, -40, 40},
                                {"point", point_over_ring, -20, 70},
                                {"L", usual<Gesture::L>, -40, 40},
                                {"L", usual<Gesture::L>, -40, 40},
                                {"open", usual<Gesture::open>, -40, 40},
                                {"open", open_fingers_together, -40, 40},
                                {"open", open_fingers_together, -60, 60},
                                {"fist", usual<Gesture::fist>, -30, 30},
                                {"fist", usual<Gesture::fist>, -45, 45},
                                {"fist", fist_thumb_aside, -40, 40},
                                {"fist", fist_thumb_aside, -25, 25},
                                {"grasp", usual<Gesture::grasp>, -20, 70},
                                {"grasp", grasp_index_arched, 20, 75},
                                {"grasp", grasp_index_arched, 20, 75},
                                {"grasp", grasp_index_on_thumb, 25, 70},
                                {"grasp", grasp_index_on_thumb, 40, 90},
                                {"grasp", usual<Gesture::zero>, 40, 90},
                                {"grasp", grasp_round, 30, 90},
                                {"grasp", grasp_flat, 50, 110},
                                {"grasp", grasp_beak, 50, 110}};
// A zero is shown from the little finger's side.
constexpr Manner kNumerals[] = {
    {"0", usual<Gesture::zero>, 28, 62},   {"1", usual<Gesture::one>, -17, 17},
    {"2", usual<Gesture::two>, -17, 17},   {"3", usual<Gesture::three>, -17, 17},
    {"4", usual<Gesture::four>, -17, 17},  {"5", usual<Gesture::five>, -17, 17},
    {"6", usual<Gesture::six>, -17, 17},   {"7", usual<Gesture::seven>, -17, 17},
    {"8", usual<Gesture::eight>, -17, 17}, {"9", usual<Gesture::nine>, -17, 17}};

template <std::size_t N>
std::vector<BankExample> drawn(const Manner (&manners)[N], int people) {
  std::vector<BankExample> examples;
  SilhouetteCamera camera(kSide);
  for (int person = 0; person < people; ++person) {
    const auto seed = static_cast<std::uint64_t>(7000 + person);
    Random random(seed);
    HandSurfaceOptions options;
    options.cell = 0.005;
    // Half of the arms reach the image's border; the others end behind the wrist, as in a sleeve.
    options.forearm = person % 2 == 0 ? random.uniform(0.01, 0.09) : 0.28;
    const HandSurface surface(random_anatomy(seed), options);
    for (const Manner& manner : manners) {
      HandView view;
      view.turn = random.uniform(manner.least_turn, manner.most_turn) * kDegree;
      view.tilt = random.uniform(-kTilt, kTilt) * kDegree;
      view.distance = random.uniform(0.6, 0.8);
      const HandPose pose = manner.pose(surface.anatomy(), random);
      examples.push_back({manner.gesture, camera.draw(surface, pose, view) > 0, true});
    }
  }
  return examples;
}

}  // namespace

std::vector<BankExample> simulated_wearable(int people) { return drawn(kWearable, people); }
std::vector<BankExample> simulated_numerals(int people) { return drawn(kNumerals, people); }

}  // namespace armsreach::tools
