#include "devices/speech/simulated_voice.hpp"

#include <algorithm>
#include <limits>

#include "devices/speech/synthesis.hpp"

namespace armsreach {
namespace {

Timestamp duration(const Sound& sound) { return timestamp_from_seconds(sound.seconds()); }

}  // namespace

void SimulatedVoice::say(const Sentence& sentence) {
  const std::lock_guard lock(mutex_);
  now_ = sentence.time;
  speak_until(now_);
  queue_.push(sentence, now_);
}

// What came at `time` itself is still open to something more urgent of the same instant.
void SimulatedVoice::speak_until(Timestamp time) {
  while (!queue_.empty() && free_ < time) {
    const Timestamp start = std::max(free_, *queue_.oldest());
    if (start >= time) return;
    const auto sentence = queue_.take(start);
    if (!sentence) return;
    auto sound = std::make_shared<const Sound>(synthesised(sentence->text));
    free_ = start + duration(*sound);
    said_.push_back({start, sentence->text, std::move(sound)});
  }
}

std::int64_t SimulatedVoice::dropped() const {
  const std::lock_guard lock(mutex_);
  return queue_.dropped();
}

Status SimulatedVoice::rest() {
  const std::lock_guard lock(mutex_);
  queue_.clear();
  if (said_.empty() || free_ <= now_) return ok();
  Said& last = said_.back();
  Sound cut = *last.sound;
  const double spoken = seconds_from_timestamp(std::max<Timestamp>(now_ - last.start, 0));
  cut.samples.resize(std::min(cut.samples.size(),
                              static_cast<std::size_t>(spoken * static_cast<double>(cut.rate))));
  last.sound = std::make_shared<const Sound>(std::move(cut));
  free_ = now_;
  return ok();
}

std::vector<SimulatedVoice::Said> SimulatedVoice::said() {
  const std::lock_guard lock(mutex_);
  speak_until(std::numeric_limits<Timestamp>::max());
  return said_;
}

SoundTrack SimulatedVoice::track() {
  SoundTrack track;
  for (const Said& said : this->said()) track.push_back({said.start, said.sound});
  return track;
}

}  // namespace armsreach
