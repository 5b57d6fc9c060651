#include "devices/rig.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "devices/calibration.hpp"
#include "devices/recorded_gimbal.hpp"

namespace armsreach {
namespace {

namespace fs = std::filesystem;

SourceSpec resolved(SourceSpec spec, const fs::path& folder, const std::vector<SourceKind>& kinds) {
  const bool is_path = std::any_of(kinds.begin(), kinds.end(), [&](const SourceKind& kind) {
    return kind.name == spec.kind && kind.place_is_path && kind.place_is_path(spec.place);
  });
  if (is_path) spec.place = (folder / spec.place).string();
  return spec;
}

Result<RigSensor> open_sensor(const RigSensorSpec& sensor, const fs::path& folder,
                              const std::optional<CameraFile>& camera,
                              const std::vector<SourceKind>& kinds) {
  OpenOptions options{sensor.name, camera};
  if (!camera && !sensor.camera.empty()) {
    auto file = read_camera_file(folder / sensor.camera);
    if (!file) return std::move(file).error();
    options.camera = std::move(*file);
  }
  auto source = open_source(resolved(sensor.source, folder, kinds), options, kinds);
  if (!source) return std::move(source).error();
  return RigSensor{std::move(*source), sensor.rig_from_sensor};
}

Result<std::shared_ptr<Gimbal>> open_gimbal(const RigGimbalSpec& gimbal) {
  if (const auto* servos = std::get_if<FirmataServos>(&gimbal.driver))
    return open_firmata_gimbal(*servos, gimbal.carries, gimbal.model);
  return open_uvc_gimbal(std::get<UvcMotors>(gimbal.driver), gimbal.carries, gimbal.model);
}

}  // namespace

Result<RigSpec> rig_from_specs(const std::vector<std::string>& sources) {
  RigSpec rig;
  for (const std::string& text : sources) {
    RigSensorSpec sensor;
    const auto equals = text.find('=');
    const bool named = equals < text.find(':');  // not an option's
    if (named) sensor.name = text.substr(0, equals);
    auto source = parse_source_spec(named ? text.substr(equals + 1) : text);
    if (!source) return std::move(source).error();
    sensor.source = std::move(*source);
    for (const RigSensorSpec& other : rig.sensors) {
      if (other.name != sensor.name) continue;
      return Error{"two sources are named '" + sensor.name + "'", text,
                   "name them apart: --source depth=SPEC --source ir=SPEC"};
    }
    rig.sensors.push_back(std::move(sensor));
  }
  if (rig.sensors.empty()) return Error{"no source", "", "give --source SPEC or --rig FILE"};
  return rig;
}

Rig::Rig(std::vector<RigSensor> sensors, std::vector<std::shared_ptr<Actuator>> actuators)
    : sensors_(std::move(sensors)), actuators_(std::move(actuators)), waiting_(sensors_.size()) {
  for (const RigSensor& sensor : sensors_) {
    for (std::shared_ptr<Actuator>& own : sensor.source->actuators())
      actuators_.push_back(std::move(own));
  }
}

std::shared_ptr<Gimbal> Rig::gimbal_of(const std::string& sensor) const {
  for (const std::shared_ptr<Actuator>& actuator : actuators_) {
    auto gimbal = std::dynamic_pointer_cast<Gimbal>(actuator);
    if (gimbal && gimbal->name() == sensor) return gimbal;
  }
  return nullptr;
}

Result<FramePtr> Rig::next() {
  Waiting* earliest = nullptr;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    Waiting& waiting = waiting_[i];
    if (!waiting.frame && !waiting.ended) {
      auto frame = sensors_[i].source->next();
      if (!frame) return frame;
      waiting.frame = std::move(*frame);
      waiting.ended = !waiting.frame;
    }
    if (!waiting.frame) continue;
    if (!earliest || waiting.frame->time < earliest->frame->time) earliest = &waiting;
  }
  return earliest ? std::exchange(earliest->frame, nullptr) : nullptr;
}

void Rig::stop() {
  for (const RigSensor& sensor : sensors_) sensor.source->stop();
  for (const auto& actuator : actuators_) {
    // Stopping goes on whatever one device says; what it says is among its events.
    static_cast<void>(actuator->rest());
  }
}

Events Rig::take_events() {
  Events all;
  const auto add = [&all](Events events) {
    std::move(events.begin(), events.end(), std::back_inserter(all));
  };
  for (const RigSensor& sensor : sensors_) add(sensor.source->take_events());
  for (const auto& actuator : actuators_) add(actuator->take_events());
  return all;
}

bool Rig::live() const {
  return std::any_of(sensors_.begin(), sensors_.end(),
                     [](const RigSensor& sensor) { return sensor.source->live(); });
}

Result<std::unique_ptr<Rig>> open_rig(const RigSpec& spec, const std::optional<CameraFile>& camera,
                                      const std::vector<SourceKind>& kinds) {
  if (camera && spec.sensors.size() > 1) {
    return Error{"--camera is for one sensor, the rig has " + std::to_string(spec.sensors.size()),
                 "", "give each sensor its camera file in a rig file"};
  }
  std::vector<RigSensor> sensors;
  std::vector<std::shared_ptr<Actuator>> actuators;
  for (const RigSensorSpec& sensor : spec.sensors) {
    auto opened = open_sensor(sensor, spec.folder, camera, kinds);
    if (!opened) return std::move(opened).error();
    if (!sensors.empty() && sensors.front().source->live() != opened->source->live()) {
      return Error{"sensors '" + sensors.front().name() + "' and '" + sensor.name +
                       "' have no common clock: one is live, the other recorded",
                   text_of(sensor.source), "use live sensors only, or recordings only"};
    }
    sensors.push_back(std::move(*opened));
    if (!sensor.gimbal) continue;
    auto gimbal =
        open_recorded_gimbal(sensor.name, *sensor.gimbal, spec.folder / sensor.gimbal_states);
    if (!gimbal) return std::move(gimbal).error();
    actuators.push_back(std::move(*gimbal));
  }
  for (const RigGimbalSpec& gimbal : spec.gimbals) {
    auto opened = open_gimbal(gimbal);
    if (!opened) return std::move(opened).error();
    actuators.push_back(std::move(*opened));
  }
  return std::make_unique<Rig>(std::move(sensors), std::move(actuators));
}

}  // namespace armsreach
