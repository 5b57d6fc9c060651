// Source time: nanoseconds since the source's own zero. Wall-clock time never enters results.
#pragma once

#include <cmath>
#include <cstdint>

namespace armsreach {

using Timestamp = std::int64_t;  // ns

inline Timestamp timestamp_from_seconds(double seconds) {
  return static_cast<Timestamp>(std::llround(seconds * 1e9));
}
inline double seconds_from_timestamp(Timestamp time) { return static_cast<double>(time) * 1e-9; }

}  // namespace armsreach
