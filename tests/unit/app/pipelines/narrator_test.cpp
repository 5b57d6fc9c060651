// What happens is said, by whom, and what is written down of it.
#include "app/pipelines/narrator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"

namespace armsreach::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Timestamp kSecond = 1'000'000'000;

Event tracking(Timestamp time, TrackingState state) { return {time, TrackingEvent{state, 0, 0}}; }

std::vector<std::string> spoken(const EventLog& log) {
  std::vector<std::string> texts;
  for (const Event& event : log.recent()) {
    if (const auto* speech = std::get_if<SpeechEvent>(&event.body)) texts.push_back(speech->text);
  }
  return texts;
}

// Somebody is lost and finds the place again.
void happen(EventLog& log, Narrator& narrator) {
  for (Timestamp time = 0; time < 20 * kSecond; time += kSecond) {
    if (time == 2 * kSecond) log.write(tracking(time, TrackingState::tracking));
    if (time == 6 * kSecond) log.write(tracking(time, TrackingState::lost));
    if (time == 10 * kSecond) log.write(tracking(time, TrackingState::relocalised));
    narrator.turn(time);
  }
}

TEST(Narrator, SaysWhatHappensWhereAFilmKeepsIt) {
  EventLog log;
  const auto narrator = Narrator::make(log, {}, true);
  ASSERT_TRUE(narrator.ok());
  happen(log, **narrator);
  EXPECT_THAT(spoken(log), ElementsAre("Tracking.", "Tracking lost.", "Place known."));
  const SoundTrack track = (*narrator)->track();
  ASSERT_EQ(track.size(), 3U);
  EXPECT_EQ(track[0].start, 2 * kSecond);
  EXPECT_EQ(track[1].start, 6 * kSecond);
  EXPECT_EQ(track[2].start, 10 * kSecond);
  EXPECT_EQ((*narrator)->said(), 3);
  EXPECT_EQ((*narrator)->dropped(), 0);
}

TEST(Narrator, IsSilentWhereNobodyHears) {
  for (const bool film : {false, true}) {
    EventLog log;
    const auto narrator = Narrator::make(log, {film ? "off" : "auto"}, film);
    ASSERT_TRUE(narrator.ok());
    happen(log, **narrator);
    EXPECT_THAT(spoken(log), IsEmpty());
    EXPECT_THAT((*narrator)->track(), IsEmpty());
  }
}

TEST(Narrator, SpeaksIntoAWavFileFromTheFirstFrameOn) {
  const test::TemporaryFolder folder;
  const auto file = folder / "speech.wav";
  EventLog log;
  const auto narrator = Narrator::make(log, {file.string()}, false);
  ASSERT_TRUE(narrator.ok());
  happen(log, **narrator);
  ASSERT_TRUE((*narrator)->close().ok());
  // Ten seconds and a sentence of one or two, 32 kB a second.
  EXPECT_GT(std::filesystem::file_size(file), 10.5 * 32000);
  EXPECT_LT(std::filesystem::file_size(file), 12.5 * 32000);
}

TEST(Narrator, AWavFileThatCannotBeWrittenIsSaidAtOnce) {
  EventLog log;
  EXPECT_FALSE(Narrator::make(log, {"/no/such/folder/speech.wav"}, false).ok());
}

// Keeps what it is told and complains of its device.
class LoudVoice final : public Voice {
 public:
  explicit LoudVoice(std::vector<std::string>* heard) : heard_(heard) {}
  const std::string& name() const override { return name_; }
  void say(const Sentence& sentence) override { heard_->push_back(sentence.text); }
  std::int64_t dropped() const override { return 5; }
  Status rest() override { return ok(); }
  Events take_events() override { return {{9, FaultEvent{"voice", "gone", "plug it in"}}}; }

 private:
  const std::string name_ = "voice";
  std::vector<std::string>* heard_;
};

TEST(Narrator, SpeaksAloudAndTellsOfTheVoicesFaults) {
  EventLog log;
  const auto narrator = Narrator::make(log, {}, false);
  ASSERT_TRUE(narrator.ok());
  std::vector<std::string> heard;
  (*narrator)->speak_aloud(std::make_unique<LoudVoice>(&heard));
  log.write(tracking(1, TrackingState::tracking));
  (*narrator)->turn(1);
  EXPECT_THAT(heard, ElementsAre("Tracking."));
  EXPECT_EQ((*narrator)->dropped(), 5);
  const Event last = log.recent().back();
  ASSERT_TRUE(std::holds_alternative<FaultEvent>(last.body));
  EXPECT_EQ(std::get<FaultEvent>(last.body).message, "gone");
}

}  // namespace
}  // namespace armsreach::app
