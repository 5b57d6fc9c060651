#include "app/evaluation/gaze_trial.hpp"

#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "devices/truth.hpp"
#include "vision/gaze/gaze_controller.hpp"

namespace armsreach::app {
namespace {

using Eigen::Vector3d;

Vector3d middle_of(const TrueHand& hand) {
  Vector3d sum = Vector3d::Zero();
  for (const Pose& joint : hand.world_from_joint) sum += joint.translation();
  return sum / static_cast<double>(hand.world_from_joint.size());
}

// A thing's place, or a hand's: "hand" is any.
Result<Vector3d> place_of(const Truth& truth, const std::string& name) {
  for (const TrueHand& hand : truth.hands)
    if (hand.name == name || name == "hand") return middle_of(hand);
  std::string known;
  for (const TrueThing& thing : truth.things) {
    if (thing.name == name) return thing.world_from_thing.translation();
    known += (known.empty() ? "" : ", ") + thing.name;
  }
  for (const TrueHand& hand : truth.hands) known += ", " + hand.name;
  return Error{"there is no '" + name + "' to look at", "--target", "there are " + known};
}

bool in_central_half(const Camera& camera, const Vector3d& target_in_camera) {
  const auto pixel = project(camera, target_in_camera);
  return pixel && std::abs(pixel->x() - camera.cx) < 0.25 * camera.width &&
         std::abs(pixel->y() - camera.cy) < 0.25 * camera.height;
}

class Loop {
 public:
  Loop(const GazeTrial& trial, Gimbal& gimbal, const Camera& camera)
      : trial_(trial), gimbal_(gimbal), camera_(camera), controller_(gimbal.model(), camera) {}

  Status take(const Frame& frame) {
    if (!frame.truth || !frame.truth->gimbal) {
      return Error{"there is no truth about a gimbal", "--source",
                   "take a simulated source, such as sim:gaze,mount=shoulder,gimbal=yes"};
    }
    auto target = target_at(*frame.truth, seconds_from_timestamp(frame.time));
    if (!target) return target.error();
    sample(frame, *target);
    under_way_.push_back(measurements(frame, *target));
    GazeInput input;
    if (frame.time - under_way_.front().now >= timestamp_from_seconds(trial_.delay - 1e-6)) {
      input = under_way_.front();
      under_way_.pop_front();
    }
    input.now = frame.time;
    input.gimbal = gimbal_.state_at(frame.time);
    return gimbal_.command(controller_.step(input));
  }

  GazeRun finish() && {
    run_.half_width = std::atan(0.5 * camera_.width / camera_.fx);
    run_.events = controller_.take_events();
    return std::move(run_);
  }

 private:
  // Where the target of this time is; tells the controller when it is another one.
  Result<Vector3d> target_at(const Truth& truth, double time) {
    const bool leaps = trial_.mode == GazeMode::saccade;
    const int saccade = leaps ? static_cast<int>(time / trial_.interval) : 0;
    const auto count = leaps ? trial_.targets.size() : 1;
    const std::string& name = trial_.targets[static_cast<std::size_t>(saccade) % count];
    auto place = place_of(truth, name);
    if (!place || saccade == saccade_) return place;
    saccade_ = saccade;
    if (trial_.mode == GazeMode::follow) controller_.follow(name);
    if (trial_.mode == GazeMode::fixate) controller_.fixate_in_world(*place, name);
    if (leaps) controller_.saccade_to_world(*place, name);
    return place;
  }

  GazeInput measurements(const Frame& frame, const Vector3d& target) const {
    GazeInput input;
    input.now = frame.time;
    const Pose& world_from_camera = frame.truth->world_from_camera;
    const auto pixel = project(camera_, world_from_camera.inverse() * target);
    input.pose = CameraPoseSeen{frame.time, world_from_camera};
    if (pixel && camera_.contains(*pixel))
      input.target = TargetSeen{frame.time, *pixel, std::nullopt};
    return input;
  }

  void sample(const Frame& frame, const Vector3d& target) {
    const Pose& world_from_camera = frame.truth->world_from_camera;
    const Vector3d in_camera = world_from_camera.inverse() * target;
    GazeSample sample;
    sample.time = seconds_from_timestamp(frame.time);
    sample.saccade = saccade_;
    sample.off = std::atan2(in_camera.head<2>().norm(), in_camera.z());
    sample.bearing = {std::atan2(in_camera.x(), in_camera.z()),
                      std::atan2(in_camera.y(), std::hypot(in_camera.x(), in_camera.z()))};
    sample.central = in_central_half(camera_, in_camera);
    sample.torsion = std::asin((world_from_camera.rotation() * Vector3d::UnitX()).z());
    sample.angles = frame.truth->gimbal->angles;
    const Pose mount_from_camera_now = mount_from_camera(gimbal_.model(), sample.angles);
    sample.direction = (mount_from_camera_now * in_camera).normalized();
    sample.target_in_world = target;
    sample.mount_in_world = (world_from_camera * mount_from_camera_now.inverse()).translation();
    run_.samples.push_back(sample);
  }

  const GazeTrial& trial_;
  Gimbal& gimbal_;
  Camera camera_;
  GazeController controller_;
  std::deque<GazeInput> under_way_;  // `now` is when it was seen
  int saccade_ = -1;
  GazeRun run_;
};

}  // namespace

Result<GazeRun> run_gaze_trial(Rig& rig, const GazeTrial& trial) {
  const RigSensor& sensor = rig.sensors().front();
  const auto gimbal = rig.gimbal_of(sensor.name());
  if (!gimbal) {
    return Error{"the camera has no gimbal", "--source",
                 "for example sim:gaze,mount=shoulder,gimbal=yes"};
  }
  if (trial.targets.empty()) {
    return Error{"nothing was named to look at", "--target", "for example --target hand"};
  }
  Loop loop(trial, *gimbal, sensor.source->sensor()->camera());
  for (;;) {
    auto frame = rig.next();
    if (!frame) return frame.error();
    if (!*frame) return std::move(loop).finish();
    if (auto status = loop.take(**frame); !status) return status.error();
  }
}

}  // namespace armsreach::app
