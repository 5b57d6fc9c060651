#include "devices/sim/hand/skin_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace armsreach::sim {
namespace {

using Eigen::Vector3f;

// Cosine of view and normal below which no triangle at a vertex is seen.
constexpr float kTurnedAway = -0.5F;

float square(float x) { return x * x; }

float smooth_step(float low, float high, float at) {
  const float s = std::clamp((at - low) / (high - low), 0.0F, 1.0F);
  return s * s * (3 - 2 * s);
}
// A bump of height 1 and about that half width.
float bump(float at, float half_width) {
  const float s = at / half_width;
  return std::exp(-s * s);
}

struct Segment {  // of a finger, in its bone's frame
  float length;
  float radius;
  bool last;   // carries the nail
  bool first;  // begins at the palm
};

std::optional<Segment> segment_of(Bone bone, const HandAnatomy& anatomy) {
  const auto number = [](double value) { return static_cast<float>(value); };
  if (bone == 2 || bone == 3) {
    const std::size_t i = bone - 1;
    return Segment{number(anatomy.thumb.lengths[i]), number(anatomy.thumb.radii[i]), i == 2, false};
  }
  if (bone < 5 || bone >= kForearmBone || bone % 5 == 0 || bone % 5 == 4) return std::nullopt;
  const FingerAnatomy& finger = anatomy.fingers[bone / 5 - 1];
  const std::size_t i = bone % 5 - 1;
  return Segment{number(finger.lengths[i]), number(finger.radii[i]), i == 2, i == 0};
}

// 1 on the nail, 0 off it. `p` and `n` in the last bone's frame.
float nail_at(const Segment& segment, const Vector3f& p, const Vector3f& n) {
  const float along = p.y() / segment.length;
  const float across = p.x() / segment.radius;
  const float end = 0.97F - 0.25F * across * across;
  const float root = 0.52F + 0.1F * across * across;
  return smooth_step(root - 0.04F, root + 0.04F, along) *
         (1 - smooth_step(end - 0.05F, end + 0.05F, along)) *
         (1 - smooth_step(0.62F, 0.78F, std::abs(across))) * smooth_step(0.0F, 0.4F, -n.z());
}

// Darker lines where a finger folds, on the pad's side; wrinkles on the back of its joints.
float folds_at(const Segment& segment, const Vector3f& p, const Vector3f& n) {
  const float pad_side = smooth_step(-0.1F, 0.5F, n.z());
  const float back_side = smooth_step(0.1F, 0.7F, -n.z());
  const float start = segment.first ? 0.45F * segment.length : -0.0005F;
  const float fold = bump(p.y() - start, 0.0017F);
  const float wrinkles =
      segment.first ? 0.0F : bump(p.y() - 0.001F, 0.0045F) * (0.6F + 0.4F * std::cos(p.y() * 2400));
  return 0.13F * pad_side * fold + 0.10F * back_side * wrinkles;
}

Vector3f skin_at(const SkinColors& tone, const HandAnatomy& anatomy, Bone bone, float from_wrist,
                 const Vector3f& p, const Vector3f& n) {
  const float palm_side = smooth_step(-0.35F, 0.45F, n.z());
  // Sides of fingers are like the palm, the arm's inside is less so.
  const float palmar = palm_side * (0.35F + 0.65F * smooth_step(-0.02F, 0.03F, from_wrist));
  Vector3f skin = tone.back + palmar * (tone.palm - tone.back);
  const auto segment = segment_of(bone, anatomy);
  if (!segment) return skin;
  const float along = p.y() / segment->length;
  // More blood in the fingertips and over the joints.
  const float flush =
      segment->last ? 0.7F * smooth_step(0.2F, 0.9F, along) : 0.4F * bump(along - 0.02F, 0.25F);
  skin = skin.cwiseProduct(Vector3f(1 - 0.01F * flush, 1 - 0.075F * flush, 1 - 0.06F * flush));
  skin *= 1 - folds_at(*segment, p, n);
  if (!segment->last) return skin;
  const float nail = nail_at(*segment, p, n);
  const float fold = 4 * nail * (1 - nail);  // around it
  skin *= 1 - 0.16F * fold;
  // The free edge is white, the root paler.
  const float across = p.x() / segment->radius;
  const float white = smooth_step(0.86F, 0.92F, along + 0.16F * across * across) +
                      0.5F * (1 - smooth_step(0.55F, 0.66F, along));
  const Vector3f plate = tone.nail + 0.45F * white * (Vector3f(0.97F, 0.93F, 0.9F) - tone.nail);
  return skin + nail * (plate - skin);
}

// The palm's three lines, as polylines in shares of the palm (x from the little finger's side, y
// from the wrist to the knuckles).
float palm_lines_at(const HandAnatomy& anatomy, const Vector3f& rest, const Vector3f& normal) {
  if (normal.z() < 0.3F) return 0;
  using Line = std::array<Eigen::Vector2f, 4>;
  static const std::array<Line, 3> kLines{
      Line{{{0.02F, 0.74F}, {0.3F, 0.73F}, {0.6F, 0.82F}, {0.72F, 0.97F}}},
      Line{{{0.08F, 0.45F}, {0.4F, 0.58F}, {0.7F, 0.70F}, {1.0F, 0.76F}}},
      Line{{{0.50F, 0.10F}, {0.56F, 0.35F}, {0.72F, 0.58F}, {1.0F, 0.74F}}}};
  const float little =
      static_cast<float>(anatomy.fingers[3].knuckle.x() - anatomy.fingers[3].radii[0]);
  const float width = static_cast<float>(anatomy.palm_breadth());
  const float length = static_cast<float>(anatomy.fingers[1].knuckle.y()) * 1.06F;
  float nearest = 1;
  for (const Line& line : kLines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const auto at = [&](const Eigen::Vector2f& s) {
        return Eigen::Vector2f(little + s.x() * width, s.y() * length);
      };
      const Eigen::Vector2f a = at(line[i]);
      const Eigen::Vector2f way = at(line[i + 1]) - a;
      const Eigen::Vector2f from = rest.head<2>() - a;
      const float t = std::clamp(from.dot(way) / way.squaredNorm(), 0.0F, 1.0F);
      nearest = std::min(nearest, (from - t * way).norm());
    }
  }
  return 0.13F * bump(nearest, 0.0021F) * smooth_step(0.3F, 0.7F, normal.z());
}

// Balls in the flesh that keep light off what lies opposite.
struct Shade {
  Vector3f centre;
  float radius;
};

std::vector<Shade> shades_of(const HandSkeleton& skeleton, const HandAnatomy& anatomy) {
  std::vector<Shade> shades;
  const auto add = [&](Bone bone, double x, double y, double z, double radius) {
    const Eigen::Vector3d centre = skeleton.hand_from_joint[bone] * Eigen::Vector3d(x, y, z);
    shades.push_back({centre.cast<float>(), static_cast<float>(radius)});
  };
  const ThumbAnatomy& thumb = anatomy.thumb;
  for (Bone bone = 1; bone <= 3; ++bone) {
    for (const double share : {0.25, 0.75})
      add(bone, 0, share * thumb.lengths[bone - 1], 0, thumb.radii[bone - 1]);
  }
  for (const Finger finger : kFingers) {
    const FingerAnatomy& one = anatomy.fingers[static_cast<std::size_t>(finger) - 1];
    const Bone first = static_cast<Bone>(joint_of(finger, 0));
    const double metacarpal = (one.knuckle - one.base).norm();
    for (const double share : {0.3, 0.7}) add(first, 0, share * metacarpal, 0, 0.011);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const double share : {0.25, 0.75})
        add(first + i + 1, 0, share * one.lengths[i], 0, 0.95 * one.radii[i + 1]);
    }
  }
  return shades;
}

}  // namespace

std::vector<Vector3f> colors_of(const HandSurface& surface, SkinTone tone, const Color& sleeve) {
  const HandAnatomy& anatomy = surface.anatomy();
  const HandSkeleton rest = skeleton_of(anatomy, HandSurface::rest_pose());
  std::vector<Vector3f> colors;
  colors.reserve(surface.rest().vertices.size());
  for (std::size_t i = 0; i < surface.rest().vertices.size(); ++i) {
    if (surface.is_sleeve(i)) {
      colors.push_back(sleeve.cast<float>());
      continue;
    }
    const Bone bone = surface.bone_of(i);
    const Pose bone_from_hand =
        (bone == kForearmBone ? rest.hand_from_forearm : rest.hand_from_joint[bone]).inverse();
    const Vector3f& position = surface.rest().vertices[i];
    const Vector3f& normal = surface.rest_normals()[i];
    const Eigen::Vector3d in_bone = bone_from_hand * position.cast<double>();
    const Eigen::Vector3d facing = bone_from_hand.rotation() * normal.cast<double>();
    Vector3f color = skin_at(colors_of(tone), anatomy, bone, position.y(), in_bone.cast<float>(),
                             facing.cast<float>());
    color *= 1 - palm_lines_at(anatomy, position, normal);
    colors.push_back(color);
  }
  return colors;
}

// Each ball takes from the half space over a vertex about the share of directions that it fills,
// more where it stands straight above.
std::vector<float> openness(const HandSkeleton& skeleton, const HandAnatomy& anatomy,
                            const PosedSurface& posed) {
  const std::vector<Shade> shades = shades_of(skeleton, anatomy);
  std::vector<float> open(posed.positions.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    float taken = 0;
    for (const Shade& shade : shades) {
      const Vector3f towards = shade.centre - posed.positions[i];
      const float facing = posed.normals[i].dot(towards);
      if (facing <= 0) continue;
      const float squared = towards.squaredNorm();
      const float squared_radius = shade.radius * shade.radius;
      taken += std::min(1.0F, squared_radius / squared) * facing / std::sqrt(squared);
    }
    open[i] = 1 / (1 + 0.9F * taken);
  }
  return open;
}

// Colours are square roots of what is sent back, as in the worlds' surfaces. Light that enters the
// skin comes out farther on, red the farthest: the shadow's edge is soft and warm.
std::vector<Vector3f> lit(const std::vector<Vector3f>& colors, const std::vector<float>& openness,
                          const PosedSurface& placed, const Lighting& lighting) {
  const Vector3f towards = lighting.light.towards.cast<float>();
  const Vector3f key = lighting.light.key.cast<float>();
  const Vector3f above = lighting.light.above.cast<float>();
  const Vector3f below = lighting.light.below.cast<float>();
  const Eigen::Array3f wrap(0.32F, 0.2F, 0.16F);
  std::vector<Vector3f> seen(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Vector3f& normal = placed.normals[i];
    const Vector3f view = (lighting.eye - placed.positions[i]).normalized();
    if (normal.dot(view) < kTurnedAway) {
      seen[i].setZero();
      continue;
    }
    const float open = openness[i];
    const float facing = normal.dot(towards);
    const Eigen::Array3f falls = ((facing + wrap) / (1 + wrap)).max(0.0F);
    const float height = 0.5F + 0.5F * normal.dot(lighting.up);
    const Eigen::Array3f around = (below + height * (above - below)).array();
    const float mirrored = std::max(0.0F, normal.dot((view + towards).normalized()));
    const float mirrored_8 = square(square(square(mirrored)));
    const float sheen = 0.05F * mirrored_8 * mirrored_8 * mirrored_8 * std::max(0.0F, facing);
    // What lies deep between fingers is lit by skin: darker and redder.
    const Eigen::Array3f depth(open * (1.12F - 0.12F * open), open, open * (0.95F + 0.05F * open));
    const Eigen::Array3f light = falls * key.array() * std::sqrt(open) + around * depth;
    const Eigen::Array3f color = (colors[i].array().square() * light + sheen * key.array()).sqrt();
    seen[i] = 255 * Vector3f(color[2], color[1], color[0]).cwiseMin(1.0F);
  }
  return seen;
}

}  // namespace armsreach::sim
