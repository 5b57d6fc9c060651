// Ctrl-C and termination as an orderly end: the handler runs on a thread of its own, so it may lock
// and wake as it likes; a second signal ends the program at once.
#pragma once

#include <functional>
#include <thread>

namespace armsreach::app {

class InterruptGuard {
 public:
  // To be made before other threads are started, so that they inherit the blocked signals.
  explicit InterruptGuard(std::function<void()> on_interrupt);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  int signals_ = -1;  // signalfd
  int done_ = -1;     // eventfd
  std::jthread thread_;
};

}  // namespace armsreach::app
