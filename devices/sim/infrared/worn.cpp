#include "devices/sim/infrared/worn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "devices/sim/hand/contact.hpp"

namespace armsreach::sim {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kOverSkin = 0.0012;    // m: how far tape lies above what is under it
constexpr double kUnderTape = 0.0006;   // m: how far its carrier lies below
constexpr double kPlateMargin = 0.003;  // m around the square

// z away from the back of the hand, y along the fingers.
Quaterniond back_turn() { return Quaterniond(0, 0, 1, 0); }

void move(const Pose& pose, WornPart& part) {
  const Pose& p = pose;
  for (auto& position : part.positions) position = (p * position.cast<double>()).cast<float>();
  for (auto& normal : part.normals) normal = (p.rotation() * normal.cast<double>()).cast<float>();
}

WornPart band(double radius, double width) {
  constexpr std::uint32_t kSides = 48;
  WornPart part;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const Vector3d outwards(std::sin(angle), 0, -std::cos(angle));
    for (const double y : {-0.5 * width, 0.5 * width}) {
      part.positions.push_back((radius * outwards + y * Vector3d::UnitY()).cast<float>());
      part.normals.push_back(outwards.cast<float>());
    }
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % kSides);
    part.triangles.push_back({a, a + 1, b});
    part.triangles.push_back({b, a + 1, b + 1});
  }
  return part;
}

WornPart plate(double side) {
  const float h = static_cast<float>(0.5 * side);
  WornPart part;
  part.positions = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  part.normals.assign(4, Eigen::Vector3f::UnitZ());
  part.triangles = {{0, 1, 2}, {0, 2, 3}};
  return part;
}

void add(TapePiece piece, const Pose& hand_from_piece, Worn& worn) {
  piece.move(hand_from_piece);
  worn.tape.push_back(std::move(piece));
}

// On the back of a finger's bone: z outwards, y along the bone.
Pose hand_from_finger_marker(const HandAnatomy& anatomy, const HandSkeleton& skeleton,
                             Finger finger) {
  constexpr int kPart = 2;  // the intermediate bone, the thumb's last
  // The thumb shows its side where the fingers show their backs.
  const Vector3d side = finger == Finger::thumb ? Vector3d(-0.7, 0, -0.7) : Vector3d(0, 0, -1);
  const SkinPoint skin = skin_point(anatomy, skeleton, {finger, kPart, 0.5, side});
  const Vector3d z = skin.outwards;
  const Vector3d bone = skeleton[joint_of(finger, kPart)].rotation() * Vector3d::UnitY();
  const Vector3d x = bone.cross(z).normalized();
  Eigen::Matrix3d turn;
  turn << x, z.cross(x), z;
  return {Quaterniond(turn), skin.position + kOverSkin * z};
}

}  // namespace

int BraceletDescription::segments() const {
  return static_cast<int>(2 * std::numbers::pi * radius / spacing);
}

Pose forearm_from_bracelet(const BraceletDescription& bracelet) {
  return {Quaterniond::Identity(), {0, -bracelet.behind, 0}};
}

Pose hand_from_square(const GloveDescription& glove, const HandSurface& surface) {
  const auto& knuckles = surface.anatomy().fingers;
  const double half = 0.5 * kGloveCells * glove.cell + kPlateMargin;
  const double x = 0.5 * (knuckles[0].knuckle.x() + knuckles[3].knuckle.x());
  const double y = knuckles[1].knuckle.y() - half - 0.004;
  double top = 0;
  for (const Eigen::Vector3f& p : surface.rest().vertices) {
    const Vector3d point = p.cast<double>();
    if (std::abs(point.x() - x) < half && std::abs(point.y() - y) < half)
      top = std::min(top, point.z());
  }
  return {back_turn(), {x, y, top - kOverSkin}};
}

void wear(const BraceletDescription& bracelet, const HandSkeleton& skeleton, Worn& worn) {
  const Pose hand_from_bracelet = skeleton.hand_from_forearm * forearm_from_bracelet(bracelet);
  const int count = bracelet.segments();
  for (int i = 0; i < count; ++i) {
    const double angle = (0.5 * (count - 1) - i) * bracelet.spacing / bracelet.radius;
    add(tape_on_cylinder("bracelet " + std::to_string(i), bracelet.segment, bracelet.radius, angle),
        hand_from_bracelet, worn);
  }
  worn.carriers.push_back(band(bracelet.radius - kUnderTape, bracelet.width));
  move(hand_from_bracelet, worn.carriers.back());
}

void wear(const GloveDescription& glove, const HandSurface& surface, const HandSkeleton& skeleton,
          Worn& worn) {
  const Pose square = hand_from_square(glove, surface);
  // The thumb is on the square's left.
  add(tape_frame("square", glove.cell, kGloveCells, kGloveInnerCells,
                 {1, kGloveCells - 1 - kGloveInnerCells}),
      square, worn);
  const Pose below(Quaterniond::Identity(), {0, 0, -kUnderTape});
  worn.carriers.push_back(plate(kGloveCells * glove.cell + 2 * kPlateMargin));
  move(square * below, worn.carriers.back());
  add(tape_square("thumb", glove.finger),
      hand_from_finger_marker(surface.anatomy(), skeleton, Finger::thumb), worn);
  const char* names[] = {"index", "middle", "ring", "little"};
  for (const Finger finger : kFingers) {
    add(tape_disc(names[static_cast<std::size_t>(finger) - 1], glove.finger),
        hand_from_finger_marker(surface.anatomy(), skeleton, finger), worn);
  }
}

}  // namespace armsreach::sim
