#include "app/interaction/announcer.hpp"

#include <algorithm>
#include <limits>

namespace armsreach::app {

void Announcer::note(const Sentence& sentence) {
  const auto [found, fresh] = subjects_.try_emplace(sentence.subject);
  Subject& subject = found->second;
  if (fresh) subject.earliest = std::numeric_limits<Timestamp>::min();
  const Timestamp since =
      !fresh && subject.newest.text == sentence.text ? subject.newest.time : sentence.time;
  subject.newest = sentence;
  subject.newest.time = since;
  if (sentence.text.empty()) subject.said.clear();
}

std::vector<Sentence> Announcer::due(Timestamp now) {
  std::vector<Sentence> sentences;
  for (auto& [name, subject] : subjects_) {
    const Sentence& newest = subject.newest;
    if (newest.text == subject.said || now < subject.earliest) continue;
    if (now - newest.time < newest.lasting) continue;
    subject.said = newest.text;
    if (newest.urgency == Urgency::remark) {
      const auto [made, first] = subject.made.try_emplace(newest.text, now);
      if (!first && now - made->second < kRepeat) continue;
      made->second = now;
    }
    subject.earliest = now + kPause;
    sentences.push_back(newest);
  }
  std::stable_sort(sentences.begin(), sentences.end(), [](const Sentence& a, const Sentence& b) {
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.time < b.time;
  });
  for (Sentence& sentence : sentences) sentence.time = now;
  return sentences;
}

}  // namespace armsreach::app
