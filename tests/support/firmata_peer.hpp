// A board that speaks Firmata, at the other end of a pseudo-terminal. Decodes what it is sent by
// itself, not with the program's codec.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace armsreach::test {

class FirmataPeer {
 public:
  struct Board {
    bool answers{true};
    std::vector<std::uint8_t> noise{};  // sent before each answer
    int major{2};
  };

  // `port` becomes a link to the terminal, as udev makes them; an earlier one is replaced.
  FirmataPeer(std::filesystem::path port, Board board);
  explicit FirmataPeer(std::filesystem::path port) : FirmataPeer(std::move(port), Board()) {}
  ~FirmataPeer() { unplug(); }

  // The link goes and the line breaks.
  void unplug();
  // From now on the line is open and nothing comes back.
  void hang();

  // Waits until it has seen that; false when `limit` passes first.
  struct Seen {
    std::map<int, int> pulses;                                    // us, the last of each pin
    std::map<int, std::pair<int, int>> configured;                // pins: least and most us
    std::set<int> servos;                                         // pins in that mode
    std::vector<std::chrono::steady_clock::time_point> commands;  // to the first pin
  };
  bool wait_for(const std::function<bool(const Seen&)>& condition,
                std::chrono::milliseconds limit = std::chrono::seconds(5));
  Seen seen() const;

 private:
  void serve();
  void take(std::uint8_t byte);
  void take_sysex();
  void answer(std::vector<std::uint8_t> bytes);

  std::filesystem::path port_;
  Board board_;
  int master_ = -1;
  int slave_ = -1;
  int wake_[2] = {-1, -1};  // a pipe that ends the thread
  std::vector<std::uint8_t> message_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Seen seen_;
  std::thread thread_;
};

}  // namespace armsreach::test
