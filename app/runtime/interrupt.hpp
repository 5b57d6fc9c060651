// Ctrl-C, termination and a closed terminal as an orderly end: the handler runs on a thread of its
// own, so it may lock and wake as it likes; another one, half a second later or more, ends the
// program at once. One guard at a time.
#pragma once

#include <csignal>
#include <functional>
#include <thread>

namespace armsreach::app {

class InterruptGuard {
 public:
  explicit InterruptGuard(std::function<void()> on_interrupt);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_hang_up_ {};
  std::jthread thread_;
};

}  // namespace armsreach::app
