#include "vision/gesture/gesture_table.hpp"

#include <algorithm>
#include <utility>

#include "vision/core/yaml_map.hpp"

namespace armsreach::gesture {
namespace {

constexpr double kLongestWait = 10;  // s
constexpr std::size_t kMostStates = 64;
constexpr std::size_t kMostTransitions = 1024;

// The state that an entry of `map` names.
std::size_t state_of(const GestureTable& table, const YAML::Node& node, const YamlMap& map,
                     const std::string& key) {
  if (!node.IsScalar()) throw map.complaint(key, "must be the name of a state");
  const std::string& state = node.Scalar();
  for (std::size_t i = 0; i < table.states.size(); ++i) {
    if (table.states[i].name == state) return i;
  }
  throw map.complaint(key, "names the state '" + state + "', which is not in 'states'");
}

std::vector<std::size_t> states_of(const GestureTable& table, YamlMap& map,
                                   const std::string& key) {
  const YAML::Node node = map.need(key);
  std::vector<std::size_t> states;
  if (node.IsScalar() && node.Scalar() == "*") {
    for (std::size_t i = 0; i < table.states.size(); ++i) states.push_back(i);
  } else if (node.IsSequence()) {
    for (const YAML::Node& item : node) states.push_back(state_of(table, item, map, key));
  } else {
    states.push_back(state_of(table, node, map, key));
  }
  return states;
}

std::optional<Action> action_of(YamlMap& map) {
  if (!map.find("do")) return std::nullopt;
  const std::string text = map.text("do");
  for (const Action action : {Action::select, Action::accept, Action::reject}) {
    if (text == name(action)) return action;
  }
  throw map.complaint("do", "must be select, accept or reject");
}

GestureTable::State state_from(YamlMap map) {
  map.expect({"name", "cursor", "direction"});
  return {map.text("name"), map.flag("cursor"), map.flag("direction")};
}

GestureTable::Transition transition_from(const GestureTable& table, YamlMap map) {
  map.expect({"from", "on", "after", "to", "do"});
  GestureTable::Transition transition;
  transition.from = states_of(table, map, "from");
  transition.on = map.text("on");
  transition.after = map.number("after", 0, kLongestWait, 0);
  transition.to = state_of(table, map.need("to"), map, "to");
  transition.action = action_of(map);
  return transition;
}

GestureTable table_from(const YAML::Node& root) {
  YamlMap map(root, "");
  map.expect({"states", "transitions"});
  const YAML::Node states = map.find("states");
  if (!states.IsSequence() || states.size() == 0 || states.size() > kMostStates)
    throw map.complaint("states", "must be a list of 1 to 64 states");
  const YAML::Node transitions = map.find("transitions");
  if (!transitions.IsSequence() || transitions.size() > kMostTransitions)
    throw map.complaint("transitions", "must be a list of at most 1024 transitions");
  GestureTable table;
  for (const YamlMap& entry : map.items("states")) {
    GestureTable::State state = state_from(entry);
    const auto same = [&](const GestureTable::State& other) { return other.name == state.name; };
    if (std::any_of(table.states.begin(), table.states.end(), same))
      throw entry.complaint("there are two states '" + state.name + "'");
    table.states.push_back(std::move(state));
  }
  for (const YamlMap& entry : map.items("transitions"))
    table.transitions.push_back(transition_from(table, entry));
  return table;
}

}  // namespace

std::string_view name(Action action) {
  switch (action) {
    case Action::select:
      return "select";
    case Action::accept:
      return "accept";
    case Action::reject:
      return "reject";
  }
  return "";
}

bool has_cursor(const GestureTable& table, const std::string& gesture) {
  return std::any_of(table.transitions.begin(), table.transitions.end(),
                     [&](const auto& t) { return t.on == gesture && table.states[t.to].cursor; });
}

Result<GestureTable> read_gesture_table(std::istream& in, const std::string& where) {
  const char* remedy =
      "tables have states: [{name, cursor, direction}] and "
      "transitions: [{from, on, after, to, do}]";
  return read_yaml(in, where, remedy, table_from);
}

std::optional<Action> GestureMachine::step(const std::string& shown, Timestamp time) {
  if (shown != shown_) {
    shown_ = shown;
    since_ = time;
  }
  const double lasted = seconds_from_timestamp(time - since_);
  for (const GestureTable::Transition& transition : table_->transitions) {
    if (transition.to == state_ || transition.on != shown || lasted < transition.after) continue;
    if (!std::count(transition.from.begin(), transition.from.end(), state_)) continue;
    state_ = transition.to;
    return transition.action;
  }
  return std::nullopt;
}

}  // namespace armsreach::gesture
