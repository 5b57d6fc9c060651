#include "devices/firmata_gimbal.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <stop_token>
#include <utility>
#include <variant>

#include "devices/firmata.hpp"
#include "devices/serial_port.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kStopLatency = 50ms;
constexpr auto kBetweenQueries = 500ms;  // a board that resets misses the first ones
constexpr auto kWrite = 200ms;           // 8 bytes of 57600 baud take 1.4 ms
constexpr auto kAnswer = 500ms;

double pulse_of(const FirmataServos& servos, std::size_t axis, double angle) {
  return servos.zero_us[axis] + servos.us_per_degree[axis] * angle * 180 / std::numbers::pi;
}

class FirmataDriver final : public GimbalDriver {
 public:
  explicit FirmataDriver(FirmataServos servos) : servos_(std::move(servos)) {}

  Status connect(const std::stop_token& stop) override {
    port_.reset();
    auto opened = SerialPort::open(servos_.port, servos_.baud);
    if (!opened) return std::move(opened).error();
    port_ = std::move(*opened);
    reader_ = {};
    if (auto status = shake_hands(stop); !status) {
      port_.reset();
      return status;
    }
    return configure();
  }

  Status move(const Eigen::Vector3d& angles) override {
    firmata::Bytes bytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double pulse = pulse_of(servos_, axis, angles[static_cast<Eigen::Index>(axis)]);
      append(bytes, firmata::servo_pulse(servos_.pins[axis], static_cast<int>(std::lround(pulse))));
    }
    return write(bytes);
  }

  // Asks for the version: a board that hangs does not answer, though its line is open.
  Status check() override {
    if (auto status = write(firmata::version_query()); !status) return status;
    const auto deadline = Clock::now() + kAnswer;
    while (Clock::now() < deadline) {
      auto messages = read();
      if (!messages) return messages.error();
      for (const firmata::Message& message : *messages)
        if (std::holds_alternative<firmata::Version>(message)) return ok();
    }
    return Error{"the board no longer answers", servos_.port, "unplug it and plug it in again",
                 Error::Kind::away};
  }

 private:
  Status shake_hands(const std::stop_token& stop) {
    bool version = false;
    bool firmware = false;
    const auto deadline = Clock::now() + servos_.handshake;
    auto query = Clock::now();
    while (Clock::now() < deadline && !stop.stop_requested()) {
      if (Clock::now() >= query) {
        firmata::Bytes bytes = firmata::version_query();
        append(bytes, firmata::firmware_query());
        if (auto status = write(bytes); !status) return status;
        query = Clock::now() + kBetweenQueries;
      }
      auto messages = read();
      if (!messages) return messages.error();
      for (const firmata::Message& message : *messages) {
        if (const auto* said = std::get_if<firmata::Version>(&message)) {
          if (said->major != 2) return other_version(*said);
          version = true;
        }
        firmware = firmware || std::holds_alternative<firmata::Firmware>(message);
      }
      if (version && firmware) return ok();
    }
    return Error{"the board does not answer as Firmata does", servos_.port,
                 "load File > Examples > Firmata > StandardFirmata onto it with the Arduino IDE",
                 Error::Kind::device};
  }

  Error other_version(const firmata::Version& version) const {
    return {"the board speaks Firmata " + std::to_string(version.major) + "." +
                std::to_string(version.minor) + ", not 2.x",
            servos_.port, "load a current StandardFirmata onto it", Error::Kind::device};
  }

  Status configure() {
    firmata::Bytes bytes;
    for (const int pin : servos_.pins) {
      append(bytes, firmata::servo_config(pin, static_cast<int>(kShortestPulse),
                                          static_cast<int>(kLongestPulse)));
      append(bytes, firmata::servo_mode(pin));
    }
    return write(bytes);
  }

  static void append(firmata::Bytes& bytes, const firmata::Bytes& more) {
    bytes.insert(bytes.end(), more.begin(), more.end());
  }

  Status write(const firmata::Bytes& bytes) {
    if (!port_) {
      return Error{"the board is not there", servos_.port, "check its cable; it is waited for",
                   Error::Kind::away};
    }
    return port_->write(bytes, kWrite);
  }

  Result<std::vector<firmata::Message>> read() {
    auto bytes = port_->read(kStopLatency);
    if (!bytes) return std::move(bytes).error();
    return reader_.take(*bytes);
  }

  FirmataServos servos_;
  std::optional<SerialPort> port_;
  firmata::Reader reader_;
};

Status check_servos(const FirmataServos& servos, const GimbalModel& model) {
  constexpr std::array kAxes{"pan", "tilt", "roll"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (servos.pins[axis] < 0 || servos.pins[axis] >= firmata::kMostPins) {
      return Error{"pin " + std::to_string(servos.pins[axis]) + " of " + kAxes[axis], servos.port,
                   "pins are from 0 to 127"};
    }
    const auto index = static_cast<Eigen::Index>(axis);
    for (const double angle : {model.lower[index], model.upper[index]}) {
      const double pulse = pulse_of(servos, axis, angle);
      if (pulse >= kShortestPulse && pulse <= kLongestPulse) continue;
      return Error{std::string("the limit of ") + kAxes[axis] + " needs a pulse of " +
                       std::to_string(std::lround(pulse)) + " us",
                   servos.port,
                   "servos take 544 to 2400 us: narrow lower_deg and upper_deg, or correct zero_us "
                   "and us_per_degree"};
    }
  }
  return ok();
}

}  // namespace

Result<std::shared_ptr<Gimbal>> open_firmata_gimbal(const FirmataServos& servos,
                                                    const std::string& name,
                                                    const GimbalModel& model) {
  if (auto status = check_servos(servos, model); !status) return status.error();
  auto driver = std::make_unique<FirmataDriver>(servos);
  if (auto status = driver->connect({}); !status) return status.error();
  return live_gimbal(std::move(driver), name, model);
}

}  // namespace armsreach
