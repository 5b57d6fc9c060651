#include "app/pipelines/hands_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/pipelines/background.hpp"
#include "vision/gesture/has_color.hpp"
#include "vision/gesture/pointing.hpp"

namespace armsreach::app {
namespace {

constexpr double kPointedWindow = 0.25;  // s over which a thing must be what is mostly pointed at
constexpr double kCursorReach = 0.3;     // sizes of the hand between a cursor and what it means

FaultEvent no_color() {
  return {"hands", "hands need a colour camera, and these images are grey",
          "take a colour camera, or switch this one to colour; all else goes on without hands"};
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

// A hand that shows its index finger points at what it touches.
bool may_hold(const gesture::Hand& hand) { return !hand.cursor; }

std::optional<std::size_t> nearest_named(const gesture::ColorBlobs& things, const std::string& name,
                                         const Eigen::Vector2d& place) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].name != name) continue;
    const double distance = (things[i].center - place).norm();
    if (!nearest || distance < (things[*nearest].center - place).norm()) nearest = i;
  }
  return nearest;
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
  const bool colorless = !gesture::has_color(frame.color);
  if (std::exchange(colorless_, colorless) != colorless && colorless)
    out.news.events.push_back({frame.time, no_color()});

  Sighting sighting;
  if (!colorless) sighting = detectors_.look(frame);
  gesture::Gestures gestures = inference_.update(sighting.hands, frame.time);
  std::erase_if(gestures.hands, [](const gesture::Hand& hand) { return !hand.established; });
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
  gesture::HandObservations holding;
  for (const gesture::Hand& hand : state->hands) {
    if (may_hold(hand)) holding.push_back(hand.seen);
  }
  const std::optional<gesture::ColorBlob>& held = held_.update(state->things, holding);
  if (held) state->held = nearest_named(state->things, held->name, held->center);
  const std::string name = held ? held->name : "";
  if (std::exchange(held_told_, name) == name || !held) return;
  events->push_back({tracked.frame->time, LabelEvent{held->name, held->center,
                                                     point_in_world_at(tracked, held->center)}});
}

void HandsStage::find_highlighted(const TrackedFrame& tracked, HandsState* state, Events* events) {
  const std::vector<gesture::Pointable> things = pointables(state->things);
  std::optional<std::size_t> meant;
  for (const gesture::Hand& hand : state->hands) {
    if (!meant) meant = meant_by(hand, things);
  }
  if (meant) pointed_place_ = state->things[*meant].center;
  const std::string before = pointed_at_.mode().name;
  const std::string& name =
      pointed_at_.update(meant ? state->things[*meant].name : "", 0, tracked.frame->time).name;
  if (name.empty()) return;
  state->highlighted = nearest_named(state->things, name, pointed_place_);
  if (name == before || !state->highlighted) return;
  const gesture::ColorBlob& thing = state->things[*state->highlighted];
  pointed_place_ = thing.center;
  events->push_back(
      {tracked.frame->time,
       HighlightEvent{thing.name, thing.center, point_in_world_at(tracked, thing.center)}});
}

}  // namespace armsreach::app
