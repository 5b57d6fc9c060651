// The part of the Firmata protocol that moves servos: what is sent to a board, and a reader of what
// it sends back. Source: the protocol's specification 2.6, github.com/firmata/protocol.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace armsreach::firmata {

using Bytes = std::vector<std::uint8_t>;

constexpr int kMostPins = 128;

Bytes version_query();
Bytes firmware_query();
// Makes a pin drive a servo whose pulses are within [least, most] microseconds.
Bytes servo_config(int pin, int least, int most);
Bytes servo_mode(int pin);
// An extended analog message: values from 544 on are microseconds, lower ones would be degrees.
Bytes servo_pulse(int pin, int microseconds);

struct Version {  // of the protocol
  int major = 0;
  int minor = 0;
};
struct Firmware {
  int major = 0;
  int minor = 0;
  std::string name;  // "StandardFirmata.ino"
};
struct Text {  // what the board has to say
  std::string text;
};
using Message = std::variant<Version, Firmware, Text>;

// Takes bytes as they come, in any pieces. Messages of other kinds are passed over; what is
// malformed is dropped up to the next command.
class Reader {
 public:
  std::vector<Message> take(std::span<const std::uint8_t> bytes);

 private:
  void take(std::uint8_t byte, std::vector<Message>& messages);
  void finish(std::vector<Message>& messages);

  Bytes message_;  // from its command on; empty between messages
};

}  // namespace armsreach::firmata
