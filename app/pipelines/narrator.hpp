// Says what happens: hears every event, lets the announcer decide what is worth a sentence, and
// hands it to the voices: the one that is heard, and the one that films and WAV files keep.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "app/interaction/announcer.hpp"
#include "app/runtime/event_log.hpp"
#include "app/runtime/output_file.hpp"
#include "app/session/config.hpp"
#include "devices/speech/simulated_voice.hpp"
#include "devices/speech/voice.hpp"

namespace armsreach::app {

class Narrator {
 public:
  // Listens to `log` as long as it lives. With a film or a WAV file what is said is kept; without
  // either, and until speak_aloud(), nothing is said.
  static Result<std::unique_ptr<Narrator>> make(EventLog& log, const SpeechConfig& config,
                                                bool film);
  ~Narrator();

  void speak_aloud(std::unique_ptr<Voice> voice) { heard_ = std::move(voice); }  // before the run

  // Says what is due at this frame's time. Frame by frame in order, so that what is said does not
  // depend on which thread was faster.
  void turn(Timestamp time);

  // What was said so far; what is waiting to be said is added to the end.
  SoundTrack track() { return kept_ ? kept_->track() : SoundTrack{}; }
  Status close();  // writes the WAV file, silences the voice

  std::int64_t said() const { return said_; }  // sentences handed to the voices
  std::int64_t dropped() const;                // of these, not said in time by one of them

 private:
  explicit Narrator(EventLog& log) : log_(log) {}
  void hear(const Event& event);
  void say(const Sentence& sentence);
  void tell_of_the_voices_faults();

  EventLog& log_;
  std::unique_ptr<Voice> heard_;          // null: silence
  std::unique_ptr<SimulatedVoice> kept_;  // null: nothing keeps what is said
  OutputFile wav_;
  std::mutex mutex_;
  Announcer announcer_;
  std::optional<Timestamp> start_;  // first frame's time
  std::int64_t said_ = 0;
};

}  // namespace armsreach::app
