// ALSA itself, with its devices that need no hardware.
#include "devices/speech/loudspeaker.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "devices/speech/synthesis.hpp"
#include "tests/support/program.hpp"

namespace armsreach {
namespace {

TEST(Loudspeaker, GivesTheDeviceEverySample) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "played.raw";
  const Sound sound = synthesised("Tracking.");
  const std::atomic<bool> stop = false;
  const Status played = play("file:FILE='" + file.string() + "',FORMAT=raw", sound, stop);
  ASSERT_TRUE(played.ok()) << played.error().message();
  const std::string bytes = test::read_text(file);
  ASSERT_EQ(bytes.size(), 2 * sound.samples.size());
  EXPECT_EQ(std::memcmp(bytes.data(), sound.samples.data(), bytes.size()), 0);
}

TEST(Loudspeaker, StopsWhenTold) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "played.raw";
  const std::atomic<bool> stop = true;
  const Sound sound = synthesised("Tracking.");
  ASSERT_TRUE(play("file:FILE='" + file.string() + "',FORMAT=raw", sound, stop).ok());
  EXPECT_TRUE(test::read_text(file).empty());
}

TEST(Loudspeaker, ADeviceThatIsNotThereIsSaidWithARemedy) {
  const std::atomic<bool> stop = false;
  const Status played = play("no_such_device", synthesised("Tracking."), stop);
  ASSERT_FALSE(played.ok());
  EXPECT_EQ(played.error().kind, Error::Kind::device);
  EXPECT_NE(played.error().message().find("no_such_device"), std::string::npos);
  EXPECT_NE(played.error().remedy.find("voice: off"), std::string::npos);
}

}  // namespace
}  // namespace armsreach
