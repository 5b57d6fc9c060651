#include "devices/serial_port.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace armsreach {
namespace {

std::optional<speed_t> speed_of(int baud) {
  switch (baud) {
    case 9600:
      return B9600;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    default:
      return std::nullopt;
  }
}

Error not_opened(const std::string& path, int reason) {
  std::string remedy = "sudo fuser -v " + path + " shows who uses it";
  if (reason == ENOENT || reason == ENXIO || reason == ENODEV)
    remedy = "plug the board in; `armsreach sources` lists the ports that are there";
  if (reason == EACCES || reason == EPERM)
    remedy = "sudo usermod -aG dialout $USER, then log in again";
  return {std::strerror(reason), path, remedy, Error::Kind::device};
}

bool configure(int handle, speed_t speed) {
  termios line{};
  if (tcgetattr(handle, &line) != 0) return false;
  cfmakeraw(&line);
  line.c_cflag |= CLOCAL | CREAD | HUPCL;
  line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  line.c_cc[VMIN] = 0;
  line.c_cc[VTIME] = 0;
  cfsetispeed(&line, speed);
  cfsetospeed(&line, speed);
  return tcsetattr(handle, TCSANOW, &line) == 0;
}

// Whether the line can do `events` before the limit.
enum class Readiness { ready, silent, gone };
Readiness wait_for(int handle, short events, std::chrono::milliseconds limit) {
  pollfd line{handle, events, 0};
  const int count = poll(&line, 1, static_cast<int>(limit.count()));
  if (count < 0) return errno == EINTR ? Readiness::silent : Readiness::gone;
  if (count == 0) return Readiness::silent;
  return line.revents & events ? Readiness::ready : Readiness::gone;
}

}  // namespace

Result<SerialPort> SerialPort::open(const std::string& path, int baud) {
  const auto speed = speed_of(baud);
  if (!speed) return Error{std::to_string(baud) + " baud", path, "give 9600, 57600 or 115200"};
  const int handle = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (handle < 0) return not_opened(path, errno);
  SerialPort port(path, handle);
  if (ioctl(handle, TIOCEXCL) != 0 || !configure(handle, *speed)) return not_opened(path, errno);
  return port;
}

SerialPort::~SerialPort() {
  if (handle_ < 0) return;
  close(handle_);  // what is written goes out first
}

Error SerialPort::gone(const std::string& what) const {
  return {what, path_, "check its cable; it is waited for", Error::Kind::away};
}

Status SerialPort::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds limit) {
  while (!bytes.empty()) {
    if (wait_for(handle_, POLLOUT, limit) != Readiness::ready)
      return gone("the serial line takes nothing");
    const ssize_t count = ::write(handle_, bytes.data(), bytes.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) return gone("the serial line has gone");
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return ok();
}

Result<std::vector<std::uint8_t>> SerialPort::read(std::chrono::milliseconds limit) {
  std::vector<std::uint8_t> bytes(256);
  switch (wait_for(handle_, POLLIN, limit)) {
    case Readiness::silent:
      return std::vector<std::uint8_t>();
    case Readiness::gone:
      return gone("the serial line has gone");
    case Readiness::ready:
      break;
  }
  const ssize_t count = ::read(handle_, bytes.data(), bytes.size());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return std::vector<std::uint8_t>();
  if (count <= 0) return gone("the serial line has gone");
  bytes.resize(static_cast<std::size_t>(count));
  return bytes;
}

}  // namespace armsreach
