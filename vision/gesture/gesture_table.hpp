// What gestures mean: a table of states and transitions, read from YAML, that a hand walks through.
// A transition asks for its gesture to last a while, longer to leave a state than to enter it where
// the table says so: that is its hysteresis.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach::gesture {

enum class Action { select, accept, reject };
std::string_view name(Action action);

// What a hand is taken to show, besides the names of gestures.
inline constexpr const char* kNothing = "nothing";  // a hand, but no gesture that can be told
inline constexpr const char* kGone = "gone";        // no hand

struct GestureTable {
  struct State {
    std::string name;
    bool cursor = false;     // the index finger's tip is a cursor
    bool direction = false;  // the hand points along its axis
  };
  struct Transition {
    std::vector<std::size_t> from;  // states
    std::string on;                 // gesture, kNothing or kGone
    double after = 0;               // s that it has been shown
    std::size_t to = 0;
    std::optional<Action> action;
  };
  std::vector<State> states;            // the first is where a hand begins
  std::vector<Transition> transitions;  // the first that fits is taken
};

// Whether a hand that shows `gesture` points with its index finger's tip: the table leads it to a
// state with a cursor.
bool has_cursor(const GestureTable& table, const std::string& gesture);

// `where` names the input in errors. Keys, states and actions that are not known are refused.
Result<GestureTable> read_gesture_table(std::istream& in, const std::string& where);

// One hand's way through a table.
class GestureMachine {
 public:
  explicit GestureMachine(const GestureTable& table) : table_(&table) {}

  // Takes at most one transition; returns its action.
  std::optional<Action> step(const std::string& shown, Timestamp time);
  const GestureTable::State& state() const { return table_->states[state_]; }

 private:
  const GestureTable* table_;  // outlives the machine
  std::size_t state_ = 0;
  std::string shown_;
  Timestamp since_ = 0;  // that `shown_` has been shown
};

}  // namespace armsreach::gesture
