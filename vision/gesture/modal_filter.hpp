// The most frequent of the names seen lately: a gesture told wrongly in a frame or two is not
// noticed.
#pragma once

#include <deque>
#include <string>

#include "vision/core/time.hpp"

namespace armsreach::gesture {

class ModalFilter {
 public:
  struct Mode {
    std::string name;  // empty: mostly nothing could be told
    double score = 0;  // mean of the frames that agree
    double share = 0;  // of the frames that agree, 0..1
  };

  // `window` in seconds of source time, so that skipped frames do not change how long it takes.
  explicit ModalFilter(double window) : window_(window) {}

  // Of equally frequent names the one that was the mode before stays, else the newest wins.
  const Mode& update(const std::string& name, double score, Timestamp time);
  const Mode& mode() const { return mode_; }

 private:
  struct Seen {
    Timestamp time;
    std::string name;
    double score;
  };
  double window_;
  std::deque<Seen> seen_;
  Mode mode_;
};

}  // namespace armsreach::gesture
