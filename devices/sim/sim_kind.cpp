// The text of a simulated source: "sim:WORLD,key=value,...".
#include <cmath>
#include <numbers>
#include <utility>

#include "devices/sim/hand_source.hpp"
#include "devices/sim/infrared/infrared_source.hpp"
#include "devices/sim/sim_source.hpp"
#include "devices/sim/worlds.hpp"

namespace armsreach {
namespace {

// Numbers of the sensor that an option replaces.
struct SensorOption {
  const char* key;
  double sim::SensorDescription::*number;
  double low;
  double high;
};
constexpr SensorOption kSensorOptions[] = {{"rate", &sim::SensorDescription::rate, 0.1, 1000},
                                           {"near", &sim::SensorDescription::nearest, 0, 100},
                                           {"far", &sim::SensorDescription::farthest, 0.01, 100}};

// The same for what the colour camera does.
struct ColorOption {
  const char* key;
  double sim::ColorDescription::*number;
  double high;
  double unit;
};
constexpr ColorOption kColorOptions[] = {
    {"color_noise", &sim::ColorDescription::noise, 50, 1},
    {"exposure_ms", &sim::ColorDescription::exposure, 1000, 1e-3},
    {"exposure_lag", &sim::ColorDescription::exposure_lag, 100, 1},
    {"exposure_drift", &sim::ColorDescription::exposure_drift, 0.5, 1},
    {"white_balance_drift", &sim::ColorDescription::white_balance_drift, 0.5, 1}};

// "color=clean" first takes everything away; each number then overrides one thing.
Status apply_color(const SourceSpec& spec, sim::ColorDescription& color) {
  const std::string noise = option(spec, "noise").value_or("");
  const std::string text = option(spec, "color").value_or(noise == "none" ? "clean" : "world");
  if (text != "clean" && text != "webcam" && text != "world") {
    return Error{"option 'color' is '" + text + "'", text_of(spec),
                 "give clean, webcam, or leave it out for what the world says"};
  }
  if (text == "clean") color = sim::kCleanColor;
  if (text == "webcam") color = {};
  for (const ColorOption& one : kColorOptions) {
    auto value = number_option(spec, one.key, color.*one.number / one.unit, 0, one.high);
    if (!value) return value.error();
    color.*one.number = *value * one.unit;
  }
  auto quality = number_option(spec, "jpeg", color.jpeg_quality, 0, 100);
  if (!quality) return quality.error();
  color.jpeg_quality = static_cast<int>(*quality);
  return ok();
}

Status apply_noise(const SourceSpec& spec, sim::SensorDescription& sensor) {
  const auto text = option(spec, "noise");
  if (!text) return ok();
  if (*text == "none" || *text == "kinect") {
    sensor.noise = *text == "kinect" ? 1 : 0;
    return ok();
  }
  auto factor = number_option(spec, "noise", 1, 0, 100);
  if (!factor) {
    return Error{"option 'noise' is '" + *text + "'", text_of(spec),
                 "give none, kinect, or a factor of the Kinect's from 0 to 100"};
  }
  sensor.noise = *factor;
  return ok();
}

// A size keeps the field of view; without the other side it keeps the shape too.
Status apply_size(const SourceSpec& spec, sim::SensorDescription& sensor) {
  auto width = number_option(spec, "width", 0, 16, 4096);
  if (!width) return width.error();
  auto height = number_option(spec, "height", 0, 16, 4096);
  if (!height) return height.error();
  const double shape = static_cast<double>(sensor.height) / sensor.width;
  if (*width == 0 && *height > 0) *width = std::round(*height / shape);
  if (*height == 0 && *width > 0) *height = std::round(*width * shape);
  if (*width > 0) {
    sensor.width = static_cast<int>(*width);
    sensor.height = static_cast<int>(*height);
  }
  return ok();
}

Status apply_sensor(const SourceSpec& spec, sim::SensorDescription& sensor) {
  if (auto status = apply_noise(spec, sensor); !status) return status;
  if (auto status = apply_color(spec, sensor.color); !status) return status;
  if (auto status = apply_size(spec, sensor); !status) return status;
  for (const SensorOption& one : kSensorOptions) {
    auto value = number_option(spec, one.key, sensor.*one.number, one.low, one.high);
    if (!value) return value.error();
    sensor.*one.number = *value;
  }
  if (sensor.farthest > sensor.nearest) return ok();
  return Error{"the depth range ends before it begins", text_of(spec),
               "give near and far in metres, near < far"};
}

// A world that has an infra-red camera is seen by that one unless another is asked for.
Result<bool> wants_infrared(const SourceSpec& spec, const sim::World& world) {
  const std::string sensor = option(spec, "sensor").value_or(world.infrared ? "ir" : "main");
  if (sensor == "main" || (sensor == "ir" && world.infrared)) return sensor == "ir";
  return Error{"the world '" + world.name + "' has no sensor '" + sensor + "'", text_of(spec),
               world.infrared ? "its sensors are main and ir" : "its sensor is main"};
}

Status apply_infrared(const SourceSpec& spec, sim::InfraredDescription& infrared) {
  for (const char* key : {"width", "height", "near", "far", "color", "jpeg"}) {
    if (!option(spec, key)) continue;
    return Error{"option '" + std::string(key) + "' is not for the infra-red camera", text_of(spec),
                 "its options are seed, noise, speed, frames, loop and rate"};
  }
  const std::string noise = option(spec, "noise").value_or("");
  if (noise == "none") infrared.noise = 0;
  auto rate = number_option(spec, "rate", infrared.rate, 0.1, 1000);
  if (!rate) return rate.error();
  infrared.rate = *rate;
  return ok();
}

// Where the camera is carried and through what lens it looks: worlds with a wearer can be seen from
// the head and from the shoulder.
Status apply_mount(const SourceSpec& spec, sim::World& world) {
  const std::string mount = option(spec, "mount").value_or("");
  const bool known = mount.empty() || mount == "path" || mount == "head" || mount == "shoulder";
  if (!known) {
    return Error{"option 'mount' is '" + mount + "'", text_of(spec), "give path, head or shoulder"};
  }
  if ((mount == "head" || mount == "shoulder") && !world.wearer) {
    return Error{"nobody wears a camera in '" + world.name + "'", text_of(spec),
                 "leave mount out, or take a world with a wearer, such as kitchen-table"};
  }
  if (mount == "path" && world.path.keys.empty()) {
    return Error{"the world '" + world.name + "' has no path", text_of(spec),
                 "give mount=head or mount=shoulder"};
  }
  if (!mount.empty()) {
    world.sensor.path.reset();
    world.sensor.mount = mount == "head"       ? sim::Mount::head
                         : mount == "shoulder" ? sim::Mount::shoulder
                                               : sim::Mount::path;
  }
  const double degree = std::numbers::pi / 180;
  auto lens = number_option(spec, "lens", world.sensor.field_of_view / degree, 5, 150);
  if (!lens) return lens.error();
  world.sensor.field_of_view = *lens * degree;
  const std::string gimbal = option(spec, "gimbal").value_or("");
  if (!gimbal.empty() && gimbal != "yes" && gimbal != "no") {
    return Error{"option 'gimbal' is '" + gimbal + "'", text_of(spec), "give yes or no"};
  }
  if (gimbal == "yes" && !world.sensor.gimbal) world.sensor.gimbal = GimbalModel{};
  if (gimbal == "no") world.sensor.gimbal.reset();
  return ok();
}

Status apply_loop(const SourceSpec& spec, const sim::World& world, sim::SimOptions& options) {
  const auto text = option(spec, "loop");
  if (!text) return ok();
  if (*text != "endless") {
    return Error{"option 'loop' is '" + *text + "'", text_of(spec),
                 "give loop=endless, or leave it out to stop after once along the path"};
  }
  if (!world.path.closed) {
    return Error{"the path of '" + world.name + "' does not close", text_of(spec),
                 "leave loop out"};
  }
  options.endless = true;
  return ok();
}

Result<std::unique_ptr<Source>> open_sim(const SourceSpec& spec, const OpenOptions& open_options) {
  if (open_options.camera) {
    return Error{"a simulated camera needs no calibration", text_of(spec),
                 "leave --camera out; width and height are options of the source"};
  }
  auto world = sim::load_world(spec.place);
  if (!world) return world.error();
  if (auto status = apply_sensor(spec, world->sensor); !status) return status.error();
  if (auto status = apply_mount(spec, *world); !status) return status.error();
  sim::SimOptions options;
  options.sensor_name = open_options.sensor;
  auto seed = number_option(spec, "seed", 1, 0, 1e15);
  if (!seed) return seed.error();
  auto speed = number_option(spec, "speed", 1, 0.01, 100);
  if (!speed) return speed.error();
  auto frames = number_option(spec, "frames", 0, 1, 1e12);
  if (!frames) return frames.error();
  options.seed = static_cast<std::uint64_t>(*seed);
  options.speed = *speed;
  if (*frames > 0) options.frames = static_cast<std::int64_t>(*frames);
  if (auto status = apply_loop(spec, *world, options); !status) return status.error();
  auto infrared = wants_infrared(spec, *world);
  if (!infrared) return infrared.error();
  if (!*infrared) return sim::make_sim_source(*world, options);
  if (auto status = apply_infrared(spec, *world->infrared); !status) return status.error();
  return std::unique_ptr<Source>(sim::make_infrared_source(*world, options));
}

std::vector<Availability> probe_worlds() {
  std::vector<Availability> found;
  for (const std::string& name : sim::world_names()) {
    Availability one;
    one.spec = "sim:" + name;
    const auto world = sim::load_world(name);
    one.usable = world.ok();
    one.detail = world ? world->about : world.error().message();
    found.push_back(one);
  }
  return found;
}

}  // namespace

std::vector<SourceKind> sim_source_kinds() {
  SourceKind kind;
  kind.name = "sim";
  kind.usage =
      "sim:WORLD|FILE.yaml[,sensor=main|ir][,seed=N][,noise=none|kinect|FACTOR][,speed=X]"
      "[,frames=N][,loop=endless]"
      "[,width=PX][,height=PX][,rate=HZ][,near=M][,far=M]"
      "[,mount=path|head|shoulder][,lens=DEG][,gimbal=yes|no]"
      "[,color=clean|webcam][,color_noise=LEVELS][,exposure_ms=MS][,exposure_lag=S]"
      "[,exposure_drift=SHARE][,white_balance_drift=SHARE][,jpeg=QUALITY]";
  kind.option_keys = {"seed", "noise", "speed", "frames", "loop",  "width", "height", "rate",
                      "near", "far",   "color", "jpeg",   "mount", "lens",  "gimbal", "sensor"};
  for (const ColorOption& one : kColorOptions) kind.option_keys.emplace_back(one.key);
  kind.place_is_path = sim::is_world_file;
  kind.open = open_sim;
  kind.probe = probe_worlds;
  // A simulated hand can be drawn into whatever else can be opened.
  std::vector<SourceKind> others = real_source_kinds();
  others.push_back(kind);
  return {kind, hand_source_kind(others)};
}

}  // namespace armsreach
