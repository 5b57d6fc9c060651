// The sections of a world file (world_yaml.hpp), each read by a file of its own. All of them
// complain by throwing YamlComplaint.
#pragma once

#include <string>

#include "devices/sim/world.hpp"
#include "vision/core/yaml_map.hpp"

namespace armsreach::sim {

SensorDescription sensor_from(YamlMap map);  // sensor_yaml.cpp
PathDescription path_from(YamlMap map);      // path_yaml.cpp
WearerDescription wearer_from(YamlMap map);
Material material_from(const std::string& name, YamlMap map);  // material_yaml.cpp
Shape shape_from(YamlMap& map);                                // shape_yaml.cpp
Pose pose_from(YamlMap& map);                                  // thing_yaml.cpp: at, turn_deg
// To things and parts of the world, whose materials are there already.
void add_thing(YamlMap map, World& world);
void add_motion(YamlMap map, World& world);

}  // namespace armsreach::sim
