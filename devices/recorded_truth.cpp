#include "devices/recorded_truth.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <utility>

#include "devices/files.hpp"
#include "devices/image_file.hpp"

namespace armsreach {
namespace {

// Times are written in decimals of a second.
constexpr Timestamp kSameTime = 1000;  // ns

}  // namespace

Result<RecordedTruth> RecordedTruth::open(const std::filesystem::path& folder) {
  RecordedTruth truth;
  truth.folder_ = folder;
  const std::filesystem::path file = folder / "truth.jsonl";
  if (!file_exists(file)) return truth;
  std::ifstream in(file);
  auto lines = read_truth_lines(in, file.string());
  if (!lines) return std::move(lines).error();
  truth.lines_ = std::move(*lines);
  for (const TruthLine& line : truth.lines_) {
    for (const std::string& name : {line.depth_file, line.masks_file}) {
      if (name.empty() || stays_inside(name)) continue;
      return Error{"'" + name + "' leaves the recording's folder", file.string(),
                   "name files below the folder, by relative paths"};
    }
  }
  return truth;
}

Result<std::shared_ptr<const Truth>> RecordedTruth::at(Timestamp time,
                                                       double units_per_metre) const {
  const auto line =
      std::lower_bound(lines_.begin(), lines_.end(), time - kSameTime,
                       [](const TruthLine& one, Timestamp t) { return one.time < t; });
  if (line == lines_.end() || std::abs(line->time - time) > kSameTime)
    return std::shared_ptr<const Truth>();
  auto truth = std::make_shared<Truth>(line->truth);
  if (!line->masks_file.empty()) {
    auto masks = read_mask_image(folder_ / line->masks_file);
    if (!masks) return std::move(masks).error();
    truth->masks = *masks;
  }
  if (!line->depth_file.empty()) {
    auto depth = read_depth_image(folder_ / line->depth_file, units_per_metre);
    if (!depth) return std::move(depth).error();
    truth->depth = *depth;
  }
  return std::shared_ptr<const Truth>(std::move(truth));
}

}  // namespace armsreach
