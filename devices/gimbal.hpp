// A gimbal as an actuator: commands in, states with time stamps out. Times are those of the sensor
// that it carries, so that a state can be put beside a frame.
#pragma once

#include <optional>
#include <vector>

#include "devices/actuator.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

// All calls may come from any thread.
class Gimbal : public Actuator {
 public:
  virtual const GimbalModel& model() const = 0;

  // Makes for these angles, cut to the limits, from the command's time on (at once when that is
  // past) until the next command. The lag of the device comes on top.
  virtual Status command(const GimbalCommand& command) = 0;

  // Where it was, between measured states; nothing before the first and after the newest one, and
  // where it has been forgotten. At least the last two seconds are remembered.
  virtual std::optional<GimbalState> state_at(Timestamp time) const = 0;

  // What it was told since the last call, for recordings; of very many commands the newest.
  virtual std::vector<GimbalCommand> take_commands() = 0;
};

}  // namespace armsreach
