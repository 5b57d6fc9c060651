#include "devices/gimbal_yaml.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <yaml-cpp/yaml.h>

namespace armsreach {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr std::array kAxisNames{"pan", "tilt", "roll"};
constexpr std::array kKeys{"order",     "base",        "offsets",          "lower_deg",
                           "upper_deg", "fastest_deg", "acceleration_deg", "lag"};

// Travels as an exception inside this file, as yaml-cpp's own do.
struct Complaint {
  std::string what;
};

Eigen::Vector3d vector_from(const YAML::Node& node, const std::string& key) {
  Eigen::Vector3d vector;
  bool good = node.IsSequence() && node.size() == 3;
  for (int i = 0; good && i < 3; ++i)
    good = YAML::convert<double>::decode(node[i], vector[i]) && std::isfinite(vector[i]);
  if (!good) throw Complaint{"'" + key + "' is not three numbers"};
  return vector;
}

std::array<GimbalAxis, 3> order_from(const YAML::Node& node) {
  std::array<GimbalAxis, 3> order{};
  std::array<int, 3> seen{};
  const bool three = node.IsSequence() && node.size() == 3;
  for (std::size_t i = 0; three && i < 3; ++i) {
    const std::string name = node[i].IsScalar() ? node[i].Scalar() : "";
    const auto found = std::find(kAxisNames.begin(), kAxisNames.end(), name);
    if (found == kAxisNames.end()) break;
    const std::size_t axis = static_cast<std::size_t>(found - kAxisNames.begin());
    order[i] = static_cast<GimbalAxis>(axis);
    ++seen[axis];
  }
  if (seen != std::array{1, 1, 1})
    throw Complaint{"'order' is not pan, tilt and roll in some order"};
  return order;
}

Pose pose_from(const YAML::Node& node) {
  if (!node.IsMap() || !node["rotation_vector"] || !node["translation"])
    throw Complaint{"'base' is not {rotation_vector, translation}"};
  return {so3_exp(vector_from(node["rotation_vector"], "base.rotation_vector")),
          vector_from(node["translation"], "base.translation")};
}

void check_keys(const YAML::Node& map) {
  if (!map.IsMap()) throw Complaint{"the gimbal is not a map"};
  for (const auto& entry : map) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end())
      throw Complaint{"unknown key '" + key + "' in the gimbal"};
  }
}

GimbalModel model_from(const YAML::Node& map) {
  check_keys(map);
  GimbalModel model;
  const auto degrees = [&](const char* key, Eigen::Vector3d& value) {
    if (map[key]) value = kRadians * vector_from(map[key], key);
  };
  degrees("lower_deg", model.lower);
  degrees("upper_deg", model.upper);
  degrees("fastest_deg", model.fastest);
  degrees("acceleration_deg", model.acceleration);
  if ((model.lower.array() > 0).any() || (model.upper.array() < 0).any())
    throw Complaint{"rest, where all angles are 0, is outside of 'lower_deg' and 'upper_deg'"};
  if (model.fastest.minCoeff() <= 0 || model.acceleration.minCoeff() <= 0)
    throw Complaint{"'fastest_deg' and 'acceleration_deg' are not above 0"};
  if (map["order"]) model.order = order_from(map["order"]);
  if (map["base"]) model.mount_from_base = pose_from(map["base"]);
  if (const YAML::Node offsets = map["offsets"]) {
    if (!offsets.IsSequence() || offsets.size() != 3) throw Complaint{"'offsets' are not three"};
    for (std::size_t i = 0; i < 3; ++i) model.offsets[i] = vector_from(offsets[i], "offsets");
  }
  if (map["lag"] && (!YAML::convert<double>::decode(map["lag"], model.lag) ||
                     !(model.lag >= 0 && model.lag <= 1)))
    throw Complaint{"'lag' is not from 0 to 1 s"};
  return model;
}

void write_vector(std::ostream& out, const Eigen::Vector3d& v) {
  out << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
}

}  // namespace

Result<GimbalModel> read_gimbal_model(const YAML::Node& node, const std::string& where) {
  const std::string remedy =
      "a gimbal is {order: [pan, tilt, roll], base: {rotation_vector, translation}, offsets: three "
      "vectors, lower_deg, upper_deg, fastest_deg, acceleration_deg: [pan, tilt, roll], lag}";
  try {
    return model_from(node);
  } catch (const Complaint& complaint) {
    return Error{complaint.what, where, remedy};
  } catch (const YAML::Exception& e) {
    return Error{e.what(), where, remedy};
  }
}

void write_gimbal_model(std::ostream& out, const GimbalModel& model) {
  const auto precision = out.precision(std::numeric_limits<double>::max_digits10);
  out << "{order: [";
  for (std::size_t i = 0; i < 3; ++i)
    out << (i ? ", " : "") << kAxisNames[static_cast<std::size_t>(model.order[i])];
  out << "], base: {rotation_vector: ";
  write_vector(out, so3_log(model.mount_from_base.rotation()));
  out << ", translation: ";
  write_vector(out, model.mount_from_base.translation());
  out << "}, offsets: [";
  for (std::size_t i = 0; i < 3; ++i) {
    out << (i ? ", " : "");
    write_vector(out, model.offsets[i]);
  }
  out << "]";
  const auto degrees = [&](const char* key, const Eigen::Vector3d& value) {
    out << ", " << key << ": ";
    write_vector(out, value / kRadians);
  };
  degrees("lower_deg", model.lower);
  degrees("upper_deg", model.upper);
  degrees("fastest_deg", model.fastest);
  degrees("acceleration_deg", model.acceleration);
  out << ", lag: " << model.lag << "}";
  out.precision(precision);
}

}  // namespace armsreach
