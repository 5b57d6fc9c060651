// The truth that a recording keeps: truth.jsonl and the images that it names.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "devices/truth_json.hpp"
#include "vision/core/result.hpp"
#include "vision/core/time.hpp"

namespace armsreach {

class RecordedTruth {
 public:
  // Empty where the folder has no truth.jsonl.
  static Result<RecordedTruth> open(const std::filesystem::path& folder);

  // Of the frame at this time; null where there is none.
  Result<std::shared_ptr<const Truth>> at(Timestamp time, double units_per_metre) const;

 private:
  std::filesystem::path folder_;
  std::vector<TruthLine> lines_;
};

}  // namespace armsreach
