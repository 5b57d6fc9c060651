// Three servos on a board that speaks Firmata over a serial line: an Arduino with StandardFirmata.
#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>

#include "devices/live_gimbal.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/result.hpp"

namespace armsreach {

struct FirmataServos {
  std::string port = "/dev/ttyACM0";
  int baud = 57600;
  // Of pan, tilt and roll:
  std::array<int, 3> pins{9, 10, 11};
  std::array<double, 3> zero_us{1500, 1500, 1500};  // pulse at which an angle is 0
  std::array<double, 3> us_per_degree{10, 10, 10};  // negative where the servo turns the other way
  // From opening the port to the board's answers: a board that resets takes two seconds.
  std::chrono::milliseconds handshake{5000};
};

// What servos and the Servo library of such boards take.
constexpr double kShortestPulse = 544;  // us
constexpr double kLongestPulse = 2400;  // us

// An error where an angle within the limits needs a pulse that servos do not take, and where the
// board does not answer within the time for a handshake.
Result<std::shared_ptr<Gimbal>> open_firmata_gimbal(const FirmataServos& servos,
                                                    const std::string& name,
                                                    const GimbalModel& model);

}  // namespace armsreach
