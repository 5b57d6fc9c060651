#include "app/cli/rig_options.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "app/cli/source_kinds.hpp"
#include "devices/rig_yaml.hpp"

namespace armsreach::app {
namespace {

Result<std::optional<CameraFile>> read_camera_file(const std::string& path) {
  if (path.empty()) return std::optional<CameraFile>();
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    return Error{"cannot be opened", path, "check the path given to --camera"};
  }
  auto file = read_camera_yaml(in, path);
  if (!file) return file.error();
  return std::optional<CameraFile>(*file);
}

}  // namespace

Result<std::unique_ptr<Rig>> open_rig(const RigOptions& options) {
  if (options.sources.empty() && options.rig.empty()) {
    return Error{"no source was given", "--source",
                 "for example --source sim:bench; see `armsreach sources`"};
  }
  auto spec = options.rig.empty() ? rig_from_specs(options.sources) : read_rig_file(options.rig);
  if (!spec) return spec.error();
  for (RigSensorSpec& sensor : spec->sensors) {
    const bool simulated = sensor.source.kind == "sim" || sensor.source.kind == "sim-hand";
    if (simulated && !option(sensor.source, "seed")) {
      sensor.source.options.emplace_back("seed", std::to_string(options.seed));
    }
  }
  auto camera = read_camera_file(options.camera);
  if (!camera) return camera.error();
  return armsreach::open_rig(*spec, *camera, all_source_kinds());
}

std::size_t main_sensor(const Rig& rig) {
  std::size_t with_depth = rig.sensors().size();
  for (std::size_t i = 0; i < rig.sensors().size(); ++i) {
    const SensorInfo& info = *rig.sensors()[i].source->sensor();
    if (info.name == "main") return i;
    if (info.depth_camera) with_depth = std::min(with_depth, i);
  }
  return with_depth < rig.sensors().size() ? with_depth : 0;
}

std::string at_least_one(const std::string& text) {
  const bool number = !text.empty() && text.find_first_not_of("0123456789") == text.npos;
  return number && text.find_first_not_of('0') != text.npos ? "" : "must be 1 or more";
}

}  // namespace armsreach::app
