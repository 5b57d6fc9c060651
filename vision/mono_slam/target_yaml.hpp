// Codec of start targets: YAML with either
//   points: [{patch: FILE, point_in_world: [x, y, z]}, ...]   four or more; m
// or
//   rectangle: {width: W, height: H}                           black on white; m
#pragma once

#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vision/core/result.hpp"
#include "vision/mono_slam/start_target.hpp"

namespace armsreach::mono_slam {

struct TargetFile {
  struct Mark {
    std::string patch;  // an image file's name, relative to the target's
    Eigen::Vector3d point_in_world;
  };
  std::vector<Mark> marks;
  std::optional<StartTarget::Rectangle> rectangle;
};

// `where` names the stream in errors.
Result<TargetFile> read_target_yaml(std::istream& in, const std::string& where);
void write_target_yaml(std::ostream& out, const TargetFile& file);

}  // namespace armsreach::mono_slam
