#include "app/pipelines/gaze_stage.hpp"

#include <cmath>

#include "vision/gesture/pointing.hpp"

namespace armsreach::app {
namespace {

constexpr const char* kColor = "colour:";
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

}  // namespace

GazeStage::GazeStage(const GazeConfig& config, const GimbalModel& model, const Camera& camera)
    : target_(config.target), controller_(model, camera) {
  if (config.mode != "rest") controller_.follow(config.target);
}

GazeOutput GazeStage::process(const GazeStageInput& input) {
  if (!input.seen.tracked) return {};
  GazeInput news;
  news.now = input.seen.tracked->frame->time;
  news.gimbal = input.gimbal;
  if (input.seen.hands) {
    if (const auto pixel = target(*input.seen.hands))
      news.target = TargetSeen{news.now, *pixel, {}};
  }
  GazeOutput out;
  out.command = std::make_shared<GimbalCommand>(controller_.step(news));
  out.events = controller_.take_events();
  return out;
}

std::optional<Eigen::Vector2d> GazeStage::target(const HandsState& hands) const {
  if (target_.rfind(kColor, 0) == 0)
    return thing_named(hands, target_.substr(std::string(kColor).size()));
  if (target_ == "grasp") return grasp_target(hands);
  if (target_ == "hands") return gesture::midpoint(hands.hands);
  if (hands.hands.empty()) return std::nullopt;
  return hands.hands.front().seen.center;
}

}  // namespace armsreach::app
