// The wearer's hands in a frame: found, followed over time, and what they point at.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "app/interaction/hand_interaction.hpp"
#include "app/runtime/stage.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/gesture/gesture_inference.hpp"

namespace armsreach::app {

// A thing known by its colour. Pixels of the colour image.
struct ColoredThing {
  std::string name;
  cv::Rect box;
  double area = 0;  // px^2

  Eigen::Vector2d center() const;
  double radius() const;  // px, of a disc of its area
};

// What looks at one image. `things` may be empty where no colours are known.
struct HandDetectors {
  std::function<gesture::HandObservations(const cv::Mat& bgr)> hands;
  std::function<std::vector<ColoredThing>(const cv::Mat& bgr)> things;
  std::vector<double> rings;  // radii in roots of a hand's area, to be shown
};

struct HandsSetup {
  HandDetectors detectors;
  gesture::InferenceOptions inference;
};

struct HandsState {
  std::vector<gesture::Hand> hands;
  std::vector<ColoredThing> things;
  std::set<std::string> near;  // names of things near a hand
  std::string highlighted;     // name of the thing that is pointed at; or empty
  std::vector<double> rings;   // as of the detectors
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
  void look_for_things(const TrackedFrame& tracked, HandsState* state, Events* events);
  void find_near(const TrackedFrame& tracked, HandsState* state, Events* events);
  void find_highlighted(const TrackedFrame& tracked, HandsState* state, Events* events);
  void tell_gestures(const HandsState& state, Timestamp time, Events* events);

  HandDetectors detectors_;
  gesture::GestureInference inference_;
  std::map<int, std::string> told_;             // gesture of each hand
  std::map<std::string, Timestamp> last_near_;  // of each thing
  gesture::ModalFilter pointed_at_;
  bool colorless_ = false;
};

}  // namespace armsreach::app
