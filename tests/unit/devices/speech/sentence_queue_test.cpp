// What waits to be said: in order of urgency, up to date, and not for ever.
#include "devices/speech/sentence_queue.hpp"

#include <gtest/gtest.h>

namespace armsreach {
namespace {

constexpr Timestamp kSecond = 1'000'000'000;

std::string next(SentenceQueue& queue, Timestamp now) {
  const auto sentence = queue.take(now);
  return sentence ? sentence->text : "";
}

TEST(SentenceQueue, TheMostUrgentComesFirstAndOfEqualOnesTheOldest) {
  SentenceQueue queue;
  queue.push({"a", "first", Urgency::remark}, 1);
  queue.push({"b", "second", Urgency::remark}, 2);
  queue.push({"c", "urgent", Urgency::warning}, 3);
  EXPECT_EQ(next(queue, 4), "urgent");
  EXPECT_EQ(next(queue, 4), "first");
  EXPECT_EQ(next(queue, 4), "second");
  EXPECT_EQ(next(queue, 4), "");
  EXPECT_EQ(queue.dropped(), 0);
}

TEST(SentenceQueue, ANewerSentenceReplacesTheOneOfItsSubject) {
  SentenceQueue queue;
  queue.push({"tracking", "lost"}, 1);
  queue.push({"tracking", "found"}, 2);
  EXPECT_EQ(next(queue, 3), "found");
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.dropped(), 0) << "what is out of date is not missed";
}

TEST(SentenceQueue, WhatWaitedTooLongIsDroppedAndCounted) {
  SentenceQueue queue;
  queue.push({"a", "old"}, 0);
  queue.push({"b", "new"}, 2 * kSecond);
  EXPECT_EQ(next(queue, SentenceQueue::kPatience + 1), "new");
  EXPECT_EQ(queue.dropped(), 1);
}

TEST(SentenceQueue, IsBounded) {
  SentenceQueue queue;
  queue.push({"unimportant", "unimportant", Urgency::remark}, 0);
  for (std::size_t i = 0; i < SentenceQueue::kCapacity; ++i)
    queue.push({std::to_string(i), std::to_string(i), Urgency::notice}, 0);
  EXPECT_EQ(queue.dropped(), 1);
  for (std::size_t i = 0; i < SentenceQueue::kCapacity; ++i)
    EXPECT_EQ(next(queue, 1), std::to_string(i));
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace armsreach
