#include "devices/speech/spoken_voice.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <utility>

#include "devices/speech/loudspeaker.hpp"
#include "devices/speech/sentence_queue.hpp"
#include "devices/speech/synthesis.hpp"

namespace armsreach {
namespace {

constexpr std::chrono::seconds kFarewell{1};  // that a device has to fall silent at the end

// Waiting is measured by the clock of those who listen, not by source time.
Timestamp clock_now() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

struct SpokenVoice::State {
  explicit State(Player play_sound) : play(std::move(play_sound)) {}

  void note(const Status& played, Timestamp time);

  const Player play;
  std::atomic<bool> stop = false;
  std::mutex mutex;  // of all below
  std::condition_variable changed;
  SentenceQueue queue;
  Events events;
  bool failing = false;
  bool closing = false;
  bool ended = false;
};

SpokenVoice::SpokenVoice(Player player)
    : state_(std::make_shared<State>(std::move(player))),
      thread_([state = state_] { speak(state); }) {}

SpokenVoice::~SpokenVoice() {
  std::unique_lock lock(state_->mutex);
  state_->closing = true;
  state_->stop = true;
  state_->changed.notify_all();
  const bool ended = state_->changed.wait_for(lock, kFarewell, [this] { return state_->ended; });
  lock.unlock();
  ended ? thread_.join() : thread_.detach();
}

void SpokenVoice::say(const Sentence& sentence) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->queue.push(sentence, clock_now());
  }
  state_->changed.notify_all();
}

std::int64_t SpokenVoice::dropped() const {
  const std::lock_guard lock(state_->mutex);
  return state_->queue.dropped();
}

Status SpokenVoice::rest() {
  const std::lock_guard lock(state_->mutex);
  state_->queue.clear();
  state_->stop = true;
  return ok();
}

Events SpokenVoice::take_events() {
  const std::lock_guard lock(state_->mutex);
  return std::exchange(state_->events, {});
}

void SpokenVoice::speak(const std::shared_ptr<State>& state) {
  std::unique_lock lock(state->mutex);
  for (;;) {
    state->changed.wait(lock, [&] { return !state->queue.empty() || state->closing; });
    if (state->closing) break;
    const auto sentence = state->queue.take(clock_now());
    if (!sentence) continue;
    state->stop = false;
    lock.unlock();
    const Status played = state->play(synthesised(sentence->text), state->stop);
    lock.lock();
    state->note(played, sentence->time);
  }
  state->ended = true;
  state->changed.notify_all();
}

void SpokenVoice::State::note(const Status& played, Timestamp time) {
  const bool failed_before = std::exchange(failing, !played);
  if (played || failed_before) return;
  const Error& error = played.error();
  events.push_back({time, FaultEvent{"voice", error.where + ": " + error.what, error.remedy}});
}

std::unique_ptr<Voice> make_spoken_voice(const std::string& device) {
  return std::make_unique<SpokenVoice>([device](const Sound& sound, const std::atomic<bool>& stop) {
    return play(device, sound, stop);
  });
}

}  // namespace armsreach
