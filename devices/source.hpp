// Sensors and actuators behind small interfaces. Real ones live in devices/, simulated twins in
// devices/sim; both are opened by the same specification text.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/actuator.hpp"
#include "vision/core/event.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

// One sensor's stream of frames. Used from one thread at a time.
class Source {
 public:
  virtual ~Source() = default;

  virtual const std::shared_ptr<const SensorInfo>& sensor() const = 0;
  // The next frame; null at the end. A broken frame is an error that names it; the caller may ask
  // for the one after it. Blocks at most as long as a device takes; `stop` ends that wait. A device
  // that has gone is Error::Kind::away once; asking again waits until it is back.
  virtual Result<FramePtr> next() = 0;
  virtual void stop() {}  // from any thread: a blocked or later next() returns null soon
  // What is built together with the sensor, such as the gimbal below a simulated camera.
  virtual std::vector<std::shared_ptr<Actuator>> actuators() const { return {}; }
  // What was guessed or given up on while opening or reading, e.g. "no calibration: assuming 60
  // deg".
  virtual Events take_events() { return {}; }
  // A live device sets the pace itself; a recording or a simulation can be asked for every frame.
  virtual bool live() const { return false; }
  virtual std::optional<std::int64_t> frame_count() const { return std::nullopt; }
};

// "kind:place,key=value,..." taken apart.
struct SourceSpec {
  std::string kind;   // "tum", "images", "video", "camera", "sim", ...
  std::string place;  // folder, file, number or world name
  std::vector<std::pair<std::string, std::string>> options;
};
Result<SourceSpec> parse_source_spec(const std::string& text);
std::string text_of(const SourceSpec& spec);

// The option's text, or nothing when it was not given.
std::optional<std::string> option(const SourceSpec& spec, const std::string& key);
// The option as a number within [low, high]; `fallback` when it was not given.
Result<double> number_option(const SourceSpec& spec, const std::string& key, double fallback,
                             double low, double high);

}  // namespace armsreach
