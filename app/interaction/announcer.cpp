#include "app/interaction/announcer.hpp"

#include <algorithm>
#include <limits>

namespace armsreach::app {

void Announcer::note(const Sentence& sentence) {
  const auto [found, fresh] = subjects_.try_emplace(sentence.subject);
  Subject& subject = found->second;
  if (fresh) subject.earliest = std::numeric_limits<Timestamp>::min();
  subject.newest = sentence;
  if (sentence.text.empty()) subject.said.clear();
}

std::vector<Sentence> Announcer::due(Timestamp now) {
  std::vector<Sentence> sentences;
  for (auto& [name, subject] : subjects_) {
    if (subject.newest.text == subject.said || now < subject.earliest) continue;
    subject.said = subject.newest.text;
    subject.earliest = now + kPause;
    sentences.push_back(subject.newest);
  }
  std::stable_sort(sentences.begin(), sentences.end(), [](const Sentence& a, const Sentence& b) {
    return a.urgency != b.urgency ? a.urgency > b.urgency : a.time < b.time;
  });
  for (Sentence& sentence : sentences) sentence.time = now;
  return sentences;
}

}  // namespace armsreach::app
