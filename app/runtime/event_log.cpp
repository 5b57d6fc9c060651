#include "app/runtime/event_log.hpp"

#include <nlohmann/json.hpp>

namespace armsreach::app {

Status EventLog::open(const std::string& path) {
  path_ = path;
  if (path.empty()) return ok();
  file_.open(path);
  if (!file_) return Error{"cannot be written", path, "check that its folder exists and is yours"};
  return ok();
}

void EventLog::write(const Event& event) {
  const std::string line = json_from_event(event).dump();
  const std::lock_guard lock(mutex_);
  recent_.push_back(event);
  if (recent_.size() > kRecent) recent_.pop_front();
  // Flushed line by line: a program that dies has still said what happened.
  if (file_.is_open()) file_ << line << std::endl;
}

std::vector<Event> EventLog::recent() const {
  const std::lock_guard lock(mutex_);
  return {recent_.begin(), recent_.end()};
}

Status EventLog::close() {
  const std::lock_guard lock(mutex_);
  if (!file_.is_open()) return ok();
  file_.close();
  if (!file_) {
    return Error{"could not be written completely", path_, "is the disk full?",
                 Error::Kind::device};
  }
  return ok();
}

}  // namespace armsreach::app
