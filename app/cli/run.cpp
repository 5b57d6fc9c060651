#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/hands_setup.hpp"
#include "app/cli/mono_setup.hpp"
#include "app/cli/rig_options.hpp"
#include "app/cli/run_options.hpp"
#include "app/pipelines/narrator.hpp"
#include "app/pipelines/pipeline.hpp"
#include "app/pipelines/presenter.hpp"
#include "app/pipelines/vision_stages.hpp"
#include "app/runtime/event_log.hpp"
#include "devices/speech/spoken_voice.hpp"

namespace armsreach::app {
namespace {

constexpr int kWearerWidth = 640;  // px, at least
constexpr int kOperatorWidth = 1280;
constexpr int kOperatorHeight = 720;

Result<Config> read_config_file(const std::string& path) {
  if (path.empty()) return Config{};
  std::ifstream in(path);
  if (!in || std::filesystem::is_directory(path)) {
    return Error{"cannot be opened", path, "check the path given to --config"};
  }
  return read_config(in, path);
}

Pace pace_of(const RunOptions& options) {
  return options.pace == "live" ? Pace::live : Pace::every_frame;
}

// A small video is enlarged, by a whole factor, so that text has room beside what it is about.
cv::Size picture_size(const Config& config, const Camera& camera) {
  if (config.width) return {config.width, config.height};
  if (config.layout == "operator") return {kOperatorWidth, kOperatorHeight};
  const int times = (kWearerWidth + camera.width - 1) / camera.width;
  return {times * camera.width, times * camera.height};
}

PresenterOptions presenter_options(const RunOptions& options, const Config& config,
                                   const SensorInfo& sensor) {
  PresenterOptions out;
  const cv::Size size =
      picture_size(config, sensor.color_camera ? *sensor.color_camera : sensor.camera());
  out.display = options.display;
  out.layout = layout_from_name(config.layout);
  out.width = size.width;
  out.height = size.height;
  out.record = options.record;
  out.screenshots = options.screenshots;
  out.rate = sensor.rate;
  out.may_drop = options.pace == "live";
  out.actions = config.actions;
  return out;
}

Status check_mesh(const std::string& mesh, const std::string& where) {
  const std::vector<std::string>& known = render::mesh_names();
  if (std::count(known.begin(), known.end(), mesh)) return ok();
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
  return Error{"no mesh is called '" + mesh + "'", where, "there are: " + names};
}

Status check_meshes(const Config& config, const std::string& where) {
  std::vector<std::string> meshes{config.gesture.insert};
  for (const Action& action : config.actions) meshes.push_back(action.insert);
  for (const std::string& mesh : meshes) {
    if (mesh.empty()) continue;
    if (auto status = check_mesh(mesh, where); !status) return status;
  }
  return ok();
}

// What --map or --session left the last time; an empty world otherwise.
Result<SavedWorld> load_world(const RunOptions& options, const Config& config) {
  const mapping::VoxelMapOptions map = mapper_options(config.mapping).map;
  if (!options.map.empty()) return load_map(options.map, map);
  if (options.session.empty()) return SavedWorld{};
  auto world = load_session(options.session, map);
  if (!world) return world;
  for (const SavedObject& object : world->objects) {
    if (auto status = check_mesh(object.mesh, options.session); !status) return status.error();
  }
  return world;
}

Status check_world_can_be_saved(const RunOptions& options) {
  if (!options.map.empty()) return check_map_can_be_saved(options.map);
  return options.session.empty() ? ok() : check_session_can_be_saved(options.session);
}

// What is done otherwise than asked for, or cannot be done at all with this sensor.
void tell_fallbacks(const Config& config, const SavedWorld& world, const SensorInfo& sensor,
                    bool workspace, EventLog& log) {
  if (world.map && world.map->grid().resolution != config.mapping.resolution) {
    char text[80];
    std::snprintf(text, sizeof text, "the map's own resolution of %g m is kept",
                  world.map->grid().resolution);
    log.write({0, FaultEvent{"mapping", text, "make another map for another resolution"}});
  }
  if (!workspace || sensor.depth_camera || world.map) return;
  log.write({0, FaultEvent{"tracking", "a camera without depth is tracked only in a map",
                           "give --map or --session that a depth camera left, and in the "
                           "configuration tracking: {alpha: 0}"}});
}

bool wants(const RunOptions& options, const char* experience) {
  return std::count(options.experience.begin(), options.experience.end(), experience) > 0;
}

struct Parts {
  bool workspace = false;
  bool mono = false;
  bool wearable = false;
};

// Who tracks, and for whom.
Parts parts_for(const RunOptions& options, const Config& config, const SavedWorld& world,
                const SensorInfo& sensor) {
  const std::string& method = config.tracking.method;
  const bool dense = method == "dense" || (method == "auto" && !world.sparse_map);
  Parts parts;
  const bool in_depth = sensor.depth_camera || world.map || !options.map.empty();
  parts.workspace = options.experience.empty() ? dense && in_depth : wants(options, "workspace");
  parts.wearable = options.experience.empty() ? !parts.workspace : wants(options, "wearable");
  const std::string& gaze = config.gaze.mode;
  const bool looks_at_world = gaze == "saccade" || gaze == "fixate" || gaze == "stabilise";
  const bool needs_pose = world.sparse_map || looks_at_world || !sensor.depth_camera;
  parts.mono = !parts.workspace && (method == "mono" || (method == "auto" && needs_pose)) &&
               sensor.color_camera;
  return parts;
}

Status check_parts(const Parts& parts, const RunOptions& options, const Config& config,
                   const SavedWorld& world, const SensorInfo& sensor) {
  const bool asks_mono = config.tracking.method == "mono";
  if (asks_mono && parts.workspace) {
    return Error{"tracking: {method: mono} is not for the workspace", options.config,
                 "leave workspace out of --experience, or take method: dense"};
  }
  if (asks_mono && !sensor.color_camera) {
    return Error{"tracking: {method: mono} needs a picture, and the sensor has only depth",
                 options.config, "take another source, or method: dense"};
  }
  if ((parts.workspace && world.sparse_map) || (parts.mono && world.map)) {
    return Error{
        std::string("the session is that of a ") + (world.map ? "depth camera" : "plain camera"),
        options.session,
        "give --session another folder, or track as then: tracking: {method: " +
            std::string(world.map ? "dense}" : "mono}")};
  }
  if (!parts.workspace && !options.map.empty()) {
    return Error{"--map is for the workspace", "--experience",
                 "add workspace to --experience, or remove it"};
  }
  if (parts.workspace || parts.mono || (options.session.empty() && options.trajectory.empty()))
    return ok();
  return Error{"--session and --trajectory are for a camera that is tracked", "--experience",
               "add workspace to --experience, or in the configuration tracking: {method: mono}, "
               "or remove them"};
}

// The start target that lies beside the main sensor's recording; "" where none does.
std::string target_beside_source(const RunOptions& options) {
  return options.sources.size() == 1 ? target_of_source(options.sources.front()) : "";
}

Result<PipelineOptions> pipeline_options(const RunOptions& options, const Config& config,
                                         const Parts& parts, const SavedWorld& world,
                                         const SensorInfoPtr& sensor) {
  PipelineOptions out;
  if (parts.mono) {
    auto mono = make_mono_setup(config.mono_slam, target_beside_source(options), options.seed);
    if (!mono) return mono.error();
    if (world.sparse_map) {
      const Camera camera = reduced(*sensor->color_camera);
      if (auto status = check_same_camera(*world.sparse_map, camera, options.session); !status)
        return status.error();
    }
    out.mono = *std::move(mono);
    out.mono->map = world.sparse_map;
  }
  if (parts.wearable) {
    auto hands = make_hands_setup(config);
    if (!hands) return hands.error();
    out.hands = *std::move(hands);
  }
  out.workspace = parts.workspace;
  out.sensor = sensor;
  out.pace = pace_of(options);
  out.frames = options.frames;
  out.trajectory = options.trajectory;
  out.stats = options.stats;
  out.map = options.map;
  out.session = options.session;
  return out;
}

void print_summary(const RunSummary& s, bool tracked) {
  std::printf("%lld frames in %.1f s (%.1f Hz)", static_cast<long long>(s.frames), s.seconds,
              s.rate);
  if (tracked) std::printf(", %lld tracked", static_cast<long long>(s.tracked_frames));
  std::printf("; frame to overlay %.0f ms, p95 %.0f ms\n", 1e3 * s.latency_p50,
              1e3 * s.latency_p95);
}

}  // namespace

Status run(const RunOptions& options) {
  auto config = read_config_file(options.config);
  if (!config) return config.error();
  return run(options, *config);
}

Status run(const RunOptions& options, const Config& config) {
  const Pace pace = pace_of(options);
  if (pace == Pace::live && !config.threads) {
    return Error{"threads: false is for --pace every-frame", options.config,
                 "remove it, or add --pace every-frame"};
  }
  if (!config.mapping.enabled && !(options.map.empty() && options.session.empty())) {
    return Error{"--map and --session need mapping, which the configuration switches off",
                 options.config, "remove them, or mapping: {enabled: false}"};
  }
  if (auto status = check_meshes(config, options.config); !status) return status;
  auto world = load_world(options, config);
  if (!world) return world.error();
  if (auto status = check_world_can_be_saved(options); !status) return status;
  auto rig = open_rig({options.sources, options.rig, options.camera, options.seed});
  if (!rig) return rig.error();
  const SensorInfoPtr sensor = (*rig)->sensors()[main_sensor(**rig)].source->sensor();

  const Parts parts = parts_for(options, config, *world, *sensor);
  if (auto status = check_parts(parts, options, config, *world, *sensor); !status) return status;

  auto pipeline = pipeline_options(options, config, parts, *world, sensor);
  if (!pipeline) return pipeline.error();

  EventLog log;
  if (auto status = log.open(options.events); !status) return status;
  auto narrator = Narrator::make(log, config.speech, !options.record.empty());
  if (!narrator) return narrator.error();
  PresenterOptions presenting = presenter_options(options, config, *sensor);
  presenting.film_sounds = [&narrator] { return (*narrator)->track(); };
  auto presenter = Presenter::make(presenting);
  if (!presenter) return presenter.error();
  if (config.speech.voice == "auto" && pace == Pace::live && (*presenter)->interactive()) {
    (*narrator)->speak_aloud(make_spoken_voice());
  }

  tell_fallbacks(config, *world, *sensor, parts.workspace, log);
  const bool can_follow = parts.wearable && (*rig)->gimbal_of(sensor->name);
  if (auto fault = cannot_follow(config.gaze, can_follow)) log.write({0, *std::move(fault)});

  pipeline->narrator = narrator->get();
  auto summary = run_pipeline(**rig, **presenter, log, config, *pipeline, *std::move(world));
  const Status spoken = (*narrator)->close();
  const Status logged = log.close();
  if (!summary) return summary.error();
  if (!spoken) return spoken;
  if (!logged) return logged;
  print_summary(*summary, parts.workspace || parts.mono);
  return ok();
}

}  // namespace armsreach::app
