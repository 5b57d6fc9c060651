// Where events go: a JSON Lines file, when asked for, and the last few for the panels.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "app/runtime/output_file.hpp"
#include "vision/core/event.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

class EventLog {
 public:
  // "" keeps events in memory only.
  Status open(const std::string& path) { return file_.open(path); }
  void write(const Event& event);  // from any thread
  // Called with every event, by the thread that writes it. Set while nobody writes.
  void set_listener(std::function<void(const Event&)> listener) { listener_ = std::move(listener); }
  // Source time of the newest frame, for events that belong to none.
  void set_now(Timestamp time) { now_.store(time, std::memory_order_relaxed); }
  Timestamp now() const { return now_.load(std::memory_order_relaxed); }
  std::vector<Event> recent() const;  // newest last
  // Says whether everything reached the disk.
  Status close();

 private:
  std::atomic<Timestamp> now_{0};
  static constexpr std::size_t kRecent = 16;
  std::function<void(const Event&)> listener_;
  mutable std::mutex mutex_;
  OutputFile file_;
  std::deque<Event> recent_;
};

}  // namespace armsreach::app
