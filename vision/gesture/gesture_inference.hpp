// What the wearer's hands do, over time: who is who, which gesture it is, and what follows from it
// by the transition table (Mayol and others, BMVC 2004, section 3). Deterministic in source time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/time.hpp"
#include "vision/gesture/gesture_table.hpp"
#include "vision/gesture/hand_identity.hpp"
#include "vision/gesture/hand_observation.hpp"
#include "vision/gesture/modal_filter.hpp"
#include "vision/gesture/one_euro.hpp"

namespace armsreach::gesture {

// A hand that is seen in this frame. Pixels of its image.
struct Hand {
  int id = 0;
  HandObservation seen;
  std::string gesture;  // after the modal filter; empty: none
  double score = 0;     // mean g of the frames that agree on it
  // It has made a gesture in the last seconds; else it may be anything of skin's colour.
  bool established = false;
  std::string state;  // of the table
  // px, the index finger's tip, while the state has one and the hand shows it.
  std::optional<Eigen::Vector2d> cursor;
  std::optional<double> direction;  // rad, 0 up, clockwise, while the state has one
};

struct HandAction {
  int hand = 0;
  Action action = Action::select;
  Eigen::Vector2d pixel{0, 0};  // the cursor, or else the hand's centre
};

struct Gestures {
  std::vector<Hand> hands;  // in order of id
  std::vector<HandAction> actions;
};

struct InferenceOptions {
  double window = 0.25;  // s of the modal filter
  OneEuroOptions cursor;
  GestureTable table;
};

class GestureInference {
 public:
  explicit GestureInference(const InferenceOptions& options) : options_(options) {}
  GestureInference(const GestureInference&) = delete;  // machines point to the table
  GestureInference& operator=(const GestureInference&) = delete;

  Gestures update(const HandObservations& seen, Timestamp time);

 private:
  struct Track {
    ModalFilter filter;
    GestureMachine machine;
    OneEuro filtered_cursor;
    std::optional<Eigen::Vector2d> cursor = {};
    std::optional<Timestamp> gesturing_since = {};
    std::optional<Timestamp> established = {};  // when it was seen to be a hand last
    Eigen::Vector2d last_pixel{0, 0};
  };
  Hand follow(int id, Track& track, const HandObservation& seen, Timestamp time,
              std::vector<HandAction>* actions);
  static bool establish(Track& track, Timestamp time);
  void follow_cursor(Track& track, const HandObservation& seen, Timestamp time) const;

  InferenceOptions options_;
  HandIdentity identity_;
  std::map<int, Track> tracks_;
};

// The midpoint of two hands, or the only hand's centre; nothing without hands.
std::optional<Eigen::Vector2d> midpoint(const std::vector<Hand>& hands);

}  // namespace armsreach::gesture
