// A serial line of a microcontroller board: eight bits, no parity, no flow control.
//
// Opened through termios: libserialport 0.1.1, which lists the ports (sources), insists on modem
// lines and so opens no pseudo-terminal, such as those of socat and of the tests.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vision/core/result.hpp"

namespace armsreach {

class SerialPort {
 public:
  // 9600, 57600 or 115200 baud. A board that resets when its port is opened does so.
  static Result<SerialPort> open(const std::string& path, int baud);

  SerialPort(SerialPort&& other) noexcept
      : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, -1)) {}
  SerialPort& operator=(SerialPort&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~SerialPort();

  // Error::Kind::away when the line has gone, or takes nothing for `limit`.
  Status write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds limit);
  // What has come, as soon as something has; nothing after `limit`.
  Result<std::vector<std::uint8_t>> read(std::chrono::milliseconds limit);

 private:
  SerialPort(std::string path, int handle) : path_(std::move(path)), handle_(handle) {}
  Error gone(const std::string& what) const;

  std::string path_;
  int handle_;
};

}  // namespace armsreach
