// The voice through the command line: on films, in WAV files, aloud without a sound device.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/edited_recording.hpp"
#include "tests/support/film_reader.hpp"
#include "tests/support/program.hpp"
#include "tests/support/recordings.hpp"

namespace armsreach::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::vector<json> events_of(const TemporaryFolder& folder, const std::string& type) {
  std::vector<json> events;
  std::istringstream lines(read_text(folder / "e.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    if (json event = json::parse(line); event["type"] == type) events.push_back(std::move(event));
  }
  return events;
}

// Sixty frames, a teapot set down in frame 45.
ProgramResult run(const TemporaryFolder& folder, const std::string& configuration,
                  const std::vector<std::string>& more) {
  write_text(folder / "c.yaml",
             "actions: [{frame: 45, click: [450, 290], insert: teapot}]\n" + configuration);
  std::vector<std::string> arguments = {"run",
                                        "--source",
                                        "sim:bench,frames=60",
                                        "--pace",
                                        "every-frame",
                                        "--config",
                                        folder / "c.yaml",
                                        "--events",
                                        folder / "e.jsonl"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_armsreach(arguments);
}

// As loud as Flite speaks, rms of full scale; an encoded silence is a hundred times quieter.
constexpr double kSpeech = 0.02;
constexpr double kSilence = 0.0002;

TEST(EndToEndSpeech, AFilmSaysWhatHappensWhenItHappensTheSameEveryTime) {
  std::vector<std::vector<double>> sounds;
  for (const char* threads : {"true", "false"}) {
    const TemporaryFolder folder;
    const ProgramResult filmed =
        run(folder, std::string("threads: ") + threads + "\nsize: [160, 120]\n",
            {"--display", "egl", "--record", folder / "film.mp4"});
    ASSERT_EQ(filmed.exit_code, 0) << filmed.output;
    const std::vector<json> said = events_of(folder, "speech");
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said[0]["text"], "Tracking.");
    EXPECT_EQ(said[1]["text"], "teapot inserted.");
    const double inserted = said[1]["t"];
    EXPECT_NEAR(inserted, 1.5, 0.1);

    const FilmSound heard = film_sound(folder / "film.mp4");
    EXPECT_EQ(heard.rate, 16000);
    EXPECT_GT(heard.rms(0.1, 0.5), kSpeech);
    EXPECT_LT(heard.rms(1.2, inserted - 0.13), kSilence);
    EXPECT_GT(heard.rms(inserted + 0.1, inserted + 0.7), kSpeech);
    EXPECT_EQ(video_packets(folder / "film.mp4").size(), 60U);
    sounds.push_back(heard.samples);
  }
  EXPECT_EQ(sounds[0], sounds[1]);
}

TEST(EndToEndSpeech, OffMeansAFilmWithoutASoundTrack) {
  const TemporaryFolder folder;
  const ProgramResult filmed =
      run(folder, "speech: {voice: off}\nsize: [160, 120]\n",
          {"--display", "egl", "--record", folder / "film.mp4", "--frames", "10"});
  ASSERT_EQ(filmed.exit_code, 0) << filmed.output;
  EXPECT_EQ(film_sound(folder / "film.mp4").streams, 0);
  EXPECT_TRUE(events_of(folder, "speech").empty());
}

TEST(EndToEndSpeech, SpeaksIntoAWavFile) {
  const TemporaryFolder folder;
  const std::string wav = folder / "speech.wav";
  const ProgramResult spoken =
      run(folder, "speech: {voice: '" + wav + "'}\n", {"--display", "none"});
  ASSERT_EQ(spoken.exit_code, 0) << spoken.output;
  const double inserted = events_of(folder, "speech").at(1)["t"];
  const std::string bytes = read_text(wav);
  std::vector<std::int16_t> samples((bytes.size() - 44) / 2);
  std::memcpy(samples.data(), bytes.data() + 44, 2 * samples.size());
  const auto first = static_cast<std::size_t>(std::ceil(inserted * 16000));
  ASSERT_GT(samples.size(), first + 8000);
  std::size_t loud = 0;
  for (std::size_t i = first - 8000; i < first - 1; ++i) loud += samples[i] != 0;
  EXPECT_EQ(loud, 0U) << "silence before the sentence";
  for (std::size_t i = first; i < first + 8000; ++i) loud += std::abs(samples[i]) > 650;
  EXPECT_GT(loud, 1000U);
}

TEST(EndToEndSpeech, AWrongVoiceIsRefused) {
  const TemporaryFolder folder;
  for (const auto& [configuration, complaint] :
       {std::pair("speech: {voice: loud}\n", "speech.voice"),
        std::pair("speech: {volume: 3}\n", "speech.volume"),
        std::pair("speech: {voice: /no/such/folder/a.wav}\n", "/no/such/folder/a.wav")}) {
    const ProgramResult refused = run(folder, configuration, {"--display", "none"});
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr(complaint));
  }
}

// A camera that is covered, carried half a metre on and uncovered.
TEST(EndToEndSpeech, SaysThatTheWayIsLostAndThePlaceKnown) {
  ARMSREACH_RECORDING_OR_SKIP(path, "rgbd/redkitchen");
  const TemporaryFolder folder;
  edit_recording(path, folder / "covered", [](int frame) {
    if (frame >= 100 && frame < 130) return FrameEdit::cover;
    return frame >= 130 && frame < 160 ? FrameEdit::leave_out : FrameEdit::keep;
  });
  write_text(folder / "c.yaml", "speech: {voice: '" + (folder / "speech.wav").string() + "'}\n");
  const ProgramResult run =
      run_armsreach({"run", "--source", "tum:" + (folder / "covered").string(), "--pace",
                     "every-frame", "--display", "none", "--frames", "150", "--config",
                     folder / "c.yaml", "--events", folder / "e.jsonl"});
  ASSERT_EQ(run.exit_code, 0) << run.output;
  std::vector<std::string> said;
  for (const json& speech : events_of(folder, "speech")) said.push_back(speech["text"]);
  EXPECT_THAT(said, ::testing::ElementsAre("Tracking.", "Tracking lost.", "Place known."));
}

// Without ALSA's configuration there is no sound device, whatever this machine has.
TEST(EndToEndSpeech, LiveWithoutASoundDeviceIsAFaultAndTheRunGoesOn) {
  if (std::system("command -v xvfb-run >/dev/null") != 0)
    GTEST_SKIP() << "xvfb-run is not installed";
  const TemporaryFolder folder;
  const std::string command =
      "ALSA_CONFIG_PATH=/dev/null timeout 300 xvfb-run -a " ARMSREACH_BINARY_DIR
      "/armsreach run --source sim:bench --display window --frames 60 --events " +
      (folder / "e.jsonl").string() + " >/dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_FALSE(events_of(folder, "speech").empty());
  const std::vector<json> faults = events_of(folder, "fault");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0]["component"], "voice");
  EXPECT_THAT(faults[0]["remedy"].get<std::string>(), HasSubstr("voice: off"));
}

TEST(EndToEndSpeech, AnInterruptedFilmHasItsSound) {
  const TemporaryFolder folder;
  const std::string events = folder / "e.jsonl";
  const std::string film = folder / "film.mp4";
  const std::string command =
      ARMSREACH_BINARY_DIR "/armsreach run --source sim:bench --display egl --record " + film +
      " --events " + events + " >/dev/null 2>&1 & " + "for i in $(seq 600); do grep -qs speech " +
      events + " && break; sleep 0.1; done; " + "kill -TERM $!; wait $!";
  EXPECT_EQ(std::system(command.c_str()), 0);
  ASSERT_FALSE(events_of(folder, "speech").empty());
  EXPECT_FALSE(video_packets(film).empty());
  // The first sentence, said in one of the first frames.
  EXPECT_GT(film_sound(film).rms(0, 1), kSpeech / 2);
}

}  // namespace
}  // namespace armsreach::test
