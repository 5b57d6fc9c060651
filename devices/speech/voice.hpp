// A voice: says sentences one after the other, the most urgent first.
#pragma once

#include <cstdint>
#include <memory>

#include "devices/actuator.hpp"
#include "devices/speech/sentence.hpp"

namespace armsreach {

// All calls may come from any thread. rest() is silence at once; the next sentence is said again.
class Voice : public Actuator {
 public:
  // Never waits. Errors, such as a device that has gone, are events.
  virtual void say(const Sentence& sentence) = 0;

  // Sentences that could not be said in time.
  virtual std::int64_t dropped() const = 0;
};

}  // namespace armsreach
