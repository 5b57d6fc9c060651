#include "devices/sim/hand_yaml.hpp"

#include <numbers>

namespace armsreach::sim {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

// One of two words.
bool is_second(YamlMap& map, const std::string& key, const std::string& first,
               const std::string& second) {
  const std::string word = map.text(key);
  if (word != first && word != second)
    throw map.complaint(key, "is neither " + first + " nor " + second);
  return word == second;
}

Gesture gesture_from(YamlMap& map) {
  const std::string pose = map.text("pose");
  const auto gesture = gesture_named(pose);
  if (gesture) return *gesture;
  std::string names;
  for (int i = 0; i < kGestureCount; ++i)
    names += (i ? ", " : "") + std::string(name(static_cast<Gesture>(i)));
  throw map.complaint("pose", "cannot be: there is no '" + pose + "' among " + names);
}

HandKey key_from(YamlMap map) {
  HandKey key;
  key.time = map.number("t", 0, 1e6);
  if (map.find("grip")) {
    key.grip = map.number("grip", 0.004, 0.12);
    key.gesture = Gesture::grasp;
  } else {
    key.gesture = gesture_from(map);
  }
  key.at = map.vector<3>("at");
  if (map.find("turn_deg")) key.turn = kRadians * map.vector<3>("turn_deg");
  if (map.find("wrist_deg")) {
    const Eigen::Vector2d wrist = kRadians * map.vector<2>("wrist_deg");
    key.wrist_flexion = wrist[0];
    key.wrist_deviation = wrist[1];
  }
  if (map.find("hold")) key.hold = map.text("hold");
  if (map.find("on")) key.on = map.text("on");
  map.refuse_others();
  return key;
}

HandDescription hand_from(YamlMap map) {
  HandDescription hand;
  hand.left = is_second(map, "side", "right", "left");
  hand.frame = is_second(map, "frame", "camera", "world") ? HandFrame::world : HandFrame::camera;
  hand.seed = static_cast<std::uint64_t>(map.number("seed", 0, 1e15, 1));
  if (map.find("skin")) {
    const std::string skin = map.text("skin");
    const auto tone = skin_tone_named(skin);
    if (!tone) throw map.complaint("skin", "cannot be: there is no skin '" + skin + "'");
    hand.skin = *tone;
  }
  if (map.find("shoulder")) hand.shoulder = map.vector<3>("shoulder");
  hand.sleeve = static_cast<bool>(map.find("sleeve"));
  if (hand.sleeve) hand.sleeve_color = map.color("sleeve");
  for (const YamlMap& entry : map.items("keys")) {
    const HandKey key = key_from(entry);
    if (!hand.keys.empty() && key.time <= hand.keys.back().time)
      throw entry.complaint("the times of '" + map.path("keys") + "' do not increase");
    hand.keys.push_back(key);
  }
  if (hand.keys.empty()) throw map.complaint("keys", "is empty");
  hand.repeat = map.number("repeat", 0, 1e6, 0);
  if (hand.repeat > 0 && hand.repeat < hand.keys.back().time)
    throw map.complaint("repeat", "comes before the last of its keys");
  map.refuse_others();
  return hand;
}

}  // namespace

std::vector<HandDescription> hands_from(YamlMap& map) {
  std::vector<HandDescription> hands;
  for (const YamlMap& entry : map.items("hands")) hands.push_back(hand_from(entry));
  if (hands.empty()) throw map.complaint("hands", "is empty: leave it out for no hands");
  return hands;
}

Result<std::vector<HandDescription>> read_hand_script(std::istream& in, const std::string& where) {
  const std::string remedy = "assets/hands/gestures.yaml shows what a script can have";
  return read_yaml(in, where, remedy, [](const YAML::Node& root) {
    YamlMap map(root, "");
    std::vector<HandDescription> hands = hands_from(map);
    map.refuse_others();
    for (const HandDescription& hand : hands) {
      for (const HandKey& key : hand.keys) {
        if (!key.on.empty() || !key.hold.empty())
          throw map.complaint("'on' and 'hold' need a world, whose things are known");
      }
    }
    return hands;
  });
}

}  // namespace armsreach::sim
