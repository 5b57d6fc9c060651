// The voice that is heard: never blocks, falls silent at once, outlives its device.
#include "devices/speech/spoken_voice.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "devices/speech/sentence_queue.hpp"
#include "devices/speech/synthesis.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;

// A device that plays for ever, until it is stopped or let go.
class StuckDevice {
 public:
  Status play(const Sound& sound, const std::atomic<bool>& stop) {
    std::unique_lock lock(mutex_);
    played_.push_back(sound.samples);
    changed_.notify_all();
    while (!stop && !free_) changed_.wait_for(lock, 1ms);
    return ok();
  }
  // Waits, for ten seconds at most, until so many sounds have begun.
  bool wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, 10s, [&] { return played_.size() >= count; });
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    free_ = true;
  }
  std::vector<std::int16_t> played(std::size_t index) {
    const std::lock_guard lock(mutex_);
    return played_[index];
  }
  SpokenVoice::Player player() {
    return [this](const Sound& sound, const std::atomic<bool>& stop) { return play(sound, stop); };
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<std::int16_t>> played_;
  bool free_ = false;
};

// Each of these would never end if saying or ending waited for the device.
TEST(SpokenVoice, NeverWaitsForTheDeviceAndSaysTheNewestOfASubject) {
  StuckDevice device;
  SpokenVoice voice(device.player());
  voice.say({"a", "Tracking."});
  ASSERT_TRUE(device.wait_for(1));
  voice.say({"b", "Tracking lost."});
  voice.say({"b", "Place known."});
  device.let_go();
  ASSERT_TRUE(device.wait_for(2));
  EXPECT_EQ(device.played(1), synthesised("Place known.").samples);
}

TEST(SpokenVoice, RestIsSilenceAtOnceAndTheNextSentenceIsSaidAgain) {
  StuckDevice device;
  SpokenVoice voice(device.player());
  voice.say({"a", "Tracking."});
  ASSERT_TRUE(device.wait_for(1));
  voice.say({"b", "never said"});
  ASSERT_TRUE(voice.rest().ok());
  voice.say({"c", "Tracking lost."});
  ASSERT_TRUE(device.wait_for(2));
  EXPECT_EQ(device.played(1), synthesised("Tracking lost.").samples);
}

TEST(SpokenVoice, ADeviceThatHangsDoesNotHoldUpTheEnd) {
  auto hanging = std::make_shared<std::atomic<bool>>(true);
  auto begun = std::make_shared<std::atomic<bool>>(false);
  {
    SpokenVoice voice([hanging, begun](const Sound&, const std::atomic<bool>&) {
      *begun = true;
      while (*hanging) std::this_thread::sleep_for(1ms);
      return ok();
    });
    voice.say({"a", "Tracking."});
    while (!*begun) std::this_thread::sleep_for(1ms);
  }
  *hanging = false;
}

TEST(SpokenVoice, TooMuchIsDroppedAndCounted) {
  StuckDevice device;
  SpokenVoice voice(device.player());
  voice.say({"first", "first"});
  ASSERT_TRUE(device.wait_for(1));
  for (std::size_t i = 0; i < SentenceQueue::kCapacity + 3; ++i)
    voice.say({std::to_string(i), "text"});
  EXPECT_EQ(voice.dropped(), 3);
}

TEST(SpokenVoice, ADeviceThatVanishesIsToldOfOnceUntilItIsBack) {
  std::atomic<int> played = 0;
  std::atomic<bool> there = false;
  SpokenVoice voice([&](const Sound&, const std::atomic<bool>&) {
    const bool heard = there;
    ++played;
    return heard ? ok() : Status(Error{"gone", "here", "plug it in", Error::Kind::device});
  });
  auto say_and_wait = [&, said = 0]() mutable {
    voice.say({"a", "text"});
    ++said;
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (played < said && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(1ms);
    ASSERT_EQ(played, said);
  };
  for (const bool now : {false, false, true, false}) {
    there = now;
    say_and_wait();
  }
  say_and_wait();  // by now the one before has been noted
  const Events events = voice.take_events();
  ASSERT_EQ(events.size(), 2U);
  const auto* fault = std::get_if<FaultEvent>(&events[0].body);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->component, "voice");
  EXPECT_EQ(fault->remedy, "plug it in");
}

}  // namespace
}  // namespace armsreach
