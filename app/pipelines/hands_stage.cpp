#include "app/pipelines/hands_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/pipelines/background.hpp"
#include "vision/gesture/pointing.hpp"

namespace armsreach::app {
namespace {

constexpr double kPointedWindow = 0.25;  // s over which a thing must be what is mostly pointed at
constexpr double kCursorReach = 0.3;     // sizes of the hand between a cursor and what it means
constexpr int kSampleStep = 16;          // px between the pixels that are looked at for colour
constexpr int kGreyLevels = 4;           // by which the channels of a grey image may differ

bool has_color(const cv::Mat& image) {
  if (image.type() != CV_8UC3) return false;
  for (int y = 0; y < image.rows; y += kSampleStep) {
    const auto* row = image.ptr<cv::Vec3b>(y);
    for (int x = 0; x < image.cols; x += kSampleStep) {
      const auto [low, high] = std::minmax({row[x][0], row[x][1], row[x][2]});
      if (high - low > kGreyLevels) return true;
    }
  }
  return false;
}

FaultEvent no_color() {
  return {"hands", "the images have no colour, so no hands can be found",
          "switch the camera to colour, or leave 'wearable' out of --experience"};
}

double size_of(const gesture::Hand& hand) { return std::sqrt(std::max(hand.seen.area, 1.0)); }

std::vector<gesture::Pointable> pointables(const gesture::ColorBlobs& things) {
  std::vector<gesture::Pointable> all;
  for (const gesture::ColorBlob& thing : things)
    all.push_back({thing.center, std::sqrt(thing.area / std::numbers::pi)});
  return all;
}

std::optional<std::size_t> meant_by(const gesture::Hand& hand,
                                    const std::vector<gesture::Pointable>& things) {
  if (hand.cursor) return gesture::under_cursor(*hand.cursor, kCursorReach * size_of(hand), things);
  if (hand.direction) return gesture::in_wedge({hand.seen.center, *hand.direction}, things);
  return std::nullopt;
}

}  // namespace

HandsStage::HandsStage(HandsSetup setup)
    : detectors_(std::move(setup.detectors)),
      inference_(setup.inference),
      pointed_at_(kPointedWindow) {}

HandsOutput HandsStage::process(const TrackedFramePtr& tracked) {
  HandsOutput out;
  out.seen.tracked = tracked;
  if (!tracked) return out;
  const Frame& frame = *tracked->frame;
  auto state = std::make_shared<HandsState>();
  state->rings = detectors_.rings;
  const bool colorless = !has_color(frame.color);
  if (std::exchange(colorless_, colorless) != colorless && colorless)
    out.news.events.push_back({frame.time, no_color()});

  Sighting sighting;
  if (!colorless) sighting = detectors_.look(frame);
  gesture::Gestures gestures = inference_.update(sighting.hands, frame.time);
  state->hands = std::move(gestures.hands);
  state->things = std::move(sighting.things);
  tell_gestures(*state, frame.time, &out.news.events);
  find_held(*tracked, state.get(), &out.news.events);
  find_highlighted(*tracked, state.get(), &out.news.events);
  for (const gesture::HandAction& action : gestures.actions)
    out.news.commands.push_back({action.action, ray_through(*tracked, action.pixel)});
  out.seen.hands = std::move(state);
  return out;
}

void HandsStage::tell_gestures(const HandsState& state, Timestamp time, Events* events) {
  std::map<int, std::string> now;
  for (const gesture::Hand& hand : state.hands) {
    now[hand.id] = hand.gesture;
    if (hand.gesture == told_[hand.id]) continue;
    events->push_back(
        {time, GestureEvent{hand.id, hand.gesture, hand.score, hand.seen.center, hand.seen.angle}});
  }
  for (const auto& [id, gesture] : told_) {
    if (now.count(id) || gesture.empty()) continue;
    events->push_back({time, GestureEvent{id, "", 0, Eigen::Vector2d::Zero(), 0}});
  }
  told_ = std::move(now);
}

void HandsStage::find_held(const TrackedFrame& tracked, HandsState* state, Events* events) {
  std::optional<gesture::HandObservation> hand;
  if (!state->hands.empty()) hand = state->hands.front().seen;
  const std::optional<gesture::ColorBlob>& held = held_.update(state->things, hand);
  state->held = held ? held->name : "";
  if (std::exchange(held_told_, state->held) == state->held || !held) return;
  events->push_back({tracked.frame->time, LabelEvent{held->name, held->center,
                                                     point_in_world_at(tracked, held->center)}});
}

void HandsStage::find_highlighted(const TrackedFrame& tracked, HandsState* state, Events* events) {
  std::string meant;
  const std::vector<gesture::Pointable> things = pointables(state->things);
  for (const gesture::Hand& hand : state->hands) {
    const auto index = meant_by(hand, things);
    if (index && meant.empty()) meant = state->things[*index].name;
  }
  const std::string before = pointed_at_.mode().name;
  state->highlighted = pointed_at_.update(meant, 0, tracked.frame->time).name;
  if (state->highlighted.empty() || state->highlighted == before) return;
  for (const gesture::ColorBlob& thing : state->things) {
    if (thing.name != state->highlighted) continue;
    events->push_back(
        {tracked.frame->time,
         HighlightEvent{thing.name, thing.center, point_in_world_at(tracked, thing.center)}});
    return;
  }
}

}  // namespace armsreach::app
