#include <string>

#include <gtest/gtest.h>

#include "devices/recording.hpp"

namespace armsreach {
namespace {

// Frames at uneven times whose world pose tells which one it is; one of them may be broken.
class MadeUpRecording : public Recording {
 public:
  MadeUpRecording(std::vector<Timestamp> times, std::int64_t promised, std::int64_t broken = -1)
      : times_(std::move(times)), promised_(promised), broken_(broken) {}
  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  std::optional<std::int64_t> size() const override { return promised_; }
  Timestamp time(std::int64_t index) const override { return times_[index]; }
  Result<std::optional<Frame>> read(std::int64_t index) override {
    if (index >= std::ssize(times_)) return std::optional<Frame>();
    if (index == broken_) return Error{"broken", "frame", "mend it"};
    Frame frame;
    frame.index = index;
    frame.time = times_[index];
    frame.sensor = sensor_;
    frame.world_from_camera = Pose(Eigen::Quaterniond::Identity(), {double(index), 0, 0});
    return std::optional<Frame>(std::move(frame));
  }

 private:
  std::vector<Timestamp> times_;
  std::int64_t promised_;
  std::int64_t broken_;
  std::shared_ptr<const SensorInfo> sensor_ = std::make_shared<SensorInfo>();
};

// "index@time=recorded index" of up to `count` frames.
std::string played(Source& source, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    const auto frame = source.next();
    if (!frame) {
      text += "broken ";
      continue;
    }
    if (!*frame) return text + "end";
    const Frame& f = **frame;
    const int recorded = static_cast<int>(f.world_from_camera->translation().x());
    text += std::to_string(f.index) + "@" + std::to_string(f.time) + "=" +
            std::to_string(recorded) + " ";
  }
  return text;
}

TEST(Playback, OnceEnds) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{5, 7, 10}, 3), Loop::once);
  EXPECT_EQ(source->frame_count(), 3);
  EXPECT_FALSE(source->live());
  EXPECT_EQ(played(*source, 9), "0@5=0 1@7=1 2@10=2 end");
}

TEST(Playback, PingpongMirrorsTimeAtBothEnds) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{5, 7, 10}, 3), Loop::pingpong);
  EXPECT_EQ(source->frame_count(), std::nullopt);
  EXPECT_EQ(played(*source, 8), "0@5=0 1@7=1 2@10=2 3@13=1 4@15=0 5@17=1 6@20=2 7@23=1 ");
}

TEST(Playback, PingpongTurnsWhereARecordingEndsBeforeItsPromise) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{0, 2}, 50), Loop::pingpong);
  EXPECT_EQ(played(*source, 4), "0@0=0 1@2=1 2@4=0 3@6=1 ");
}

TEST(Playback, PingpongRepeatsASingleFrameAtItsRate) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{7}, 1), Loop::pingpong);
  EXPECT_EQ(played(*source, 3), "0@7=0 1@33333340=0 2@66666674=0 ");
}

TEST(Playback, PassesOverABrokenFrame) {
  const auto source = play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{0, 1, 2}, 3, 1),
                           Loop::pingpong);
  EXPECT_EQ(played(*source, 5), "0@0=0 broken 2@2=2 broken 4@4=0 ");
}

TEST(Playback, EmptyEndsAtOnce) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{}, 0), Loop::pingpong);
  EXPECT_EQ(played(*source, 3), "end");
}

TEST(Playback, StopEndsAnEndlessOne) {
  const auto source =
      play(std::make_unique<MadeUpRecording>(std::vector<Timestamp>{0, 2}, 2), Loop::pingpong);
  EXPECT_EQ(played(*source, 1), "0@0=0 ");
  source->stop();
  EXPECT_EQ(played(*source, 3), "end");
}

TEST(Playback, LoopIsReadFromTheSpecification) {
  EXPECT_EQ(*loop_option(*parse_source_spec("tum:dir")), Loop::once);
  EXPECT_EQ(*loop_option(*parse_source_spec("tum:dir,loop=once")), Loop::once);
  EXPECT_EQ(*loop_option(*parse_source_spec("tum:dir,loop=pingpong")), Loop::pingpong);
  EXPECT_NE(loop_option(*parse_source_spec("tum:dir,loop=twice")).error().message().find("'twice'"),
            std::string::npos);
}

}  // namespace
}  // namespace armsreach
