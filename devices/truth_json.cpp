#include "devices/truth_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace armsreach {
namespace {

using nlohmann::json;

// Travels as an exception inside this file, as the JSON library's own do.
struct Complaint {
  std::string what;
};

json json_from_vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json json_from_pose(const Pose& pose) {
  const Eigen::Quaterniond& q = pose.rotation();
  return {{"translation", json_from_vector(pose.translation())},
          {"rotation", {q.x(), q.y(), q.z(), q.w()}}};
}

double number_from(const json& value) {
  const double number = value.get<double>();
  if (!std::isfinite(number)) throw Complaint{"a number is not finite"};
  return number;
}

Eigen::Vector3d vector_from(const json& value) {
  if (value.size() != 3) throw Complaint{"a vector has not three numbers"};
  return {number_from(value.at(0)), number_from(value.at(1)), number_from(value.at(2))};
}

Pose pose_from(const json& value) {
  const json& q = value.at("rotation");
  if (q.size() != 4) throw Complaint{"a rotation has not four numbers"};
  const Eigen::Quaterniond rotation(number_from(q.at(3)), number_from(q.at(0)),
                                    number_from(q.at(1)), number_from(q.at(2)));
  if (std::abs(rotation.norm() - 1) > 1e-3) throw Complaint{"a rotation is not a unit quaternion"};
  return {rotation, vector_from(value.at("translation"))};
}

json json_from_hand(const TrueHand& hand) {
  json joints = json::array();
  for (const Pose& joint : hand.world_from_joint) joints.push_back(json_from_pose(joint));
  json out{{"name", hand.name},
           {"mask", hand.mask},
           {"gesture", hand.gesture},
           {"world_from_joint", std::move(joints)}};
  if (!hand.holds.empty()) out["holds"] = hand.holds;
  return out;
}

TrueHand hand_from(const json& value) {
  TrueHand hand;
  hand.name = value.at("name").get<std::string>();
  hand.mask = value.at("mask").get<int>();
  hand.gesture = value.at("gesture").get<std::string>();
  hand.holds = value.value("holds", "");
  const json& joints = value.at("world_from_joint");
  if (joints.size() != kTrueHandJoints) throw Complaint{"a hand has not 25 joints"};
  for (std::size_t i = 0; i < kTrueHandJoints; ++i)
    hand.world_from_joint[i] = pose_from(joints.at(i));
  return hand;
}

json json_from_line(const TruthLine& line) {
  const Truth& truth = line.truth;
  json out{{"t", seconds_from_timestamp(line.time)},
           {"world_from_camera", json_from_pose(truth.world_from_camera)}};
  if (!line.depth_file.empty()) out["depth"] = line.depth_file;
  if (!line.masks_file.empty()) out["masks"] = line.masks_file;
  if (truth.gimbal) {
    out["gimbal"] = {{"angles", json_from_vector(truth.gimbal->angles)},
                     {"rates", json_from_vector(truth.gimbal->rates)}};
  }
  for (const TrueThing& thing : truth.things) {
    out["things"].push_back({{"name", thing.name},
                             {"mask", thing.mask},
                             {"world_from_thing", json_from_pose(thing.world_from_thing)}});
  }
  for (const TrueHand& hand : truth.hands) out["hands"].push_back(json_from_hand(hand));
  for (const TrueMarker& marker : truth.markers) {
    out["markers"].push_back({{"name", marker.name},
                              {"point_in_world", json_from_vector(marker.point_in_world)},
                              {"visible", marker.visible}});
  }
  for (const auto& [a, b] : truth.contacts) out["contacts"].push_back(json::array({a, b}));
  return out;
}

TruthLine line_from(const json& in) {
  TruthLine line;
  const double seconds = number_from(in.at("t"));
  if (std::abs(seconds) >= kLatestTime) throw Complaint{"'t' is not a time"};
  line.time = timestamp_from_seconds(seconds);
  line.depth_file = in.value("depth", "");
  line.masks_file = in.value("masks", "");
  Truth& truth = line.truth;
  truth.world_from_camera = pose_from(in.at("world_from_camera"));
  if (in.contains("gimbal")) {
    truth.gimbal = GimbalState{line.time, vector_from(in["gimbal"].at("angles")),
                               vector_from(in["gimbal"].at("rates"))};
  }
  const json none = json::array();
  for (const json& thing : in.value("things", none)) {
    truth.things.push_back({thing.at("name").get<std::string>(), thing.at("mask").get<int>(),
                            pose_from(thing.at("world_from_thing"))});
  }
  for (const json& hand : in.value("hands", none)) truth.hands.push_back(hand_from(hand));
  for (const json& marker : in.value("markers", none)) {
    truth.markers.push_back({marker.at("name").get<std::string>(),
                             vector_from(marker.at("point_in_world")),
                             number_from(marker.at("visible"))});
  }
  for (const json& pair : in.value("contacts", none))
    truth.contacts.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<std::string>());
  return line;
}

}  // namespace

Result<std::vector<TruthLine>> read_truth_lines(std::istream& in, const std::string& where) {
  std::vector<TruthLine> lines;
  std::string text;
  for (int number = 1; std::getline(in, text); ++number) {
    if (text.empty()) continue;
    const std::string place = where + ":" + std::to_string(number);
    const auto complaint = [&](const std::string& what) {
      return Error{what, place, "record again, or remove the file: playing does not need it"};
    };
    try {
      lines.push_back(line_from(json::parse(text)));
    } catch (const Complaint& one) {
      return complaint(one.what);
    } catch (const json::exception& e) {
      return complaint(std::string("not a line of truth: ") + e.what());
    }
    if (lines.size() > 1 && lines.back().time <= lines[lines.size() - 2].time)
      return complaint("time does not increase");
  }
  return lines;
}

void write_truth_line(std::ostream& out, const TruthLine& line) {
  out << json_from_line(line).dump() << '\n';
}

}  // namespace armsreach
