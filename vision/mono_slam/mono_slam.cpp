#include "vision/mono_slam/mono_slam.hpp"

#include <algorithm>
#include <cmath>

namespace armsreach::mono_slam {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Of a camera that is held: what its velocities may be when nothing is known of them.
constexpr double kUnknownVelocity = 0.3;         // m/s
constexpr double kUnknownAngularVelocity = 0.5;  // rad/s
// From a global shutter to one that takes all of a frame's time.
constexpr double kUnknownReadout = 0.02;  // s

CameraCovariance camera_covariance(const Matrix6d& pose) {
  CameraCovariance out = CameraCovariance::Zero();
  out.topLeftCorner<kPoseRows, kPoseRows>() = pose;
  out.diagonal().segment<3>(6).setConstant(kUnknownVelocity * kUnknownVelocity);
  out.diagonal().segment<3>(9).setConstant(kUnknownAngularVelocity * kUnknownAngularVelocity);
  out(kReadoutRow, kReadoutRow) = kUnknownReadout * kUnknownReadout;
  return out;
}

constexpr double kLeap = 0.03;  // rad a frame of commanded turn, beyond which pictures are smeared

double commanded_turn(const MonoInput& input) {
  return input.control ? so3_log(input.control->before_from_after.rotation()).norm() : 0;
}

// Towards the camera.
Vector3d normal_of(const std::vector<SeenPoint>& points, const Vector3d& camera_in_world) {
  const Vector3d& origin = points[0].point_in_world;
  Vector3d normal = (points[1].point_in_world - origin).cross(points[2].point_in_world - origin);
  if (normal.norm() < 1e-9) return (camera_in_world - origin).normalized();
  normal.normalize();
  return normal.dot(camera_in_world - origin) > 0 ? normal : Vector3d(-normal);
}

// The depth around a pixel; nothing where it is unknown or a step.
std::optional<double> steady_depth(const cv::Mat& depth, const Vector2d& pixel) {
  constexpr int kReach = 2;
  constexpr float kStep = 0.05F;  // of the depth
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  std::vector<float> around;
  for (int row = std::max(y - kReach, 0); row <= std::min(y + kReach, depth.rows - 1); ++row) {
    for (int col = std::max(x - kReach, 0); col <= std::min(x + kReach, depth.cols - 1); ++col) {
      const float z = depth.at<float>(row, col);
      if (z > 0) around.push_back(z);
    }
  }
  if (around.size() < 15) return std::nullopt;
  std::sort(around.begin(), around.end());
  if (around.back() - around.front() > kStep * around.front()) return std::nullopt;
  return static_cast<double>(around[around.size() / 2]);
}

}  // namespace

MonoSlam::MonoSlam(const Camera& camera, const MonoSlamOptions& options)
    : camera_(camera),
      options_(options),
      random_(options.seed),
      // Rays take up to twice the rows of a point.
      filter_(camera, options.most_points + options.visible_points, options.pixel_sigma),
      turn_meter_(camera) {
  if (options.target) target_.emplace(*options.target);
}

MonoResult MonoSlam::step(const MonoInput& input) {
  CV_Assert(input.grey.type() == CV_8UC1 && input.grey.cols == camera_.width &&
            input.grey.rows == camera_.height);
  ++frame_;
  const TrackingState before = state_;
  image_.set(input.grey);
  turn_meter_.take(input.grey);
  looks_.clear();
  inliers_ = 0;
  if (options_.forget_start_target_at && frame_ == *options_.forget_start_target_at) {
    forget_target();
  }
  if (state_ == TrackingState::relocalised) state_ = TrackingState::tracking;
  if (state_ == TrackingState::initialising) {
    initialise(input);
    inliers_ = static_cast<int>(landmarks_.size());
  } else if (state_ == TrackingState::lost) {
    find_again();
  } else {
    track(input);
  }
  last_time_ = input.time;
  MonoResult out = result(input);
  out.state_changed = state_ != before;
  return out;
}

void MonoSlam::initialise(const MonoInput& input) {
  if (target_) {
    target_sight_ = target_->look(input.grey, image_, camera_);
    if (target_sight_ == TargetSight::found) start_on_target(input, target_->fix());
    return;
  }
  if (!input.depth.empty()) start_on_depth(input);
  if (state_ == TrackingState::initialising && !waits_for_depth(input)) start_as_stated(input);
}

// One frame of depth may be taken too near, or of a bare wall.
bool MonoSlam::waits_for_depth(const MonoInput& input) const {
  return !input.depth.empty() && frame_ < options_.depth_patience;
}

void MonoSlam::start_on_target(const MonoInput& input, const TargetFix& fix) {
  constexpr double kTargetSigma = 2e-4;  // m: as well as a print is measured
  CameraState state;
  state.position = fix.pose.world_from_camera.translation();
  state.rotation = fix.pose.world_from_camera.rotation();
  filter_.start(
      state, camera_covariance(options_.pixel_sigma * options_.pixel_sigma * fix.pose.covariance));
  const Vector3d normal = normal_of(fix.points, state.position);
  for (const SeenPoint& seen : fix.points) {
    const auto id = filter_.add_known(seen.point_in_world, kTargetSigma);
    if (!id) break;
    keep(*id, input.grey, seen.pixel);
    landmarks_.back().of_target = true;
    landmarks_.back().patch.normal_in_world = normal;
  }
  scale_ = ScaleFrom::target;
  state_ = TrackingState::tracking;
}

void MonoSlam::start_at_origin() {
  constexpr double kExact = 1e-8;  // m^2, rad^2: the world is where the camera starts
  filter_.start(CameraState(), camera_covariance(kExact * Matrix6d::Identity()));
}

void MonoSlam::start_on_depth(const MonoInput& input) {
  constexpr double kNoise = 2.85e-3;  // 1/m: twice a structured-light camera's, for what is beside
  constexpr int kTries = 200;
  constexpr int kLeast = 6;
  start_at_origin();
  for (int i = 0; i < kTries && static_cast<int>(landmarks_.size()) < options_.visible_points;
       ++i) {
    const auto pixel =
        interesting_pixel(input.grey, input.allowed, taken_pixels(), options_.interest, &random_);
    if (!pixel) continue;
    const auto z = steady_depth(input.depth, *pixel);
    if (!z) continue;
    const double along = unproject(camera_, *pixel).norm();
    const auto id = filter_.add_point(*pixel, *z * along, (kNoise * *z * *z + 0.002) * along);
    if (id) keep(*id, input.grey, *pixel);
  }
  if (static_cast<int>(landmarks_.size()) < kLeast) {
    landmarks_.clear();
    return;
  }
  scale_ = ScaleFrom::depth;
  state_ = TrackingState::tracking;
}

void MonoSlam::start_as_stated(const MonoInput& input) {
  constexpr int kTries = 100;
  constexpr int kLeast = 6;
  start_at_origin();
  const double inverse = 1 / options_.stated_distance;
  for (int i = 0; i < kTries && static_cast<int>(landmarks_.size()) < options_.visible_points;
       ++i) {
    const auto pixel =
        interesting_pixel(input.grey, input.allowed, taken_pixels(), options_.interest, &random_);
    if (!pixel) continue;
    const auto id = filter_.add_inverse_depth(*pixel, inverse, 0.4 * inverse);
    if (id) keep(*id, input.grey, *pixel);
  }
  if (static_cast<int>(landmarks_.size()) < kLeast) {
    landmarks_.clear();
    return;
  }
  scale_ = ScaleFrom::stated;
  state_ = TrackingState::tracking;
}

void MonoSlam::track(const MonoInput& input) {
  const double seconds = std::max(0.0, seconds_from_timestamp(input.time - *last_time_));
  filter_.predict(seconds, options_.motion, input.control);
  const bool turns = commanded_turn(input) > kLeap;
  if (turns && poor_frames_ == 0 && !leapt_at_) leapt_at_ = input.time;
  if (excused(input.time)) {
    feel_turning(input, seconds);
    // A picture taken meanwhile is smeared over the way: no single point is looked for in it.
    if (turns) return;
  }
  measure(options_.search_deviations);
  inliers_ = count_inliers();
  if (turned_away(input.time)) return add_points(input, options_.visible_points);
  if (inliers_ < options_.least_inliers) {
    measure(options_.jerk_deviations);
    inliers_ = count_inliers();
  }
  poor_frames_ = sees_enough() ? 0 : poor_frames_ + 1;
  if (poor_frames_ >= options_.patience) {
    state_ = TrackingState::lost;
    return;
  }
  // What was not seen in a frame that shows nothing says nothing about the points.
  if (inliers_ >= options_.least_inliers) {
    record(looks_);
    weigh_particles();
    manage_map(input);
  }
}

// A few points of many agree with any pose near a wrong one.
bool MonoSlam::sees_enough() const {
  return inliers_ >= options_.least_inliers &&
         inliers_ >= options_.least_share * static_cast<double>(looks_.size());
}

// A carrier does not go on as it moved for the third of a second that a leap takes: how it turns
// meanwhile is seen in the pictures as wholes.
void MonoSlam::feel_turning(const MonoInput& input, double seconds) {
  constexpr double kUnevenness = 0.1;  // of the distance of what is seen
  if (!input.control || seconds <= 0) return;
  const CameraState& camera = filter_.camera_state();
  const Eigen::Quaterniond commanded = input.control->before_from_after.rotation();
  const auto seen = turn_meter_.measure(commanded * so3_exp(seconds * camera.angular_velocity));
  if (!seen) return;
  Turning turning;
  turning.rate = so3_log(commanded.conjugate() * seen->before_from_after) / seconds;
  turning.axis = 0.5 * (Vector3d::UnitZ() + commanded.conjugate() * Vector3d::UnitZ());
  turning.inverse_distance = background_inverse_distance();
  const double commanded_sigma = input.control->rotation_sigma / seconds;
  const double parallax = kUnevenness * turning.inverse_distance * camera.velocity.norm();
  turning.covariance = seen->covariance / (seconds * seconds);
  turning.covariance.diagonal().array() += commanded_sigma * commanded_sigma + parallax * parallax;
  filter_.observe_turning(turning);
}

// Of the farthest tenth of the map: points are mostly on things, pictures mostly of what is behind.
double MonoSlam::background_inverse_distance() const {
  std::vector<double> inverse;
  const Vector3d& camera = filter_.camera_state().position;
  for (const Landmark& landmark : landmarks_) {
    const Point& point = filter_.point(landmark.id);
    if (point.kind == PointKind::position)
      inverse.push_back(1 / std::max((point.position() - camera).norm(), options_.nearest));
  }
  if (inverse.empty()) return 1 / options_.stated_distance;
  const auto far = inverse.begin() + static_cast<std::ptrdiff_t>(inverse.size() / 10);
  std::nth_element(inverse.begin(), far, inverse.end());
  return *far;
}

// Whether a command has turned the camera to where little is mapped: then nothing is missing, and
// the few points that are expected, at the old map's edge, may be anywhere.
bool MonoSlam::turned_away(Timestamp now) {
  if (inliers_ >= options_.least_inliers) leapt_at_.reset();
  return excused(now) && static_cast<int>(looks_.size()) < options_.visible_points / 3;
}

bool MonoSlam::excused(Timestamp now) const {
  return leapt_at_ && seconds_from_timestamp(now - *leapt_at_) < options_.leap_patience;
}

int MonoSlam::count_inliers() const {
  return static_cast<int>(std::count_if(looks_.begin(), looks_.end(), [](const Look& look) {
    return look.outcome == Outcome::measured;
  }));
}

void MonoSlam::find_again() {
  std::vector<KnownPoint> known;
  for (const Landmark& landmark : landmarks_) {
    if (filter_.point(landmark.id).kind == PointKind::ray) continue;
    known.push_back({&landmark, filter_.point(landmark.id).position()});
  }
  const auto found =
      relocalise(image_, camera_, known, options_.rules, options_.relocaliser, &random_);
  if (!found) return;
  // Generous, and unrelated to the map: the measurements of this frame relate them.
  constexpr double kUnknownPosition = 0.05;  // m
  constexpr double kUnknownTurn = 0.05;      // rad
  CameraState camera;
  camera.position = found->world_from_camera.translation();
  camera.rotation = found->world_from_camera.rotation();
  Matrix6d pose = Matrix6d::Zero();
  pose.diagonal().head<3>().setConstant(kUnknownPosition * kUnknownPosition);
  pose.diagonal().tail<3>().setConstant(kUnknownTurn * kUnknownTurn);
  CameraCovariance covariance = camera_covariance(pose);
  camera.readout = filter_.camera_state().readout;  // the shutter is the same
  covariance(kReadoutRow, kReadoutRow) = filter_.camera_covariance()(kReadoutRow, kReadoutRow);
  filter_.replace_camera(camera, covariance);
  for (const Relocalisation::Confirmed& seen : found->confirmed) {
    const auto prediction = filter_.predict(seen.id);
    if (!prediction || static_cast<int>(looks_.size()) >= Filter::kMostMeasurements) continue;
    const auto landmark = std::lower_bound(landmarks_.begin(), landmarks_.end(), seen.id,
                                           [](const Landmark& l, PointId id) { return l.id < id; });
    Look look{static_cast<std::size_t>(landmark - landmarks_.begin()), *prediction};
    look.measured = seen.pixel;
    looks_.push_back(look);
  }
  std::vector<Look*> group;
  std::vector<Measurement> measurements;
  for (Look& look : looks_) {
    group.push_back(&look);
    measurements.push_back({look.prediction, *look.measured});
  }
  take(group, measurements, options_.least_inliers);
  inliers_ = count_inliers();
  poor_frames_ = 0;
  leapt_at_.reset();
  state_ = TrackingState::relocalised;
}

void MonoSlam::forget_target() {
  for (std::size_t i = landmarks_.size(); i-- > 0;) {
    if (landmarks_[i].of_target) erase(i);
  }
}

SparseMap MonoSlam::map() const {
  SparseMap out;
  out.camera = camera_;
  std::vector<PointId> ids;
  for (const Landmark& landmark : landmarks_) {
    const Point& point = filter_.point(landmark.id);
    if (point.kind != PointKind::position) continue;
    ids.push_back(landmark.id);
    out.landmarks.push_back(landmark);
    out.points_in_world.push_back(point.position());
  }
  out.covariance = filter_.joint_covariance(ids);
  return out;
}

void MonoSlam::enter(const SparseMap& map) {
  filter_.start(CameraState(), camera_covariance(Matrix6d::Identity()));
  const std::vector<PointId> ids = filter_.add_map(map.points_in_world, map.covariance);
  landmarks_.assign(map.landmarks.begin(),
                    map.landmarks.begin() + static_cast<std::ptrdiff_t>(ids.size()));
  for (std::size_t i = 0; i < ids.size(); ++i) landmarks_[i].id = ids[i];
  scale_ = ScaleFrom::map;
  state_ = TrackingState::lost;
}

MonoResult MonoSlam::result(const MonoInput& input) const {
  MonoResult out;
  out.time = input.time;
  out.frame = frame_;
  out.state = state_;
  out.scale = scale_;
  out.target = target_sight_;
  out.inliers = inliers_;
  out.visible = static_cast<int>(looks_.size());
  out.pose_seen =
      state_ != TrackingState::initialising && state_ != TrackingState::lost && sees_enough();
  if (state_ == TrackingState::initialising) return out;
  out.world_from_camera = filter_.camera_state().world_from_camera();
  out.pose_covariance = filter_.camera_covariance().topLeftCorner<kPoseRows, kPoseRows>();
  out.velocity = filter_.camera_state().velocity;
  out.trace = filter_.trace();
  for (const Landmark& landmark : landmarks_) {
    const Point& point = filter_.point(landmark.id);
    MapPoint shown;
    shown.id = landmark.id;
    shown.kind = point.kind;
    shown.of_target = landmark.of_target;
    shown.attempts = landmark.attempts;
    shown.successes = landmark.successes;
    shown.covariance = filter_.position_covariance(landmark.id);
    if (landmark.particles) {
      shown.position = point.at(landmark.particles->mean());
      for (const DepthParticle& p : landmark.particles->particles()) {
        shown.particles.emplace_back(point.at(p.distance), p.weight);
      }
    } else {
      shown.position = point.position();
    }
    out.points.push_back(std::move(shown));
  }
  // looks_ refers to landmarks by id: their places may have changed since.
  for (const Look& look : looks_) {
    const auto shown = std::lower_bound(out.points.begin(), out.points.end(), look.prediction.id,
                                        [](const MapPoint& p, PointId id) { return p.id < id; });
    if (shown == out.points.end() || shown->id != look.prediction.id) continue;
    shown->outcome = look.outcome;
    shown->predicted = look.prediction.sighting.pixel;
    shown->innovation_covariance = look.prediction.covariance;
    shown->measured = look.measured;
    shown->innovation = look.innovation;
    if (look.outcome != Outcome::measured) continue;
    const auto now = sighting(camera_, filter_.camera_state(), filter_.point(look.prediction.id));
    if (now) shown->residual = (*look.measured - now->pixel).norm();
  }
  return out;
}

}  // namespace armsreach::mono_slam
