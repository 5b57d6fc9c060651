#include "app/pipelines/narrator.hpp"

#include <vector>

#include "app/interaction/remarks.hpp"
#include "devices/speech/wav.hpp"

namespace armsreach::app {

Result<std::unique_ptr<Narrator>> Narrator::make(EventLog& log, const SpeechConfig& config,
                                                 bool film) {
  std::unique_ptr<Narrator> narrator(new Narrator(log));
  const bool wav = config.voice != "auto" && config.voice != "off";
  if (config.voice != "off" && (film || wav)) narrator->kept_ = std::make_unique<SimulatedVoice>();
  if (wav) {
    if (auto status = narrator->wav_.open(config.voice); !status) return status.error();
  }
  log.set_listener([narrator = narrator.get()](const Event& event) { narrator->hear(event); });
  return narrator;
}

Narrator::~Narrator() { log_.set_listener(nullptr); }

void Narrator::hear(const Event& event) {
  const std::optional<Sentence> sentence = remark_on(event);
  if (!sentence) return;
  const std::lock_guard lock(mutex_);
  announcer_.note(*sentence);
}

void Narrator::turn(Timestamp time) {
  if (!start_) start_ = time;
  if (!heard_ && !kept_) return;
  std::vector<Sentence> due;
  {
    const std::lock_guard lock(mutex_);
    due = announcer_.due(time);
  }
  for (const Sentence& sentence : due) say(sentence);
  tell_of_the_voices_faults();
}

void Narrator::tell_of_the_voices_faults() {
  if (!heard_) return;
  for (const Event& event : heard_->take_events()) log_.write(event);
}

void Narrator::say(const Sentence& sentence) {
  ++said_;
  if (heard_) heard_->say(sentence);
  if (kept_) kept_->say(sentence);
  log_.write({sentence.time, SpeechEvent{sentence.text}});
}

Status Narrator::close() {
  tell_of_the_voices_faults();
  const Status silent = heard_ ? heard_->rest() : ok();
  if (wav_.is_open()) write_wav(wav_.stream(), track(), start_.value_or(0));
  const Status written = wav_.close();
  return written ? silent : written;
}

std::int64_t Narrator::dropped() const {
  return heard_ ? heard_->dropped() : kept_ ? kept_->dropped() : 0;
}

}  // namespace armsreach::app
