#include "devices/sim/wearer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace armsreach::sim {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStep = 0.005;  // s, in which walking is added up

// Shares of the body's height. Source: Winter, "Biomechanics and motor control of human movement",
// 4th edition, fig. 4.1.
constexpr double kHips = 0.53;
constexpr double kShoulders = 0.818;
constexpr double kEyes = 0.936;
constexpr double kHalfShoulders = 0.129;

// A walk's rise and fall (twice a stride), its swing from foot to foot and roll with it, at a
// comfortable pace; and how far apart two steps of the same foot are.
constexpr double kRise = 0.018;      // m
constexpr double kSwing = 0.02;      // m
constexpr double kWalkRoll = 0.012;  // rad
constexpr double kStridePerHeight = 0.8;
constexpr double kComfortable = 1.2;  // m/s

constexpr double kWornTilt = -0.65;  // rad, of the shoulder's mount: down to where the hands work

constexpr double kLean = 0.42;   // rad, of a full reach
constexpr double kTwist = 0.30;  // rad, the right shoulder forward

Spline spline_through(const WearerDescription& wearer, const PathDescription& path) {
  std::vector<double> times;
  std::vector<Spline::Point> points;
  for (const WearerKey& key : wearer.keys) {
    Spline::Point point;
    point << key.stand, key.heading, key.look, key.reach;
    times.push_back(key.time);
    points.push_back(point);
  }
  if (times.size() == 1) {
    times.push_back(times[0] + path.duration);
    points.push_back(points[0]);
  }
  return {std::move(times), std::move(points), path.closed && wearer.keys.size() > 1,
          path.duration};
}

// The sway of a standing body, in its own axes: mostly to and fro, and with it small turns.
Tremor standing(double sway) {
  Tremor tremor;
  tremor.sway = sway;
  tremor.sway_angle = 1.2 * sway;  // rad per m: a body of under a metre above its hips
  tremor.shake = 0.0001;
  tremor.shake_angle = 0.0003;
  return tremor;
}

}  // namespace

Wearer::Wearer(const WearerDescription& description, const PathDescription& path,
               std::uint64_t seed)
    : height_(description.height),
      duration_(path.duration),
      closed_(path.closed),
      spline_(spline_through(description, path)),
      unrest_(standing(description.sway), path.duration, seed) {
  walked_.push_back(0);
  for (double time = 0; time < duration_; time += kStep) {
    const Eigen::Vector2d way = spline_.at(time + kStep).head<2>() - spline_.at(time).head<2>();
    walked_.push_back(walked_.back() + way.norm());
  }
}

double Wearer::walked(double time) const {
  const double steps = std::clamp(time / kStep, 0.0, static_cast<double>(walked_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(steps), walked_.size() - 2);
  const double share = steps - static_cast<double>(i);
  return walked_[i] + share * (walked_[i + 1] - walked_[i]);
}

Wearer::Body Wearer::body_at(double time) const {
  const double t =
      closed_ ? time - duration_ * std::floor(time / duration_) : std::clamp(time, 0.0, duration_);
  const Spline::Point point = spline_.at(t);
  const double reach = std::clamp(point[6], 0.0, 1.0);
  // Over half a second around, so that a walk begins and ends softly.
  const double pace = (walked(t + 0.25) - walked(t - 0.25)) / 0.5;
  const double vigour = std::min(1.0, pace / kComfortable);
  const double phase = kTurn * walked(t) / (kStridePerHeight * height_);
  Body body;
  body.look = point.segment<3>(3);
  body.unrest = unrest_.at(t);
  const Vector3d hips(point[0], point[1], kHips * height_);
  const Vector3d gait(0, kSwing * vigour * std::sin(phase),
                      -kRise * vigour * 0.5 * (1 - std::cos(2 * phase)));
  const Eigen::Quaterniond upright(Eigen::AngleAxisd(point[2] + kTwist * reach, Vector3d::UnitZ()));
  const Eigen::Quaterniond bent =
      upright * Eigen::AngleAxisd(kLean * reach, Vector3d::UnitY()) *
      Eigen::AngleAxisd(kWalkRoll * vigour * std::sin(phase), Vector3d::UnitX());
  body.world_from_chest = Pose(bent, hips + upright * (gait + Vector3d(body.unrest.head<3>())));
  return body;
}

Pose Wearer::world_from_head(double time) const {
  const Body body = body_at(time);
  const Vector3d neck = body.world_from_chest * Vector3d(0, 0, (0.87 - kHips) * height_);
  const Vector3d towards = (body.look - neck).normalized();
  const Vector3d eyes = neck + (kEyes - 0.87) * height_ * Vector3d::UnitZ() + 0.08 * towards;
  return Pose(looking_along(body.look - eyes) * so3_exp(body.unrest.tail<3>()), eyes);
}

Pose Wearer::world_from_shoulder(double time) const {
  const Body body = body_at(time);
  const Vector3d shoulder(0.03, -kHalfShoulders * height_, (kShoulders - kHips) * height_ + 0.03);
  const Pose& chest = body.world_from_chest;
  // The camera's x is the body's right, its y down.
  Eigen::Matrix3d chest_from_camera;
  chest_from_camera << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return chest * Pose(Eigen::Quaterniond(chest_from_camera), shoulder) *
         Pose(so3_exp(kWornTilt * Vector3d::UnitX()) * so3_exp(body.unrest.tail<3>()),
              Vector3d::Zero());
}

Vector3d Wearer::shoulder(bool left, double time) const {
  const Vector3d right(0, -kHalfShoulders * height_ + 0.03, (kShoulders - kHips) * height_ - 0.04);
  return body_at(time).world_from_chest *
         Vector3d(right.x(), left ? -right.y() : right.y(), right.z());
}

}  // namespace armsreach::sim
