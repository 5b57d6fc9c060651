#include "vision/gesture/gesture_table.hpp"

#include <algorithm>
#include <set>

#include <yaml-cpp/yaml.h>

namespace armsreach::gesture {
namespace {

constexpr double kLongestWait = 10;  // s
constexpr std::size_t kMostStates = 64;
constexpr std::size_t kMostTransitions = 1024;

// Travels as an exception inside the reader, as yaml-cpp's own do, and leaves it as an Error.
struct Complaint {
  std::string what;
};

void refuse_others(const YAML::Node& map, const std::set<std::string>& known,
                   const std::string& path) {
  if (!map.IsMap()) throw Complaint{"'" + path + "' is not a map of keys and values"};
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (!known.count(key)) throw Complaint{"unknown key '" + key + "' in '" + path + "'"};
  }
}

std::string text_of(const YAML::Node& node, const std::string& path) {
  if (!node || !node.IsScalar() || node.Scalar().empty())
    throw Complaint{"'" + path + "' must be a name"};
  return node.Scalar();
}

bool flag_of(const YAML::Node& node, const std::string& path) {
  bool flag = false;
  if (node && !YAML::convert<bool>::decode(node, flag))
    throw Complaint{"'" + path + "' must be true or false"};
  return flag;
}

std::size_t state_of(const GestureTable& table, const std::string& state, const std::string& path) {
  for (std::size_t i = 0; i < table.states.size(); ++i) {
    if (table.states[i].name == state) return i;
  }
  throw Complaint{"'" + path + "' names the state '" + state + "', which is not in 'states'"};
}

std::vector<std::size_t> states_of(const GestureTable& table, const YAML::Node& node,
                                   const std::string& path) {
  std::vector<std::size_t> states;
  if (node && node.IsScalar() && node.Scalar() == "*") {
    for (std::size_t i = 0; i < table.states.size(); ++i) states.push_back(i);
  } else if (node && node.IsSequence()) {
    for (const YAML::Node& item : node)
      states.push_back(state_of(table, text_of(item, path), path));
  } else {
    states.push_back(state_of(table, text_of(node, path), path));
  }
  return states;
}

std::optional<Action> action_of(const YAML::Node& node, const std::string& path) {
  if (!node) return std::nullopt;
  const std::string text = text_of(node, path);
  for (const Action action : {Action::select, Action::accept, Action::reject}) {
    if (text == name(action)) return action;
  }
  throw Complaint{"'" + path + "' must be select, accept or reject"};
}

double seconds_of(const YAML::Node& node, const std::string& path) {
  double seconds = 0;
  if (node &&
      (!YAML::convert<double>::decode(node, seconds) || !(seconds >= 0) || seconds > kLongestWait))
    throw Complaint{"'" + path + "' must be between 0 and 10 seconds"};
  return seconds;
}

void read_states(const YAML::Node& list, GestureTable* table) {
  if (!list || !list.IsSequence() || list.size() == 0 || list.size() > kMostStates)
    throw Complaint{"'states' must be a list of 1 to 64 states"};
  for (const YAML::Node& item : list) {
    const std::string path = "states[" + std::to_string(table->states.size()) + "]";
    refuse_others(item, {"name", "cursor", "direction"}, path);
    GestureTable::State state;
    state.name = text_of(item["name"], path + ".name");
    state.cursor = flag_of(item["cursor"], path + ".cursor");
    state.direction = flag_of(item["direction"], path + ".direction");
    for (const GestureTable::State& other : table->states) {
      if (other.name == state.name) throw Complaint{"there are two states '" + state.name + "'"};
    }
    table->states.push_back(state);
  }
}

void read_transitions(const YAML::Node& list, GestureTable* table) {
  if (!list || !list.IsSequence() || list.size() > kMostTransitions)
    throw Complaint{"'transitions' must be a list of at most 1024 transitions"};
  for (const YAML::Node& item : list) {
    const std::string path = "transitions[" + std::to_string(table->transitions.size()) + "]";
    refuse_others(item, {"from", "on", "after", "to", "do"}, path);
    GestureTable::Transition transition;
    transition.from = states_of(*table, item["from"], path + ".from");
    transition.on = text_of(item["on"], path + ".on");
    transition.after = seconds_of(item["after"], path + ".after");
    transition.to = state_of(*table, text_of(item["to"], path + ".to"), path + ".to");
    transition.action = action_of(item["do"], path + ".do");
    table->transitions.push_back(transition);
  }
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
  try {
    const YAML::Node root = YAML::Load(in);
    refuse_others(root, {"states", "transitions"}, "the table");
    GestureTable table;
    read_states(root["states"], &table);
    read_transitions(root["transitions"], &table);
    return table;
  } catch (const Complaint& complaint) {
    return Error{complaint.what, where, remedy};
  } catch (const YAML::Exception& e) {
    return Error{"not readable as YAML: " + std::string(e.what()), where, remedy};
  }
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
