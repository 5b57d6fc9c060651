#include "devices/firmata.hpp"

#include <cassert>
#include <cstddef>

namespace armsreach::firmata {
namespace {

constexpr std::uint8_t kAnalog = 0xE0;   // .. 0xEF
constexpr std::uint8_t kDigital = 0x90;  // .. 0x9F
constexpr std::uint8_t kPinMode = 0xF4;
constexpr std::uint8_t kVersion = 0xF9;
constexpr std::uint8_t kStartSysex = 0xF0;
constexpr std::uint8_t kEndSysex = 0xF7;
constexpr std::uint8_t kExtendedAnalog = 0x6F;
constexpr std::uint8_t kServoConfig = 0x70;
constexpr std::uint8_t kString = 0x71;
constexpr std::uint8_t kFirmware = 0x79;
constexpr std::uint8_t kServo = 4;  // a pin's mode

constexpr std::size_t kLongestSysex = 1024;  // boards have 64 bytes; some more

void add_seven_bits(Bytes& bytes, int value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0x7F));
  bytes.push_back(static_cast<std::uint8_t>(value >> 7 & 0x7F));
}

std::uint8_t pin_byte(int pin) {
  assert(pin >= 0 && pin < kMostPins);
  return static_cast<std::uint8_t>(pin);
}

// Each character is two bytes of seven bits.
std::string text_of(std::span<const std::uint8_t> pairs) {
  std::string text;
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
    text += static_cast<char>(pairs[i] | (pairs[i + 1] & 1) << 7);
  return text;
}

bool carries_two_bytes(std::uint8_t command) {
  const auto kind = static_cast<std::uint8_t>(command & 0xF0);
  return kind == kAnalog || kind == kDigital || command == kVersion;
}

}  // namespace

Bytes version_query() { return {kVersion}; }

Bytes firmware_query() { return {kStartSysex, kFirmware, kEndSysex}; }

Bytes servo_config(int pin, int least, int most) {
  Bytes bytes{kStartSysex, kServoConfig, pin_byte(pin)};
  add_seven_bits(bytes, least);
  add_seven_bits(bytes, most);
  bytes.push_back(kEndSysex);
  return bytes;
}

Bytes servo_mode(int pin) { return {kPinMode, pin_byte(pin), kServo}; }

Bytes servo_pulse(int pin, int microseconds) {
  Bytes bytes{kStartSysex, kExtendedAnalog, pin_byte(pin)};
  add_seven_bits(bytes, microseconds);
  bytes.push_back(kEndSysex);
  return bytes;
}

std::vector<Message> Reader::take(std::span<const std::uint8_t> bytes) {
  std::vector<Message> messages;
  for (const std::uint8_t byte : bytes) take(byte, messages);
  return messages;
}

void Reader::take(std::uint8_t byte, std::vector<Message>& messages) {
  const bool command = byte & 0x80;
  if (command && byte != kEndSysex) {
    message_.assign(1, byte);
    return;
  }
  if (message_.empty()) return;
  if (message_.front() == kStartSysex) {
    if (byte == kEndSysex) return finish(messages);
    message_.push_back(byte);
    if (message_.size() > kLongestSysex) message_.clear();
    return;
  }
  message_.push_back(byte);
  if (command || !carries_two_bytes(message_.front())) return message_.clear();
  if (message_.size() == 3) finish(messages);
}

void Reader::finish(std::vector<Message>& messages) {
  const Bytes message = std::move(message_);
  message_.clear();
  if (message.front() == kVersion) {
    messages.push_back(Version{message[1], message[2]});
  } else if (message.front() == kStartSysex && message.size() >= 2) {
    const auto data = std::span(message).subspan(2);
    if (message[1] == kString) messages.push_back(Text{text_of(data)});
    if (message[1] == kFirmware && data.size() >= 2)
      messages.push_back(Firmware{data[0], data[1], text_of(data.subspan(2))});
  }
}

}  // namespace armsreach::firmata
