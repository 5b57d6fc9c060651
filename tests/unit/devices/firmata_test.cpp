#include "devices/firmata.hpp"

#include <gtest/gtest.h>

namespace armsreach::firmata {
namespace {

// The bytes of the specification's examples.
TEST(Firmata, WritesTheSpecifiedBytes) {
  EXPECT_EQ(version_query(), Bytes({0xF9}));
  EXPECT_EQ(firmware_query(), Bytes({0xF0, 0x79, 0xF7}));
  EXPECT_EQ(servo_mode(9), Bytes({0xF4, 9, 4}));
  // 544 = 4 * 128 + 32, 2400 = 18 * 128 + 96, 1500 = 11 * 128 + 92.
  EXPECT_EQ(servo_config(9, 544, 2400), Bytes({0xF0, 0x70, 9, 32, 4, 96, 18, 0xF7}));
  EXPECT_EQ(servo_pulse(10, 1500), Bytes({0xF0, 0x6F, 10, 92, 11, 0xF7}));
}

TEST(Firmata, ReadsVersionFirmwareAndTextInAnyPieces) {
  const Bytes all{0xF9, 2,    6,                                      //
                  0xF0, 0x79, 2,   5, 'S', 0, 't', 0, 0x69, 1, 0xF7,  // the last is 0xE9
                  0xF0, 0x71, 'h', 0, 'i', 0, 0xF7};
  for (std::size_t piece = 1; piece <= all.size(); ++piece) {
    Reader reader;
    std::vector<Message> messages;
    for (std::size_t at = 0; at < all.size(); at += piece) {
      const auto end = std::min(at + piece, all.size());
      for (const Message& one : reader.take(std::span(all).subspan(at, end - at)))
        messages.push_back(one);
    }
    ASSERT_EQ(messages.size(), 3U) << piece;
    EXPECT_EQ(std::get<Version>(messages[0]).minor, 6);
    EXPECT_EQ(std::get<Firmware>(messages[1]).minor, 5);
    EXPECT_EQ(std::get<Firmware>(messages[1]).name, "St\xE9");
    EXPECT_EQ(std::get<Text>(messages[2]).text, "hi");
  }
}

TEST(Firmata, FindsTheNextMessageAfterMalformedOnes) {
  const std::vector<Bytes> broken = {
      {1, 2, 3},                        // no command
      {0xF0, 0x79, 2},                  // a message that breaks off
      {0xF9, 2},                        // the same
      {0xF0, 0xF7},                     // nothing in it
      {0xF0, 0x79, 0xF7},               // a query is no answer
      {0xF0, 0x79, 2, 0xF7},            // half a version
      {0xF0, 0x71, 'h', 0, 'i', 0xF7},  // half a character
      {0xF7, 0xF7},                     // an end without a beginning
      {0xE3, 5, 6, 0x91, 1, 0},         // readings of pins
      {0xFF, 0xC0, 1, 0xF4, 9, 4},      // a reset and commands
      Bytes(5000, 0x11),
  };
  for (const Bytes& bytes : broken) {
    Reader reader;
    static_cast<void>(reader.take(bytes));
    const auto messages = reader.take(Bytes{0xF9, 2, 3});
    ASSERT_EQ(messages.size(), 1U) << int(bytes[0]) << " " << bytes.size();
    EXPECT_EQ(std::get<Version>(messages[0]).minor, 3);
  }
}

TEST(Firmata, AMessageWithoutEndTakesNoMemory) {
  Reader reader;
  static_cast<void>(reader.take(Bytes{0xF0, 0x71}));
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(reader.take(Bytes(1000, 'x')).empty());
  EXPECT_TRUE(reader.take(Bytes{0xF7}).empty()) << "it was given up long ago";
}

}  // namespace
}  // namespace armsreach::firmata
