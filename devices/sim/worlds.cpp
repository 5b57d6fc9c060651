#include "devices/sim/worlds.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "devices/sim/world_files.hpp"
#include "devices/sim/world_yaml.hpp"
#include "render/assets.hpp"

namespace armsreach::sim {

const std::vector<std::string>& world_names() {
  static const std::vector<std::string> names{
      "bench",    "near",        "kitchen-table",   "assembly", "packaging", "haptic-table",
      "ir-glove", "ir-bracelet", "ir-bracelet-far", "gaze",     "gaze-sway", "gaze-room"};
  return names;
}

bool is_world_file(const std::string& name) { return name.ends_with(".yaml"); }

Result<World> load_world(const std::string& name) {
  if (is_world_file(name)) {
    std::ifstream in(name);
    if (!in) return Error{"no such world file", name, "give the path of a YAML file"};
    Result<World> world = read_world_yaml(in, name);
    if (!world) return world;
    const Status loaded = load_files(std::filesystem::path(name).parent_path(), *world);
    if (!loaded) return loaded.error();
    return world;
  }
  const auto& names = world_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    std::string list;
    for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
    return Error{"there is no simulated world '" + name + "'", "sim:" + name,
                 "the worlds are " + list + "; or give a world file of yours, FILE.yaml"};
  }
  const std::string file = "worlds/" + name + ".yaml";
  std::istringstream text{std::string(render::asset(file))};
  return read_world_yaml(text, file);
}

}  // namespace armsreach::sim
