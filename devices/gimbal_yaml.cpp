#include "devices/gimbal_yaml.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

namespace armsreach {
namespace {

constexpr double kRadians = std::numbers::pi / 180;
constexpr std::array kAxisNames{"pan", "tilt", "roll"};
std::array<GimbalAxis, 3> order_from(YamlMap& map) {
  const YAML::Node node = map.need("order");
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
    throw map.complaint("order", "is not pan, tilt and roll in some order");
  return order;
}

Pose pose_from(YamlMap map) {
  const Pose pose(so3_exp(map.vector<3>("rotation_vector")), map.vector<3>("translation"));
  map.refuse_others();
  return pose;
}

std::array<Eigen::Vector3d, 3> offsets_from(YamlMap& map) {
  const YAML::Node node = map.need("offsets");
  std::array<Eigen::Vector3d, 3> offsets;
  if (!node.IsSequence() || node.size() != offsets.size())
    throw map.complaint("offsets", "are not three");
  for (std::size_t i = 0; i < offsets.size(); ++i)
    offsets[i] = vector_from<3>(node[i], map.path("offsets"));
  return offsets;
}

void read_limits(YamlMap& map, GimbalModel& model) {
  const auto degrees = [&](const char* key, Eigen::Vector3d& value) {
    if (map.find(key)) value = kRadians * map.vector<3>(key);
  };
  degrees("lower_deg", model.lower);
  degrees("upper_deg", model.upper);
  degrees("fastest_deg", model.fastest);
  degrees("acceleration_deg", model.acceleration);
  if ((model.lower.array() > 0).any() || (model.upper.array() < 0).any())
    throw map.complaint("rest, where all angles are 0, is outside of 'lower_deg' and 'upper_deg'");
  if (model.fastest.minCoeff() <= 0 || model.acceleration.minCoeff() <= 0)
    throw map.complaint("'fastest_deg' and 'acceleration_deg' are not above 0");
}

void write_vector(std::ostream& out, const Eigen::Vector3d& v) {
  out << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
}

}  // namespace

GimbalModel gimbal_model_from(YamlMap map) {
  const std::string remedy =
      "a gimbal is {order: [pan, tilt, roll], base: {rotation_vector, translation}, offsets: three "
      "vectors, lower_deg, upper_deg, fastest_deg, acceleration_deg: [pan, tilt, roll], lag}";
  return with_remedy(remedy, [&] {
    GimbalModel model;
    read_limits(map, model);
    if (map.find("order")) model.order = order_from(map);
    if (map.find("base")) model.mount_from_base = pose_from(map.section("base"));
    if (map.find("offsets")) model.offsets = offsets_from(map);
    model.lag = map.number("lag", 0, 1, model.lag);  // s
    map.refuse_others();
    return model;
  });
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
