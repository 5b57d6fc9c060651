#include "devices/speech/sentence_queue.hpp"

#include <algorithm>

namespace armsreach {
namespace {

bool less_urgent(const Sentence& a, const Sentence& b) { return a.urgency < b.urgency; }

}  // namespace

void SentenceQueue::push(const Sentence& sentence, Timestamp now) {
  std::erase_if(waiting_, [&](const Waiting& w) { return w.sentence.subject == sentence.subject; });
  waiting_.push_back({sentence, now});
  if (waiting_.size() <= kCapacity) return;
  waiting_.erase(std::min_element(
      waiting_.begin(), waiting_.end(),
      [](const Waiting& a, const Waiting& b) { return less_urgent(a.sentence, b.sentence); }));
  ++dropped_;
}

std::optional<Sentence> SentenceQueue::take(Timestamp now) {
  dropped_ += static_cast<std::int64_t>(
      std::erase_if(waiting_, [&](const Waiting& w) { return now - w.since > kPatience; }));
  const auto next = std::max_element(
      waiting_.begin(), waiting_.end(),
      [](const Waiting& a, const Waiting& b) { return less_urgent(a.sentence, b.sentence); });
  if (next == waiting_.end()) return std::nullopt;
  Sentence sentence = std::move(next->sentence);
  waiting_.erase(next);
  return sentence;
}

std::optional<Timestamp> SentenceQueue::oldest() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.front().since;
}

}  // namespace armsreach
