#include "devices/sim/infrared/infrared_source.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "devices/sim/infrared/infrared_hand.hpp"
#include "devices/sim/infrared/infrared_sensor.hpp"
#include "devices/sim/infrared/infrared_view.hpp"
#include "devices/sim/random.hpp"
#include "devices/truth.hpp"
#include "vision/core/time.hpp"

namespace armsreach::sim {
namespace {

constexpr std::uint64_t kForInfrared = 101;  // what the seed is for; others are in sim_source.cpp

SensorInfoPtr sensor_info(const InfraredDescription& infrared, const SimOptions& options) {
  auto info = std::make_shared<SensorInfo>();
  info->name = options.sensor_name;
  info->color_camera = infrared.camera;
  info->rate = infrared.rate;
  return info;
}

MarkerTruth truth_of(const TapePiece& piece_in_camera, const Camera& camera,
                     const Pose& world_from_camera) {
  MarkerTruth truth;
  truth.name = piece_in_camera.name;
  truth.centre_in_world = world_from_camera * piece_in_camera.centre;
  truth.centre = project(camera, piece_in_camera.centre);
  for (const Eigen::Vector3d& corner : piece_in_camera.corners) {
    truth.corners_in_world.push_back(world_from_camera * corner);
    if (const auto pixel = project(camera, corner)) truth.corners.push_back(*pixel);
  }
  if (truth.corners.size() < piece_in_camera.corners.size()) truth.corners.clear();
  const Eigen::Vector3d back = -piece_in_camera.centre.normalized();
  truth.incidence = std::acos(std::clamp(piece_in_camera.normal.dot(back), -1.0, 1.0));
  return truth;
}

class SimInfraredSource final : public InfraredSource {
 public:
  SimInfraredSource(const World& world, const SimOptions& options)
      : options_(options),
        infrared_(*world.infrared),
        duration_(world.path.duration),
        closed_(world.path.closed),
        info_(sensor_info(infrared_, options)),
        hand_(world.hands.front(), infrared_),
        view_(world, infrared_),
        sensor_(infrared_.camera, infrared_.noise, mixed(options.seed, kForInfrared)) {}

  const SensorInfoPtr& sensor() const override { return info_; }
  void stop() override { stopped_ = true; }
  std::optional<std::int64_t> frame_count() const override {
    if (options_.frames) return options_.frames;
    if (options_.endless) return std::nullopt;
    return static_cast<std::int64_t>(std::ceil(duration_ / options_.speed * infrared_.rate - 1e-9));
  }

  Result<FramePtr> next() override {
    const auto count = frame_count();
    if (stopped_ || (count && index_ >= *count)) return FramePtr();
    const double time = static_cast<double>(index_) / infrared_.rate;
    draw(options_.speed * time);
    auto frame = std::make_shared<Frame>();
    frame->index = index_;
    frame->time = timestamp_from_seconds(time);
    frame->color = sensor_.measure(view_.light(), index_);
    frame->sensor = info_;
    frame->world_from_camera = infrared_.world_from_camera;
    frame->truth = common_truth_;
    ++index_;
    return FramePtr(std::move(frame));
  }

  const InfraredTruth& truth() const override { return truth_; }

 private:
  void draw(double path_time) {
    // Around a closed path the script begins anew, as for the world's other sensors.
    const double time =
        closed_ ? path_time - duration_ * std::floor(path_time / duration_) : path_time;
    const InfraredHand::Moment moment = hand_.at(time);
    view_.clear();
    view_.draw_hand(hand_, moment);
    const Pose& world_from_camera = infrared_.world_from_camera;
    const Pose camera_from_hand = world_from_camera.inverse() * moment.world_from_hand;
    truth_ = {};
    truth_.world_from_camera = world_from_camera;
    truth_.camera_from_hand = camera_from_hand;
    if (infrared_.bracelet) {
      truth_.camera_from_bracelet = camera_from_hand * moment.skeleton.hand_from_forearm *
                                    forearm_from_bracelet(*infrared_.bracelet);
    }
    if (infrared_.glove) {
      truth_.camera_from_square =
          camera_from_hand * hand_from_square(*infrared_.glove, hand_.surface());
    }
    for (TapePiece piece : moment.worn.tape) {
      piece.move(camera_from_hand);
      truth_.markers.push_back(truth_of(piece, infrared_.camera, world_from_camera));
      truth_.markers.back().visible = view_.draw_tape(piece);
    }
    common_truth_ = common_truth(moment.truth);
  }

  // What every sensor's truth tells.
  std::shared_ptr<const Truth> common_truth(const HandTruth& hand) const {
    auto truth = std::make_shared<Truth>();
    truth->world_from_camera = truth_.world_from_camera;
    TrueHand one;
    one.name = "right hand";
    if (hand.gesture) one.gesture = name(*hand.gesture);
    one.world_from_joint = hand.world_from_joint;
    truth->hands.push_back(one);
    for (const MarkerTruth& marker : truth_.markers)
      truth->markers.push_back({marker.name, marker.centre_in_world, marker.visible});
    return truth;
  }

  SimOptions options_;
  InfraredDescription infrared_;
  double duration_;
  bool closed_;
  SensorInfoPtr info_;
  InfraredHand hand_;
  InfraredView view_;
  InfraredSensor sensor_;
  InfraredTruth truth_;
  std::shared_ptr<const Truth> common_truth_;
  std::int64_t index_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace

std::unique_ptr<InfraredSource> make_infrared_source(const World& world,
                                                     const SimOptions& options) {
  return std::make_unique<SimInfraredSource>(world, options);
}

}  // namespace armsreach::sim
