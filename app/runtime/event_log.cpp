#include "app/runtime/event_log.hpp"

#include <nlohmann/json.hpp>

namespace armsreach::app {

void EventLog::write(const Event& event) {
  const std::string line =
      json_from_event(event).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  {
    const std::lock_guard lock(mutex_);
    recent_.push_back(event);
    if (recent_.size() > kRecent) recent_.pop_front();
    // Flushed line by line: a program that dies has still said what happened.
    if (file_.is_open()) file_.stream() << line << std::endl;
  }
  if (listener_) listener_(event);
}

std::vector<Event> EventLog::recent() const {
  const std::lock_guard lock(mutex_);
  return {recent_.begin(), recent_.end()};
}

Status EventLog::close() {
  const std::lock_guard lock(mutex_);
  return file_.close();
}

}  // namespace armsreach::app
