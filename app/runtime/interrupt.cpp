#include "app/runtime/interrupt.hpp"

#include <array>
#include <csignal>
#include <cstdint>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>
#include <utility>

namespace armsreach::app {
namespace {

constexpr int kExitAfterSecondSignal = 130;

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

void watch(int signals, int done, const std::function<void()>& on_interrupt) {
  std::array<pollfd, 2> files = {pollfd{signals, POLLIN, 0}, pollfd{done, POLLIN, 0}};
  for (int count = 0;;) {
    if (poll(files.data(), files.size(), -1) < 0) continue;  // interrupted by another signal
    if (files[1].revents) return;
    signalfd_siginfo info;
    if (read(signals, &info, sizeof info) != sizeof info) return;
    if (++count > 1) _exit(kExitAfterSecondSignal);
    on_interrupt();
  }
}

}  // namespace

InterruptGuard::InterruptGuard(std::function<void()> on_interrupt) {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signals_ = signalfd(-1, &set, SFD_CLOEXEC);
  done_ = eventfd(0, EFD_CLOEXEC);
  thread_ = std::jthread([signals = signals_, done = done_, handler = std::move(on_interrupt)] {
    watch(signals, done, handler);
  });
}

InterruptGuard::~InterruptGuard() {
  const std::uint64_t one = 1;
  if (write(done_, &one, sizeof one) != sizeof one) _exit(kExitAfterSecondSignal);
  thread_.join();
  close(signals_);
  close(done_);
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace armsreach::app
