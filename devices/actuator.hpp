// Something a rig moves or drives: a gimbal, a glove, a voice. Each adds its own commands.
#pragma once

#include <string>

#include "vision/core/event.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

class Actuator {
 public:
  virtual ~Actuator() = default;

  virtual const std::string& name() const = 0;
  // To its safe state: motors off, servos let go, silent. From any thread.
  virtual Status rest() = 0;
  virtual Events take_events() { return {}; }
};

}  // namespace armsreach
