// Recordings: frames that can be read in any order, and playing them as a source.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "devices/source.hpp"
#include "vision/core/frame.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

class Recording {
 public:
  virtual ~Recording() = default;

  virtual const std::shared_ptr<const SensorInfo>& sensor() const = 0;
  // Number of frames; for a video what its header promises, nothing when that is silent.
  virtual std::optional<std::int64_t> size() const = 0;
  // Strictly increasing with the index.
  virtual Timestamp time(std::int64_t index) const = 0;
  // Nothing from the end on. The frame's index and time are those of the recording.
  virtual Result<std::optional<Frame>> read(std::int64_t index) = 0;
  virtual Events take_events() { return {}; }
};

enum class Loop {
  once,
  pingpong,  // forwards, then backwards, and so on: endless, with index and time ever increasing
};
// The `loop` option of a specification; once when it was not given.
Result<Loop> loop_option(const SourceSpec& spec);

std::unique_ptr<Source> play(std::unique_ptr<Recording> recording, Loop loop);

}  // namespace armsreach
