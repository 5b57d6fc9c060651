// Sentences that wait for the one being said to end. Pure: whoever says them has the clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "devices/speech/sentence.hpp"

namespace armsreach {

class SentenceQueue {
 public:
  static constexpr std::size_t kCapacity = 8;
  static constexpr Timestamp kPatience = 4'000'000'000;  // ns that what is said still matters

  // Takes the place of one that waits with the same subject. When full, the least urgent goes.
  void push(const Sentence& sentence, Timestamp now);

  // The most urgent, of equal ones the oldest. Those that waited too long are dropped.
  std::optional<Sentence> take(Timestamp now);

  std::optional<Timestamp> oldest() const;  // arrival of the one that has waited longest
  void clear() { waiting_.clear(); }
  bool empty() const { return waiting_.empty(); }
  std::int64_t dropped() const { return dropped_; }

 private:
  struct Waiting {
    Sentence sentence;
    Timestamp since;
  };
  std::vector<Waiting> waiting_;  // in order of arrival
  std::int64_t dropped_ = 0;
};

}  // namespace armsreach
