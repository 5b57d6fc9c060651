#include "app/runtime/memory.hpp"

#include <sys/resource.h>

namespace armsreach::app {

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux gives KiB
}

}  // namespace armsreach::app
