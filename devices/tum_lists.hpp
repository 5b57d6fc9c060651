// Codec of the text lists in a TUM RGB-D recording. Source: Sturm, Engelhard, Endres, Burgard,
// Cremers, "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012.
#pragma once

#include <istream>
#include <string>
#include <vector>

#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

struct ListedFile {
  Timestamp time = 0;
  std::string file;  // as written: relative to the recording's folder
  std::string line;  // where it is written: "recording/rgb.txt:12"
};

// A pair of images, or a single one where the recording has no other kind (its file is empty).
struct ListedFrame {
  ListedFile color;
  ListedFile depth;

  // Poses are the depth camera's, so its clock is the frame's.
  Timestamp time() const { return depth.file.empty() ? color.time : depth.time; }
};

// `rgb.txt` or `depth.txt`: "time file" a line, '#' comments. Times increase; an empty list is an
// error. Errors name the line.
Result<std::vector<ListedFile>> read_tum_list(std::istream& in, const std::string& where);

// `associations.txt`: "time colour-file time depth-file" a line.
Result<std::vector<ListedFrame>> read_tum_associations(std::istream& in, const std::string& where);

// Pairs of images that are each other's nearest in time and within 20 ms.
std::vector<ListedFrame> associate(const std::vector<ListedFile>& color,
                                   const std::vector<ListedFile>& depth);

}  // namespace armsreach
