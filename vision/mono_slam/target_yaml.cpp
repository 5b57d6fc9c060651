#include "vision/mono_slam/target_yaml.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Geometry>
#include <yaml-cpp/yaml.h>

namespace armsreach::mono_slam {
namespace {

constexpr double kLargest = 100;  // m: no target is larger, and none is so far from its origin

Error error(const std::string& what, const std::string& where) {
  return {what, where,
          "targets have points: [{patch: FILE, point_in_world: [x, y, z]}, ...] of at least four, "
          "or rectangle: {width: W, height: H}, in metres"};
}

std::optional<double> number(const YAML::Node& node) {
  double value = 0;
  if (!node || !YAML::convert<double>::decode(node, value) || !(std::abs(value) <= kLargest)) {
    return std::nullopt;
  }
  return value;
}

std::optional<TargetFile::Mark> mark(const YAML::Node& node) {
  if (!node.IsMap() || !node["patch"] || !node["patch"].IsScalar()) return std::nullopt;
  const YAML::Node point = node["point_in_world"];
  if (!point || !point.IsSequence() || point.size() != 3) return std::nullopt;
  TargetFile::Mark out;
  out.patch = node["patch"].Scalar();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = number(point[i]);
    if (!value) return std::nullopt;
    out.point_in_world[static_cast<Eigen::Index>(i)] = *value;
  }
  return out;
}

// Whether the marks lie apart and span an area: otherwise they determine no pose.
bool span_an_area(const std::vector<TargetFile::Mark>& marks) {
  constexpr double kLeastApart = 1e-3;  // m
  constexpr double kLeastWidth = 0.05;  // of the longest distance
  double longest = 0;
  double largest = 0;  // area of two marks' parallelogram with the first
  for (std::size_t a = 0; a < marks.size(); ++a) {
    const Eigen::Vector3d from_first = marks[a].point_in_world - marks[0].point_in_world;
    for (std::size_t b = a + 1; b < marks.size(); ++b) {
      const double apart = (marks[b].point_in_world - marks[a].point_in_world).norm();
      if (apart < kLeastApart) return false;
      longest = std::max(longest, apart);
      const Eigen::Vector3d other = marks[b].point_in_world - marks[0].point_in_world;
      largest = std::max(largest, from_first.cross(other).norm());
    }
  }
  return largest > kLeastWidth * longest * longest;
}

Result<TargetFile> read(const YAML::Node& root, const std::string& where) {
  TargetFile out;
  if (!root.IsMap()) return error("this is not a target", where);
  if (const YAML::Node rectangle = root["rectangle"]) {
    const auto width = rectangle.IsMap() ? number(rectangle["width"]) : std::nullopt;
    const auto height = rectangle.IsMap() ? number(rectangle["height"]) : std::nullopt;
    if (!width || !height || *width <= 0 || *height <= 0) {
      return error("entry 'rectangle' has no positive width and height", where);
    }
    out.rectangle = StartTarget::Rectangle{*width, *height};
    return out;
  }
  const YAML::Node points = root["points"];
  if (!points || !points.IsSequence() || points.size() < 4) {
    return error("entry 'points' does not list four points or more", where);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto read_mark = mark(points[i]);
    if (!read_mark) {
      return error("point " + std::to_string(i + 1) + " has no patch and place", where);
    }
    out.marks.push_back(std::move(*read_mark));
  }
  if (!span_an_area(out.marks)) {
    return error("the points lie on a line, or two of them in one place", where);
  }
  return out;
}

}  // namespace

Result<TargetFile> read_target_yaml(std::istream& in, const std::string& where) {
  try {
    return read(YAML::Load(in), where);
  } catch (const YAML::Exception& exception) {
    return error(exception.what(), where);
  }
}

void write_target_yaml(std::ostream& out, const TargetFile& file) {
  YAML::Emitter yaml;
  yaml.SetDoublePrecision(17);
  yaml << YAML::BeginMap;
  if (file.rectangle) {
    yaml << YAML::Key << "rectangle" << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key
         << "width" << YAML::Value << file.rectangle->width << YAML::Key << "height" << YAML::Value
         << file.rectangle->height << YAML::EndMap;
  } else {
    yaml << YAML::Key << "points" << YAML::Value << YAML::BeginSeq;
    for (const TargetFile::Mark& mark : file.marks) {
      yaml << YAML::Flow << YAML::BeginMap << YAML::Key << "patch" << YAML::Value << mark.patch
           << YAML::Key << "point_in_world" << YAML::Value << YAML::Flow << YAML::BeginSeq;
      for (const double value : mark.point_in_world) yaml << value;
      yaml << YAML::EndSeq << YAML::EndMap;
    }
    yaml << YAML::EndSeq;
  }
  yaml << YAML::EndMap;
  out << yaml.c_str() << "\n";
}

}  // namespace armsreach::mono_slam
