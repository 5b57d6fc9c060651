// Source time: nanoseconds since the source's own zero. Wall-clock time never enters results.
#pragma once

#include <cmath>
#include <cstdint>

namespace armsreach {

using Timestamp = std::int64_t;  // ns

// What is read from a file is refused beyond this: sums and differences stay within a Timestamp.
constexpr double kLatestTime = 4e9;  // s, the year 2096 for those who count from 1970

inline Timestamp timestamp_from_seconds(double seconds) {
  return static_cast<Timestamp>(std::llround(seconds * 1e9));
}
// Divided, not multiplied by 1e-9: the nearest double, so that 15 s is written as 15.
inline double seconds_from_timestamp(Timestamp time) { return static_cast<double>(time) / 1e9; }

}  // namespace armsreach
