#include "tests/support/firmata_peer.hpp"

#include <poll.h>
#include <pty.h>
#include <stdexcept>
#include <termios.h>
#include <unistd.h>

namespace armsreach::test {

FirmataPeer::FirmataPeer(std::filesystem::path port, Board board)
    : port_(std::move(port)), board_(std::move(board)) {
  char name[256];
  termios raw{};
  cfmakeraw(&raw);
  if (openpty(&master_, &slave_, name, &raw, nullptr) != 0 || pipe(wake_) != 0)
    throw std::runtime_error("no pseudo-terminal");
  std::filesystem::remove(port_);
  std::filesystem::create_symlink(name, port_);
  thread_ = std::thread([this] { serve(); });
}

void FirmataPeer::unplug() {
  if (!thread_.joinable()) return;
  close(wake_[1]);
  thread_.join();
  std::filesystem::remove(port_);
  for (const int handle : {master_, slave_, wake_[0]}) close(handle);
}

void FirmataPeer::hang() {
  const std::lock_guard lock(mutex_);
  board_.answers = false;
}

bool FirmataPeer::wait_for(const std::function<bool(const Seen&)>& condition,
                           std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, limit, [&] { return condition(seen_); });
}

FirmataPeer::Seen FirmataPeer::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

void FirmataPeer::serve() {
  for (;;) {
    pollfd waiting[2] = {{master_, POLLIN, 0}, {wake_[0], 0, 0}};
    poll(waiting, 2, -1);
    if (waiting[1].revents) return;
    std::uint8_t bytes[256];
    const ssize_t count = read(master_, bytes, sizeof(bytes));
    const std::lock_guard lock(mutex_);
    for (ssize_t i = 0; i < count; ++i) take(bytes[i]);
    changed_.notify_all();
  }
}

void FirmataPeer::take(std::uint8_t byte) {
  message_.push_back(byte);
  const std::uint8_t command = message_.front();
  if (command == 0xF9) {
    message_.clear();
    answer({0xF9, static_cast<std::uint8_t>(board_.major), 6});
  } else if (command == 0xF4 && message_.size() == 3) {
    if (message_[2] == 4) seen_.servos.insert(message_[1]);
    message_.clear();
  } else if (command == 0xF0 && byte == 0xF7) {
    take_sysex();
    message_.clear();
  } else if (command < 0x80) {
    message_.clear();
  }
}

void FirmataPeer::take_sysex() {
  const auto number = [&](std::size_t at) { return message_.at(at) | message_.at(at + 1) << 7; };
  if (message_[1] == 0x79) answer({0xF0, 0x79, 2, 6, 'p', 0, 'e', 0, 'e', 0, 'r', 0, 0xF7});
  if (message_[1] == 0x70) seen_.configured[message_.at(2)] = {number(3), number(5)};
  if (message_[1] == 0x6F) {
    const int pin = message_.at(2);
    seen_.pulses[pin] = number(3);
    if (pin == seen_.pulses.begin()->first)
      seen_.commands.push_back(std::chrono::steady_clock::now());
  }
}

void FirmataPeer::answer(std::vector<std::uint8_t> bytes) {
  if (!board_.answers) return;
  bytes.insert(bytes.begin(), board_.noise.begin(), board_.noise.end());
  if (write(master_, bytes.data(), bytes.size()) < 0) throw std::runtime_error("the line is full");
}

}  // namespace armsreach::test
