#pragma once

namespace armsreach::app {

// Largest resident set of this process so far, in megabytes (2^20 bytes).
double peak_memory_mb();

}  // namespace armsreach::app
