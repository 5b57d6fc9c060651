// What a gimbal was told, for whoever records it. Most runs record nothing: the oldest is
// forgotten.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "vision/core/gimbal.hpp"

namespace armsreach {

class CommandLog {
 public:
  static constexpr std::size_t kMost = 1000;  // half a minute's, at a camera's rate

  void add(const GimbalCommand& command) {
    commands_.push_back(command);
    if (commands_.size() > kMost) commands_.pop_front();
  }

  std::vector<GimbalCommand> take() {
    std::vector<GimbalCommand> taken(commands_.begin(), commands_.end());
    commands_.clear();
    return taken;
  }

 private:
  std::deque<GimbalCommand> commands_;
};

}  // namespace armsreach
