#include "vision/relocalisation/codec.hpp"

#include <cstring>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/vision/relocalisation/painted_room.hpp"

namespace armsreach::relocalisation {
namespace {

KeyFrames two_key_frames() {
  const test::PaintedRoom room(1);
  RelocaliserOptions options;
  options.most_features = 30;
  Relocaliser relocaliser(options);
  for (int i = 0; i < 2; ++i) {
    relocaliser.consider(
        test::tracked(room.frame(test::unregistered_sensor(), test::at(0.3 * i, 0.1), 7 + i)));
  }
  return relocaliser.key_frames();
}

std::string text_of(const KeyFrames& key_frames) {
  std::ostringstream out;
  write_key_frames(out, key_frames);
  return out.str();
}

Result<KeyFrames> read(const std::string& text) {
  std::istringstream in(text);
  return read_key_frames(in, "map.keys");
}

TEST(KeyFrameCodec, WhatIsReadIsWhatWasWritten) {
  const KeyFrames written = two_key_frames();
  ASSERT_EQ(written.size(), 2U);
  const auto result = read(text_of(written));
  ASSERT_TRUE(result) << result.error().message();
  ASSERT_EQ(result->size(), 2U);
  EXPECT_EQ((*result)[1]->frame, 8);
  EXPECT_EQ((*result)[1]->view.features.codes, written[1]->view.features.codes);
  EXPECT_EQ(text_of(*result), text_of(written));
}

TEST(KeyFrameCodec, AMapIsEnteredAgain) {
  const test::PaintedRoom room(1);
  Relocaliser first{RelocaliserOptions()};
  first.consider(test::tracked(room.frame(test::registered_sensor(), test::at(0, 0))));
  const auto stored = read(text_of(first.key_frames()));
  ASSERT_TRUE(stored);
  Relocaliser second{RelocaliserOptions()};
  for (const auto& key_frame : *stored) second.put(key_frame);
  const FramePtr query = room.frame(test::registered_sensor(), test::at(0.05, 0.05));
  const auto before = first.relocalise(*query);
  const auto after = second.relocalise(*query);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->inliers, after->inliers);
  // Normalising a stored rotation may change its last bit.
  EXPECT_TRUE(before->world_from_camera.matrix().isApprox(after->world_from_camera.matrix(), 1e-9));
}

TEST(KeyFrameCodec, NoKeyFramesAreAFileToo) {
  const auto result = read(text_of({}));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->empty());
}

TEST(KeyFrameCodec, EveryTruncationIsAnError) {
  const std::string text = text_of(two_key_frames());
  for (std::size_t length = 0; length < text.size(); length += length < 400 ? 1 : 997) {
    const auto result = read(text.substr(0, length));
    ASSERT_FALSE(result) << length;
    EXPECT_EQ(result.error().where, "map.keys");
    EXPECT_FALSE(result.error().remedy.empty());
  }
}

// Offsets of the first key frame's entries, as the header lists them.
constexpr std::size_t kFirst = 8 + 4;
constexpr std::size_t kRotation = kFirst + 8;
constexpr std::size_t kTranslation = kRotation + 4 * 8;
constexpr std::size_t kPixelSize = kTranslation + 3 * 8;
constexpr std::size_t kWidth = kPixelSize + 8;
constexpr std::size_t kDistortion = kWidth + 2 * 4;
constexpr std::size_t kFocalLength = kDistortion + 4;
constexpr std::size_t kDepth = kFocalLength + (4 + 8) * 8;
constexpr std::size_t kFeatureCount = kDepth + 80 * 60 * 4;

template <class T>
void expect_refused(std::string text, std::size_t offset, T value) {
  std::memcpy(text.data() + offset, &value, sizeof value);
  const auto result = read(text);
  ASSERT_FALSE(result) << "at " << offset;
  EXPECT_THAT(result.error().what, testing::HasSubstr("key frame"));
}

TEST(KeyFrameCodec, ValuesThatCannotBeAreErrors) {
  const std::string text = text_of(two_key_frames());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(text, 0, 'X');
  expect_refused(text, 8, std::uint32_t{0xffffffff});
  expect_refused(text, kRotation, kNan);
  expect_refused(text, kRotation, 2.0);
  expect_refused(text, kTranslation, kNan);
  expect_refused(text, kPixelSize, 0.0);
  expect_refused(text, kWidth, std::int32_t{-1});
  expect_refused(text, kWidth, std::int32_t{1 << 30});
  expect_refused(text, kDistortion, std::int32_t{9});
  expect_refused(text, kFocalLength, -1.0);
  expect_refused(text, kDepth, -1.0F);
  expect_refused(text, kFeatureCount, std::uint32_t{0xffffffff});
  expect_refused(text, kFeatureCount + 4, std::numeric_limits<float>::infinity());
  expect_refused(text, kFeatureCount + 4 + 8, -1.0F);
}

}  // namespace
}  // namespace armsreach::relocalisation
