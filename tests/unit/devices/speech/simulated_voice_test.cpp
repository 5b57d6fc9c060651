// Speech along source time, and as a WAV file.
#include "devices/speech/simulated_voice.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include <gtest/gtest.h>

#include "devices/speech/synthesis.hpp"
#include "devices/speech/wav.hpp"

namespace armsreach {
namespace {

double rms(const std::int16_t* first, const std::int16_t* last) {
  double sum = 0;
  for (const auto* s = first; s != last; ++s) sum += static_cast<double>(*s) * *s;
  return std::sqrt(sum / static_cast<double>(last - first));
}
double rms(const std::vector<std::int16_t>& s) { return rms(s.data(), s.data() + s.size()); }

Timestamp at(double seconds) { return timestamp_from_seconds(seconds); }

TEST(Synthesis, SpeaksAudiblyWithoutClipping) {
  for (const char* text : {"Tracking lost.", "Place known.", "teapot inserted."}) {
    const Sound sound = synthesised(text);
    EXPECT_EQ(sound.rate, 16000);
    // Two to five syllables a second.
    EXPECT_GT(sound.seconds(), 0.6) << text;
    EXPECT_LT(sound.seconds(), 2.5) << text;
    // A voice lies some 20 to 30 dB below full scale on average.
    EXPECT_GT(rms(sound.samples), 600) << text;
    const auto [low, high] = std::minmax_element(sound.samples.begin(), sound.samples.end());
    EXPECT_LT(*high, 32000) << text;
    EXPECT_GT(*low, -32000) << text;
  }
}

TEST(Synthesis, TheSameTextIsTheSameSound) {
  EXPECT_EQ(synthesised("Tracking.").samples, synthesised("Tracking.").samples);
  EXPECT_NE(synthesised("Tracking.").samples, synthesised("Tracking lost.").samples);
}

TEST(Synthesis, SurvivesAnyText) {
  EXPECT_TRUE(synthesised("").samples.empty());
  EXPECT_TRUE(synthesised(" \n\t ").samples.empty());
  synthesised("\xff\xfe\x01 %s %n <speak> ((( ' \" \\ \xe2\x98\x83");
  EXPECT_LT(synthesised(std::string(100000, 'a')).seconds(), 30);
}

TEST(SimulatedVoice, SpeaksAtTheSentencesTimesOneAfterTheOther) {
  SimulatedVoice voice;
  voice.say({"a", "Tracking.", Urgency::notice, at(10)});
  voice.say({"b", "teapot inserted.", Urgency::remark, at(10.2)});
  voice.say({"c", "Tracking lost.", Urgency::warning, at(20)});
  const auto said = voice.said();
  ASSERT_EQ(said.size(), 3U);
  EXPECT_EQ(said[0].text, "Tracking.");
  EXPECT_EQ(said[0].start, at(10));
  EXPECT_EQ(said[1].start, said[0].start + at(said[0].sound->seconds()));
  EXPECT_EQ(said[2].text, "Tracking lost.");
  EXPECT_EQ(said[2].start, at(20));
  EXPECT_EQ(voice.dropped(), 0);
}

TEST(SimulatedVoice, OfOneInstantTheMostUrgentIsFirst) {
  SimulatedVoice voice;
  voice.say({"a", "teapot inserted.", Urgency::remark, at(1)});
  voice.say({"b", "Tracking lost.", Urgency::warning, at(1)});
  EXPECT_EQ(voice.said()[0].text, "Tracking lost.");
}

TEST(SimulatedVoice, WhatCannotBeSaidInTimeIsDroppedAndCounted) {
  SimulatedVoice voice;
  const std::string text = "This is quite a long sentence that takes several seconds to say.";
  for (int i = 0; i < 6; ++i) voice.say({std::to_string(i), text, Urgency::remark, at(0)});
  const auto said = voice.said();
  EXPECT_LT(said.size(), 4U);
  EXPECT_EQ(voice.dropped(), 6 - static_cast<std::int64_t>(said.size()));
  for (const auto& s : said) EXPECT_LE(s.start, SentenceQueue::kPatience);
}

TEST(SimulatedVoice, RestIsSilenceAtOnce) {
  SimulatedVoice voice;
  voice.say({"a", "This is quite a long sentence that takes several seconds to say."});
  voice.say({"b", "Tracking.", Urgency::remark, at(0.5)});
  ASSERT_TRUE(voice.rest().ok());
  voice.say({"c", "Tracking lost.", Urgency::remark, at(0.6)});
  const auto said = voice.said();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NEAR(said[0].sound->seconds(), 0.5, 0.001);
  EXPECT_EQ(said[1].text, "Tracking lost.");
  EXPECT_EQ(said[1].start, at(0.6));
}

TEST(Wav, IsPlainPcmWithSpeechInItsPlace) {
  SimulatedVoice voice;
  voice.say({"a", "Tracking.", Urgency::notice, at(101)});
  voice.say({"b", "Tracking lost.", Urgency::warning, at(105)});
  std::ostringstream out;
  write_wav(out, voice.track(), at(100));
  const std::string bytes = out.str();
  ASSERT_GT(bytes.size(), 44U);
  EXPECT_EQ(bytes.substr(0, 4) + bytes.substr(8, 8) + bytes.substr(36, 4), "RIFFWAVEfmt data");
  const auto number = [&](std::size_t where) {
    std::uint32_t value = 0;  // little-endian, as this machine
    std::memcpy(&value, bytes.data() + where, sizeof value);
    return value;
  };
  EXPECT_EQ(number(4), bytes.size() - 8);
  EXPECT_EQ(number(24), 16000U);
  EXPECT_EQ(number(40), bytes.size() - 44);
  std::vector<std::int16_t> samples((bytes.size() - 44) / 2);
  std::memcpy(samples.data(), bytes.data() + 44, samples.size() * 2);
  const auto level = [&](double from, double to) {
    return rms(samples.data() + std::llround(from * 16000),
               samples.data() + std::llround(to * 16000));
  };
  EXPECT_EQ(level(0, 1), 0);
  EXPECT_GT(level(1.1, 1.5), 600);
  EXPECT_EQ(level(2.5, 5), 0);
  EXPECT_GT(level(5.1, 5.9), 600);
}

TEST(Wav, OfNothingSaidIsAnEmptyFileThatPlays) {
  std::ostringstream out;
  write_wav(out, {}, 0);
  EXPECT_EQ(out.str().size(), 44U);
}

}  // namespace
}  // namespace armsreach
