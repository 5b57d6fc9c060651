// A voice that is heard, on a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "devices/speech/voice.hpp"
#include "vision/core/sound.hpp"

namespace armsreach {

class SpokenVoice final : public Voice {
 public:
  // Plays a sound to its end, or until the flag is set.
  using Player = std::function<Status(const Sound&, const std::atomic<bool>& stop)>;

  explicit SpokenVoice(Player player);
  // Silent at once. A device that does not come back, as a sound server that hangs, is left behind
  // with its thread after a second.
  ~SpokenVoice() override;

  const std::string& name() const override { return name_; }
  void say(const Sentence& sentence) override;
  std::int64_t dropped() const override;
  Status rest() override;
  // A device that fails is told of once, until it plays again.
  Events take_events() override;

 private:
  struct State;
  static void speak(const std::shared_ptr<State>& state);

  const std::string name_ = "voice";
  std::shared_ptr<State> state_;  // the thread's too: it may outlive the voice
  std::thread thread_;
};

// Through ALSA's `device`.
std::unique_ptr<Voice> make_spoken_voice(const std::string& device = "default");

}  // namespace armsreach
