// A voice that speaks along source time instead of aloud: the simulated twin, and the sound track
// of films and WAV files. Deterministic.
#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "devices/speech/sentence_queue.hpp"
#include "devices/speech/voice.hpp"
#include "vision/core/sound.hpp"

namespace armsreach {

class SimulatedVoice final : public Voice {
 public:
  struct Said {
    Timestamp start = 0;
    std::string text;
    std::shared_ptr<const Sound> sound;
  };

  const std::string& name() const override { return name_; }
  // A sentence starts at its time, or when the one before has ended. Times never fall.
  void say(const Sentence& sentence) override;
  std::int64_t dropped() const override;
  Status rest() override;  // forgets what waits, and cuts what is being said at the newest time

  // Lets what waits be said; everything since the start, in order.
  std::vector<Said> said();
  SoundTrack track();

 private:
  void speak_until(Timestamp time);

  const std::string name_ = "voice";
  mutable std::mutex mutex_;
  SentenceQueue queue_;
  std::vector<Said> said_;
  Timestamp free_ = 0;  // when the last sentence ends
  Timestamp now_ = 0;   // time of the newest sentence
};

}  // namespace armsreach
