// Films with sound: heard when it should be, silent elsewhere, the pictures untouched.
#include "render/film_sound.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <random>
#include <sys/resource.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "render/recorder.hpp"
#include "tests/support/film_reader.hpp"
#include "tests/support/program.hpp"

namespace armsreach::render {
namespace {

using test::film_sound;
using test::FilmSound;
using test::read_text;
using test::TemporaryFolder;

constexpr double kRate = 30;                  // Hz of the films here
constexpr double kLoud = 0.1;                 // rms of the noise below
constexpr double kAacFrame = 1024 / 16000.0;  // s that the encoder's quantisation noise may spread

// White noise resembles itself at one shift only.
std::shared_ptr<const Sound> noise(double seconds) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, kLoud * 32768);
  auto sound = std::make_shared<Sound>();
  sound->samples.resize(static_cast<std::size_t>(seconds * sound->rate));
  double smooth = 0;  // the encoder drops what lies above the voice
  for (auto& sample : sound->samples) {
    smooth = 0.5 * smooth + 0.5 * normal(random);
    sample = static_cast<std::int16_t>(std::clamp(smooth * std::sqrt(3.0), -32000.0, 32000.0));
  }
  return sound;
}

cv::Mat picture(int frame) {
  return cv::Mat(48, 64, CV_8UC3, cv::Scalar(frame % 200, 40 + frame % 100, 90));
}

// Frames at these source times, on a film of 30 Hz.
std::filesystem::path film(const TemporaryFolder& folder, const std::vector<double>& times,
                           const SoundTrack& sounds) {
  const std::filesystem::path file = folder / "film.mp4";
  auto recorder = Recorder::open({.file = file, .width = 64, .height = 48, .rate = kRate});
  EXPECT_TRUE(recorder.ok());
  int frame = 0;
  for (const double time : times)
    EXPECT_TRUE((*recorder)->write(picture(frame++), timestamp_from_seconds(time)).ok());
  const auto summary = (*recorder)->close(sounds);
  EXPECT_TRUE(summary.ok()) << summary.error().message();
  return file;
}

std::vector<double> regular_times(double start, int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(start + i / kRate);
  return times;
}

// Shift of `sound` within the film, in samples from where it should be, that fits best.
int best_shift(const FilmSound& film, const Sound& sound, double start) {
  const std::int64_t first = std::llround(start * film.rate);
  double best = -1;
  int shift = 0;
  for (int candidate = -1500; candidate <= 1500; ++candidate) {
    double sum = 0;
    for (std::size_t i = 0; i < sound.samples.size(); ++i) {
      const std::int64_t at = first + candidate + static_cast<std::int64_t>(i);
      if (at >= 0 && at < static_cast<std::int64_t>(film.samples.size()))
        sum += film.samples[static_cast<std::size_t>(at)] * sound.samples[i];
    }
    if (sum > best) {
      best = sum;
      shift = candidate;
    }
  }
  return shift;
}

TEST(FilmSound, IsHeardWithThePicturesOfItsTimeAndNowhereElse) {
  const TemporaryFolder folder;
  const auto sound = noise(0.4);
  const double start = 1000;  // source time of the first picture
  const FilmSound heard = film_sound(film(folder, regular_times(start, 90),
                                          {{timestamp_from_seconds(start + 0.5), sound},
                                           {timestamp_from_seconds(start + 1.8), sound}}));
  EXPECT_EQ(heard.streams, 1);
  EXPECT_EQ(heard.rate, 16000);
  // Lasts as long as the pictures, up to the encoder's last frame.
  EXPECT_NEAR(static_cast<double>(heard.samples.size()) / heard.rate, 3.0, 2 * kAacFrame);
  for (const double at : {0.5, 1.8}) {
    EXPECT_NEAR(best_shift(heard, *sound, at), 0, 1) << at;
    // The encoder keeps most of the noise's power, not all of it.
    EXPECT_NEAR(heard.rms(at + 0.02, at + 0.38), kLoud, 0.3 * kLoud) << at;
  }
  const double spread = 2 * kAacFrame;
  for (const auto& [from, to] :
       {std::pair(0.0, 0.5 - spread), std::pair(0.9 + spread, 1.8 - spread),
        std::pair(2.2 + spread, 3.0)}) {
    EXPECT_LT(heard.rms(from, to), 0.001 * kLoud) << from;
  }
}

// Live, pictures are lost and the film runs faster than the source: what is seen and heard stays
// together, and sounds that come closer follow one another.
TEST(FilmSound, FollowsThePicturesOfAFilmThatLostSome) {
  const TemporaryFolder folder;
  const auto sound = noise(0.4);
  std::vector<double> times;
  for (int i = 0; i < 60; ++i) times.push_back(0.2 * i);  // 6 times as fast
  const FilmSound heard = film_sound(film(
      folder, times, {{timestamp_from_seconds(3.0), sound}, {timestamp_from_seconds(3.6), sound}}));
  EXPECT_NEAR(best_shift(heard, *sound, 0.5), 0, 1);  // picture 15
  EXPECT_NEAR(best_shift(heard, *sound, 0.9), 0, 1);  // not 0.6, where the first is still heard
  EXPECT_LT(heard.rms(0, 0.5 - 2 * kAacFrame), 0.001 * kLoud);
}

TEST(FilmSound, ThePicturesAreUntouched) {
  const TemporaryFolder folder;
  const auto silent = film(folder, regular_times(0, 70), {});
  EXPECT_EQ(film_sound(silent).streams, 0);
  const auto before = test::video_packets(silent);
  ASSERT_TRUE(add_sound(silent, {{timestamp_from_seconds(1), noise(0.3)}}).ok());
  EXPECT_EQ(film_sound(silent).streams, 1);
  const auto after = test::video_packets(silent);
  ASSERT_EQ(after.size(), 70U);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(before[i].bytes, after[i].bytes) << i;
    EXPECT_DOUBLE_EQ(static_cast<double>(before[i].pts) * before[i].time_base,
                     static_cast<double>(after[i].pts) * after[i].time_base)
        << i;
  }
}

TEST(FilmSound, TheSameFilmIsTheSameFile) {
  const TemporaryFolder folder;
  const SoundTrack track = {{timestamp_from_seconds(0.2), noise(0.3)}};
  const std::string first = read_text(film(folder, regular_times(0, 30), track));
  EXPECT_EQ(first, read_text(film(folder, regular_times(0, 30), track)));
}

TEST(FilmSound, ASentenceAtTheEndIsHeardOut) {
  const TemporaryFolder folder;
  const FilmSound heard =
      film_sound(film(folder, regular_times(0, 30), {{timestamp_from_seconds(0.9), noise(0.5)}}));
  EXPECT_NEAR(heard.rms(1.0, 1.3), kLoud, 0.3 * kLoud);
}

// The limit on file sizes stands in for a full disk.
TEST(FilmSound, WithoutRoomTheSilentFilmIsKept) {
  const TemporaryFolder folder;
  const auto silent = film(folder, regular_times(0, 60), {});
  const std::string before = read_text(silent);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit small = limit;
  small.rlim_cur = 4000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const Status sounded = add_sound(silent, {{0, noise(2)}});
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(sounded.ok());
  EXPECT_NE(sounded.error().message().find("kept without sound"), std::string::npos);
  EXPECT_EQ(sounded.error().kind, Error::Kind::device);
  EXPECT_EQ(read_text(silent), before);
  const auto files = std::filesystem::directory_iterator(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "something is left over";
}

}  // namespace
}  // namespace armsreach::render
