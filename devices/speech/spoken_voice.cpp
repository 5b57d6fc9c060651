#include "devices/speech/spoken_voice.hpp"

#include <chrono>
#include <utility>

#include "devices/speech/loudspeaker.hpp"
#include "devices/speech/synthesis.hpp"

namespace armsreach {
namespace {

// Waiting is measured by the clock of those who listen, not by source time.
Timestamp clock_now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

SpokenVoice::SpokenVoice(Player player)
    : player_(std::move(player)), thread_([this] { speak(); }) {}

SpokenVoice::~SpokenVoice() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void SpokenVoice::say(const Sentence& sentence) {
  {
    const std::lock_guard lock(mutex_);
    queue_.push(sentence, clock_now());
  }
  changed_.notify_all();
}

std::int64_t SpokenVoice::dropped() const {
  const std::lock_guard lock(mutex_);
  return queue_.dropped();
}

Status SpokenVoice::rest() {
  const std::lock_guard lock(mutex_);
  queue_.clear();
  stop_ = true;
  return ok();
}

Events SpokenVoice::take_events() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

void SpokenVoice::speak() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !queue_.empty() || closing_; });
    if (closing_) return;
    const auto sentence = queue_.take(clock_now());
    if (!sentence) continue;
    stop_ = false;
    lock.unlock();
    const Status played = player_(synthesised(sentence->text), stop_);
    lock.lock();
    note(played, sentence->time);
  }
}

void SpokenVoice::note(const Status& played, Timestamp time) {
  const bool failed_before = std::exchange(failing_, !played);
  if (played || failed_before) return;
  const Error& error = played.error();
  events_.push_back({time, FaultEvent{name_, error.where + ": " + error.what, error.remedy}});
}

std::unique_ptr<Voice> make_spoken_voice(const std::string& device) {
  return std::make_unique<SpokenVoice>([device](const Sound& sound, const std::atomic<bool>& stop) {
    return play(device, sound, stop);
  });
}

}  // namespace armsreach
