// Codec of truth.jsonl: the truth of one frame a line,
//
//   {"t": s, "world_from_camera": POSE, "depth": FILE, "masks": FILE,
//    "gimbal": {"angles": [pan, tilt, roll], "rates": [..]},
//    "things": [{"name", "mask", "world_from_thing": POSE}, ...],
//    "hands": [{"name", "mask", "gesture", "world_from_joint": [25 x POSE]}, ...],
//    "markers": [{"name", "point_in_world": [x, y, z], "visible"}, ...],
//    "contacts": [["hammer", "baton"], ...]}
//
// with poses as in events: {"translation": [x, y, z], "rotation": [x, y, z, w]}. What a frame has
// not got is left out. Numbers keep all their digits.
#pragma once

#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "devices/truth.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

struct TruthLine {
  Timestamp time = 0;
  Truth truth;             // without its images
  std::string depth_file;  // relative to the recording's folder, or empty
  std::string masks_file;
};

// Times increase; errors name the line.
Result<std::vector<TruthLine>> read_truth_lines(std::istream& in, const std::string& where);
void write_truth_line(std::ostream& out, const TruthLine& line);

}  // namespace armsreach
