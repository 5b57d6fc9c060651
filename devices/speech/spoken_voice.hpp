// A voice that is heard, on a thread of its own.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "devices/speech/sentence_queue.hpp"
#include "devices/speech/voice.hpp"
#include "vision/core/sound.hpp"

namespace armsreach {

class SpokenVoice final : public Voice {
 public:
  // Plays a sound to its end, or until the flag is set.
  using Player = std::function<Status(const Sound&, const std::atomic<bool>& stop)>;

  explicit SpokenVoice(Player player);
  ~SpokenVoice() override;  // silent at once

  const std::string& name() const override { return name_; }
  void say(const Sentence& sentence) override;
  std::int64_t dropped() const override;
  Status rest() override;
  // A device that fails is told of once, until it plays again.
  Events take_events() override;

 private:
  void speak();
  void note(const Status& played, Timestamp time);

  const std::string name_ = "voice";
  Player player_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  SentenceQueue queue_;
  Events events_;
  bool failing_ = false;
  bool closing_ = false;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Through ALSA's `device`.
std::unique_ptr<Voice> make_spoken_voice(const std::string& device = "default");

}  // namespace armsreach
