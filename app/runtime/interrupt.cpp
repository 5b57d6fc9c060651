#include "app/runtime/interrupt.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <sys/eventfd.h>
#include <unistd.h>
#include <utility>

namespace armsreach::app {
namespace {

constexpr int kExitAfterSecondSignal = 130;
// One interruption may come twice: `timeout` signals the program and then its whole group.
constexpr std::int64_t kSameInterrupt = 500'000'000;  // ns
constexpr std::uint64_t kInterrupted = 1;
constexpr std::uint64_t kDone = std::uint64_t{1} << 32;

// All that a handler may touch: any thread, even a library's, may be the one that is interrupted.
std::atomic<int> event_file{-1};
std::atomic<std::int64_t> first_interrupt{0};  // monotonic ns; 0: none yet

void add(std::uint64_t what) {
  [[maybe_unused]] const ssize_t written = write(event_file.load(), &what, sizeof what);
}

std::int64_t monotonic_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // which a handler may call
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void on_signal(int) {
  const int saved = errno;
  const std::int64_t now = monotonic_now();
  std::int64_t first = 0;
  if (first_interrupt.compare_exchange_strong(first, now)) {
    add(kInterrupted);
  } else if (now - first > kSameInterrupt) {
    _exit(kExitAfterSecondSignal);
  }
  errno = saved;
}

void watch(const std::function<void()>& on_interrupt) {
  for (;;) {
    std::uint64_t sum = 0;
    if (read(event_file.load(), &sum, sizeof sum) != sizeof sum) {
      if (errno == EINTR) continue;
      return;
    }
    if (sum % kDone > 0) on_interrupt();
    if (sum >= kDone) return;
  }
}

}  // namespace

InterruptGuard::InterruptGuard(std::function<void()> on_interrupt) {
  first_interrupt = 0;
  event_file = eventfd(0, EFD_CLOEXEC);
  thread_ = std::jthread([handler = std::move(on_interrupt)] { watch(handler); });
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &old_interrupt_);
  sigaction(SIGTERM, &action, &old_terminate_);
  sigaction(SIGHUP, &action, &old_hang_up_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  sigaction(SIGHUP, &old_hang_up_, nullptr);
  add(kDone);
  thread_.join();
  close(event_file.exchange(-1));
}

}  // namespace armsreach::app
