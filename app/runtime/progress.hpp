// One line that is written over itself, for a person who waits at a terminal; nothing when the
// output goes elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace armsreach::app {

class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Whether the line is a second old; ask before making a new one.
  bool due() const;
  void show(const std::string& line);

 private:
  bool terminal_;
  std::chrono::steady_clock::time_point shown_;
  bool written_ = false;
};

}  // namespace armsreach::app
