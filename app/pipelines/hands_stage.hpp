// The wearer's hands in a frame: found, followed over time, and what they point at.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "app/interaction/hand_interaction.hpp"
#include "app/runtime/stage.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/gesture/color_blobs.hpp"
#include "vision/gesture/gesture_inference.hpp"

namespace armsreach::app {

// What is seen in one image.
struct Sighting {
  gesture::HandObservations hands;
  gesture::ColorBlobs things;  // known by their colours; none where no colours are known
};

struct HandDetectors {
  std::function<Sighting(const Frame&)> look;  // at a frame that has colours
  std::vector<double> rings;                   // radii to be shown, in roots of a hand's area
};

struct HandsSetup {
  HandDetectors detectors;
  gesture::InferenceOptions inference;
};

struct HandsState {
  std::vector<gesture::Hand> hands;  // the established ones
  // Skin that has made no gesture: a hand that does something else, or a wall.
  std::vector<gesture::Hand> unproven;
  gesture::ColorBlobs things;
  std::optional<std::size_t> held;         // of the things: the one in a hand
  std::optional<std::size_t> highlighted;  // the one that is pointed at
  std::vector<double> rings;               // as of the detectors
};
using HandsStatePtr = std::shared_ptr<const HandsState>;

// What must not be lost when a frame is skipped.
struct HandNews {
  Events events;
  std::vector<HandCommand> commands;
};

// A frame with its pose, and with its hands where somebody looks for them.
struct SeenFrame {
  TrackedFramePtr tracked;  // null where a stage failed on it and has said so
  HandsStatePtr hands;
};

struct HandsOutput {
  SeenFrame seen;
  HandNews news;
};

class HandsStage final : public Stage<TrackedFramePtr, HandsOutput> {
 public:
  explicit HandsStage(HandsSetup setup);
  std::string name() const override { return "hands"; }
  HandsOutput process(const TrackedFramePtr& tracked) override;

 private:
  void find_held(const TrackedFrame& tracked, HandsState* state, Events* events);
  void find_highlighted(const TrackedFrame& tracked, HandsState* state, Events* events);
  void tell_gestures(const HandsState& state, Timestamp time, Events* events);

  HandDetectors detectors_;
  gesture::GestureInference inference_;
  gesture::HeldThing held_;
  gesture::ModalFilter pointed_at_;
  Eigen::Vector2d pointed_place_{0, 0};  // px, centre of the thing that was pointed at last
  std::map<int, std::string> told_;      // gesture of each hand
  std::string held_told_;
  bool colorless_ = false;
};

}  // namespace armsreach::app
