#include "app/runtime/progress.hpp"

#include <cstdio>
#include <unistd.h>

namespace armsreach::app {
namespace {

constexpr std::chrono::seconds kInterval(1);

}  // namespace

Progress::Progress()
    : terminal_(isatty(STDERR_FILENO) == 1), shown_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (written_) std::fputs("\r\033[K", stderr);
}

bool Progress::due() const {
  return terminal_ && std::chrono::steady_clock::now() - shown_ >= kInterval;
}

void Progress::show(const std::string& line) {
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  shown_ = std::chrono::steady_clock::now();
  written_ = true;
}

}  // namespace armsreach::app
