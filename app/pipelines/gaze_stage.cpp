#include "app/pipelines/gaze_stage.hpp"

#include <cmath>

#include "app/pipelines/background.hpp"
#include "vision/gesture/pointing.hpp"
#include "vision/mono_slam/mono_slam.hpp"

namespace armsreach::app {
namespace {

constexpr const char* kColor = "colour:";
constexpr const char* kPoint = "point:";
constexpr const char* kObject = "object:";
constexpr double kSeenReach = 10;  // m, of what is looked at because it is seen
// m: an aim that the map's corrections have moved so far is taken anew.
constexpr double kMoved = 0.005;
constexpr double kGraspReach = 2;  // sizes of the hand to where a grasp points, if at no thing

std::optional<Eigen::Vector2d> thing_named(const HandsState& hands, const std::string& name) {
  for (const gesture::ColorBlob& thing : hands.things) {
    if (thing.name == name) return thing.center;
  }
  return std::nullopt;
}

// What a grasping hand points at; a hand that does not grasp is followed itself.
std::optional<Eigen::Vector2d> grasp_target(const HandsState& hands) {
  for (const gesture::Hand& hand : hands.hands) {
    if (!hand.direction) continue;
    if (hands.highlighted) return hands.things[*hands.highlighted].center;
    const gesture::Wedge wedge{hand.seen.center, *hand.direction};
    return wedge.origin + kGraspReach * std::sqrt(hand.seen.area) * wedge.axis();
  }
  if (hands.hands.empty()) return std::nullopt;
  return hands.hands.front().seen.center;
}

std::optional<std::int64_t> number_after(const std::string& prefix, const std::string& text) {
  if (text.rfind(prefix, 0) != 0) return std::nullopt;
  return std::stoll(text.substr(prefix.size()));
}

std::optional<Eigen::Vector3d> mapped_point(const TrackedFrame& tracked, std::int64_t id) {
  if (!tracked.mono) return std::nullopt;
  for (const mono_slam::MapPoint& point : tracked.mono->points) {
    if (point.id == id) return point.position;
  }
  return std::nullopt;
}

GazeSettings settings_for(const Eigen::Vector3d& up_in_world) {
  GazeSettings settings;
  if (!up_in_world.isZero()) settings.up_in_world = up_in_world;
  return settings;
}

}  // namespace

GazeStage::GazeStage(const GazeConfig& config, const GimbalModel& model, const Camera& camera,
                     const Eigen::Vector3d& up_in_world, double delay)
    : config_(config),
      delay_(timestamp_from_seconds(delay)),
      controller_(model, camera, settings_for(up_in_world)),
      watch_(camera) {
  if (config.mode == "follow" || config.mode == "auto") controller_.follow(config.target);
  if (config.mode == "stabilise") controller_.stabilise();
}

GazeOutput GazeStage::process(const GazeStageInput& input) {
  if (!input.seen.tracked) return {};
  const TrackedFrame& tracked = *input.seen.tracked;
  GazeInput news;
  const Timestamp taken = tracked.frame->time;
  news.now = taken + delay_;
  news.gimbal = input.gimbal;
  if (pose_known(tracked)) news.pose = CameraPoseSeen{taken, tracked.world_from_camera};
  if (config_.mode == "saccade" || config_.mode == "fixate") {
    aim(input);
  } else if (controller_.mode() == GazeMode::follow) {
    if (const auto pixel = followed(input.seen)) news.target = TargetSeen{taken, *pixel, {}};
  }
  GazeOutput out;
  out.command = std::make_shared<GimbalCommand>(controller_.step(news));
  out.events = controller_.take_events();
  return out;
}

// Once it is known where; and again when that has moved.
void GazeStage::aim(const GazeStageInput& input) {
  const bool seen_only = !config_.point_in_world && config_.target.rfind(kPoint, 0) != 0 &&
                         config_.target.rfind(kObject, 0) != 0;
  if (aimed_at_ && (seen_only || config_.point_in_world)) return;
  const auto point = point_in_world(input);
  if (!point || (aimed_at_ && (*point - *aimed_at_).norm() < kMoved)) return;
  const std::string name = config_.point_in_world ? "" : config_.target;
  if (!aimed_at_ && config_.mode == "saccade") {
    controller_.saccade_to_world(*point, name);
  } else {
    controller_.fixate_in_world(*point, name);
  }
  aimed_at_ = point;
}

std::optional<Eigen::Vector3d> GazeStage::point_in_world(const GazeStageInput& input) const {
  const TrackedFrame& tracked = *input.seen.tracked;
  if (!pose_known(tracked)) return std::nullopt;
  if (config_.point_in_world) return config_.point_in_world;
  if (const auto id = number_after(kPoint, config_.target)) return mapped_point(tracked, *id);
  if (const auto id = number_after(kObject, config_.target)) {
    if (!input.objects) return std::nullopt;
    const auto place = input.objects->find(*id);
    return place != input.objects->end() ? std::optional(place->second) : std::nullopt;
  }
  const auto pixel = input.seen.hands ? target(*input.seen.hands) : std::nullopt;
  if (!pixel) return std::nullopt;
  if (const auto measured = point_in_world_at(tracked, *pixel)) return measured;
  const auto ray = ray_through(tracked, *pixel);
  return ray && tracked.world ? tracked.world->pick(*ray, kSeenReach) : std::nullopt;
}

// A hand that has made no gesture yet is followed once it has moved.
std::optional<Eigen::Vector2d> GazeStage::followed(const SeenFrame& seen) {
  if (!seen.hands) return std::nullopt;
  const bool any_hand = config_.target == "hand" || config_.target == "hands";
  const auto moving = any_hand ? watch_.update(*seen.hands, *seen.tracked->frame) : std::nullopt;
  const auto proven = target(*seen.hands);
  return proven ? proven : moving;
}

std::optional<Eigen::Vector2d> GazeStage::target(const HandsState& hands) const {
  if (config_.target.rfind(kColor, 0) == 0)
    return thing_named(hands, config_.target.substr(std::string(kColor).size()));
  if (config_.target == "grasp") return grasp_target(hands);
  if (config_.target == "hands") return gesture::midpoint(hands.hands);
  if (hands.hands.empty()) return std::nullopt;
  return hands.hands.front().seen.center;
}

}  // namespace armsreach::app
