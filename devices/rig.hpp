// A rig: named sensors with their poses, and actuators, on one clock. A single camera is a rig too.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "devices/actuator.hpp"
#include "devices/firmata_gimbal.hpp"
#include "devices/gimbal.hpp"
#include "devices/open.hpp"
#include "devices/source.hpp"
#include "devices/uvc_gimbal.hpp"
#include "vision/core/camera_yaml.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/pose.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

struct RigSensorSpec {
  std::string name = "main";
  SourceSpec source;
  std::string camera;    // its camera file where it is not the source's own; else empty
  Pose rig_from_sensor;  // of the sensor's camera (SensorInfo::camera), at rest on a gimbal
  // In a recording, the gimbal that moved the camera, and its gimbal.txt.
  std::optional<GimbalModel> gimbal;
  std::string gimbal_states;
};

// A real gimbal below one of the sensors.
struct RigGimbalSpec {
  std::string name;     // in the rig file
  std::string carries;  // the sensor
  GimbalModel model;
  std::variant<FirmataServos, UvcMotors> driver;
};

struct RigSpec {
  std::vector<RigSensorSpec> sensors;
  std::vector<RigGimbalSpec> gimbals;
  std::filesystem::path folder;  // relative paths start here; empty: the working directory
};

// From the command line: "SPEC" is the sensor `main`, "NAME=SPEC" a named one; sensors coincide.
Result<RigSpec> rig_from_specs(const std::vector<std::string>& sources);

struct RigSensor {
  std::unique_ptr<Source> source;
  Pose rig_from_sensor;

  const std::string& name() const { return source->sensor()->name; }
};

class Rig {
 public:
  // The sensors' own actuators join these.
  Rig(std::vector<RigSensor> sensors, std::vector<std::shared_ptr<Actuator>> actuators);

  const std::vector<RigSensor>& sensors() const { return sensors_; }
  const std::vector<std::shared_ptr<Actuator>>& actuators() const { return actuators_; }
  // That carries a sensor, and has its name; null where none does.
  std::shared_ptr<Gimbal> gimbal_of(const std::string& sensor) const;

  // The frames of all sensors in order of time (where equal, in order of sensors), each naming its
  // sensor; null when all have ended. For that order every sensor that has not ended is waited for.
  // A broken frame is an error; the caller may ask for the one after it.
  Result<FramePtr> next();
  void stop();  // from any thread: sensors end, actuators come to rest
  Events take_events();
  bool live() const;

 private:
  struct Waiting {
    FramePtr frame;  // taken from the sensor, not yet handed on
    bool ended = false;
  };
  std::vector<RigSensor> sensors_;
  std::vector<std::shared_ptr<Actuator>> actuators_;
  std::vector<Waiting> waiting_;  // of each sensor
};

// `camera` (of --camera) is for rigs of one sensor. Live sensors and recordings do not mix: they
// have no common clock.
Result<std::unique_ptr<Rig>> open_rig(const RigSpec& spec, const std::optional<CameraFile>& camera,
                                      const std::vector<SourceKind>& kinds = real_source_kinds());

}  // namespace armsreach
