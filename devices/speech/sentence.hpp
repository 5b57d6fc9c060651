// Something to say.
#pragma once

#include <string>

#include "vision/core/time.hpp"

namespace armsreach {

enum class Urgency { remark, notice, warning };  // rising

struct Sentence {
  std::string subject;  // "tracking": what is said later of the same subject makes this out of date
  std::string text;     // a sentence in English
  Urgency urgency = Urgency::remark;
  Timestamp time = 0;     // source time from which it holds
  Timestamp lasting = 0;  // ns that it must have held before it is worth saying
};

}  // namespace armsreach
