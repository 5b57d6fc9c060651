// Changes are said once, not too often, the most urgent first.
#include "app/interaction/announcer.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/interaction/remarks.hpp"

namespace armsreach::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Timestamp kFrame = 33'333'333;  // ns

std::vector<std::string> texts(const std::vector<Sentence>& sentences) {
  std::vector<std::string> out;
  for (const Sentence& sentence : sentences) out.push_back(sentence.text);
  return out;
}

TEST(Announcer, WhatHoldsOnIsSaidOnce) {
  Announcer announcer;
  int said = 0;
  for (int i = 0; i < 300; ++i) {
    announcer.note({"gesture", "Point.", Urgency::remark, i * kFrame});
    said += static_cast<int>(announcer.due(i * kFrame).size());
  }
  EXPECT_EQ(said, 1);
}

TEST(Announcer, AChangeIsSaidWhenTheSubjectHasBeenQuietForAWhile) {
  Announcer announcer;
  announcer.note({"tracking", "Tracking lost."});
  EXPECT_THAT(texts(announcer.due(0)), ElementsAre("Tracking lost."));
  announcer.note({"tracking", "Tracking."});
  EXPECT_THAT(announcer.due(Announcer::kPause - 1), IsEmpty());
  const auto sentences = announcer.due(Announcer::kPause);
  ASSERT_THAT(texts(sentences), ElementsAre("Tracking."));
  EXPECT_EQ(sentences[0].time, Announcer::kPause);
  EXPECT_THAT(announcer.due(10 * Announcer::kPause), IsEmpty());
}

TEST(Announcer, WhatChangedBackMeanwhileIsNotSaid) {
  Announcer announcer;
  announcer.note({"tracking", "Tracking lost."});
  EXPECT_EQ(announcer.due(0).size(), 1U);
  announcer.note({"tracking", "Tracking."});
  announcer.note({"tracking", "Tracking lost."});
  EXPECT_THAT(announcer.due(10 * Announcer::kPause), IsEmpty());
}

TEST(Announcer, WhatEndedAndBeganAgainIsSaidAgain) {
  Announcer announcer;
  announcer.note({"gesture", "Point."});
  EXPECT_EQ(announcer.due(0).size(), 1U);
  announcer.note({"gesture", ""});
  EXPECT_THAT(announcer.due(2 * Announcer::kPause), IsEmpty());
  announcer.note({"gesture", "Point."});
  EXPECT_EQ(announcer.due(3 * Announcer::kPause).size(), 1U);
}

TEST(Announcer, WhatMustLastIsNotSaidEarlierAndNotWhenItIsOver) {
  Announcer announcer;
  const auto note = [&](const std::string& text, Timestamp time) {
    announcer.note({"hand", text, Urgency::remark, time, 600});
  };
  note("point.", 1000);
  note("point.", 1400);  // still the same
  EXPECT_THAT(announcer.due(1599), IsEmpty());
  EXPECT_THAT(texts(announcer.due(1600)), ElementsAre("point."));
  // Passed on the way while the subject rests: only what is there when its turn comes.
  note("L.", 1700);
  note("open.", 1000 + Announcer::kPause);
  EXPECT_THAT(announcer.due(1599 + Announcer::kPause), IsEmpty());
  EXPECT_THAT(texts(announcer.due(1600 + Announcer::kPause)), ElementsAre("open."));
}

TEST(Announcer, RemarksThatComeAndGoAreMadeOnceInAWhileWarningsEachTime) {
  const auto said = [](Urgency urgency) {
    Announcer announcer;
    int count = 0;
    for (int i = 0; i < 100; ++i) {
      const Timestamp now = i * Announcer::kPause / 2;  // 1 s
      announcer.note({"hand", i % 2 ? "point." : "", urgency, now});
      count += static_cast<int>(announcer.due(now).size());
    }
    return count;
  };
  EXPECT_LE(said(Urgency::remark), 20);  // one in 5 s
  EXPECT_GE(said(Urgency::remark), 15);
  EXPECT_EQ(said(Urgency::warning), 50);
}

TEST(Announcer, TheMostUrgentIsFirstThenTheOldest) {
  Announcer announcer;
  announcer.note({"z", "remark", Urgency::remark, 1});
  announcer.note({"b", "later", Urgency::notice, 3});
  announcer.note({"c", "earlier", Urgency::notice, 2});
  announcer.note({"d", "warning", Urgency::warning, 4});
  EXPECT_THAT(texts(announcer.due(5)), ElementsAre("warning", "earlier", "later", "remark"));
}

TEST(Announcer, SubjectsDoNotHoldUpOneAnother) {
  Announcer announcer;
  announcer.note({"tracking", "Tracking."});
  EXPECT_EQ(announcer.due(0).size(), 1U);
  announcer.note({"gesture", "Fist."});
  EXPECT_THAT(texts(announcer.due(1)), ElementsAre("Fist."));
}

std::string remark(const decltype(Event::body)& body) {
  const auto sentence = remark_on({7, body});
  if (!sentence) return "";
  EXPECT_EQ(sentence->time, 7);
  return sentence->subject + "|" + sentence->text;
}

TEST(Remarks, EventsAndTheirSentences) {
  EXPECT_EQ(remark(TrackingEvent{TrackingState::lost, 0, 0}), "tracking|Tracking lost.");
  EXPECT_EQ(remark(TrackingEvent{TrackingState::relocalised, 0, 0}), "tracking|Place known.");
  EXPECT_EQ(remark(TrackingEvent{TrackingState::tracking, 0, 0}), "tracking|Tracking.");
  EXPECT_EQ(remark(TrackingEvent{TrackingState::initialising, 0, 0}), "");
  EXPECT_EQ(remark(InsertEvent{"teapot", 3, {}}), "object 3|teapot inserted.");
  EXPECT_EQ(remark(AcceptEvent{3, {0, 0, 1}}), "object 3|Accepted.");
  EXPECT_EQ(remark(RejectEvent{3, {0, 0, 1}}), "object 3|Rejected.");
  EXPECT_EQ(remark(DeleteEvent{"teapot", 3, {}}), "object 3|teapot deleted.");
  EXPECT_EQ(remark(MoveEvent{"teapot", 3, {}}), "");
  EXPECT_EQ(remark(FaultEvent{"camera", "it has gone", "plug it in"}),
            "fault of camera|camera: it has gone");
  // Paths are for the eye, and so is what was assumed before the first frame.
  EXPECT_EQ(remark(FaultEvent{"video:/a/b.mp4", "/a/b.mp4: cannot be read, it ends early", ""}),
            "fault of video:/a/b.mp4|cannot be read");
  EXPECT_FALSE(remark_on({0, FaultEvent{"video", "no calibration: assuming one", "give one"}}));
  const auto gesture = remark_on({7, GestureEvent{0, "point", 0.9, {0, 0}, 0}});
  ASSERT_TRUE(gesture);
  EXPECT_GT(gesture->lasting, 0);
  // These would never end.
  EXPECT_EQ(remark(FaultEvent{"voice", "no sound device", "connect one"}), "");
  EXPECT_EQ(remark(SpeechEvent{"Tracking."}), "");
}

}  // namespace
}  // namespace armsreach::app
