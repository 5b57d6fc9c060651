// The gaze closed through a serial line, in real time: the board at its other end turns a mount,
// the mount's camera sees a target where the mount has turned it to, and what is seen is commanded.
// The target moves by the pictures' number: on a busy machine it waits for them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "app/pipelines/gaze_stage.hpp"
#include "devices/firmata_gimbal.hpp"
#include "tests/support/firmata_peer.hpp"
#include "vision/core/gimbal_motion.hpp"

namespace armsreach::app {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using Clock = std::chrono::steady_clock;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kExposed = 0.02;  // s from a picture to its command
constexpr auto kPeriod = 33ms;     // from one picture to the next, at least

Timestamp time_now() { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }

class FirmataGaze : public testing::Test {
 protected:
  FirmataGaze() {
    folder_ = std::filesystem::temp_directory_path() / ("gaze-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
    model_.lower = {-1.4, -0.7, -0.6};
    model_.upper = {1.4, 0.7, 0.6};
    servos_.port = (folder_ / "board").string();
    board_ = std::make_unique<test::FirmataPeer>(servos_.port);
    auto gimbal = open_firmata_gimbal(servos_, "main", model_);
    EXPECT_TRUE(gimbal) << gimbal.error().message();
    if (gimbal) gimbal_ = *gimbal;
    mount_ = std::make_unique<GimbalMotion>(model_, GimbalState{.time = time_now()});
  }
  ~FirmataGaze() override {
    gimbal_.reset();
    std::filesystem::remove_all(folder_);
  }

  // Where the servos are by now, as the pulses on the line have told them.
  GimbalState turned(Timestamp now) {
    const auto seen = board_->seen();
    Vector3d angles = Vector3d::Zero();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const auto pulse = seen.pulses.find(servos_.pins[i]);
      if (pulse == seen.pulses.end()) continue;
      angles[axis] = (pulse->second - servos_.zero_us[i]) / servos_.us_per_degree[i] * kDegree;
    }
    if (angles != told_) {
      const auto received = seen.commands.back().time_since_epoch();
      mount_->command({std::chrono::nanoseconds(received).count(), told_ = angles});
    }
    return mount_->advance(now);
  }

  SeenFrame look(Timestamp now, const Pose& world_from_camera, const Vector3d& target) const {
    auto frame = std::make_shared<Frame>();
    frame->time = now;
    auto tracked = std::make_shared<TrackedFrame>();
    tracked->frame = frame;
    tracked->state = TrackingState::tracking;
    tracked->world_from_camera = world_from_camera;
    auto hands = std::make_shared<HandsState>();
    const auto pixel = project(camera_, world_from_camera.inverse() * target);
    if (pixel && camera_.contains(*pixel)) {
      hands->hands.resize(1);
      hands->hands[0].seen.center = *pixel;
    }
    return {tracked, hands};
  }

  // Off the target at the end, rad. The world is the mount's.
  double run(const GazeConfig& config, int pictures,
             const std::function<Vector3d(double)>& target) {
    GazeStage gaze(config, model_, camera_, {0, -1, 0}, kExposed);
    double off = 0;
    for (int picture = 0; picture < pictures; ++picture) {
      const Timestamp now = time_now();
      const Vector3d point = target(picture * std::chrono::duration<double>(kPeriod).count());
      const Pose world_from_camera = mount_from_camera(model_, turned(now).angles);
      const Vector3d in_camera = world_from_camera.inverse() * point;
      off = std::atan2(in_camera.head<2>().norm(), in_camera.z());
      farthest_ = std::max(farthest_, off);
      const GazeOutput out =
          gaze.process({look(now, world_from_camera, point), gimbal_->state_at(now)});
      for (const Event& event : out.events) events_.push_back(std::get<GazeEvent>(event.body));
      EXPECT_TRUE(gimbal_->command(*out.command));
      std::this_thread::sleep_for(kPeriod);
    }
    return off;
  }

  FirmataServos servos_;
  GimbalModel model_;
  Camera camera_ = pinhole(320, 240, 190, 190, 159.5, 119.5);
  std::filesystem::path folder_;
  std::unique_ptr<test::FirmataPeer> board_;
  std::shared_ptr<Gimbal> gimbal_;
  std::unique_ptr<GimbalMotion> mount_;  // the true one
  Vector3d told_{0, 0, 0};
  std::vector<GazeEvent> events_;
  double farthest_ = 0;
};

// A whole microsecond of a pulse is 0.1 degrees. The hand moves for 1.2 s and stands for one.
TEST_F(FirmataGaze, FollowsAHandAndStandsStillWhenItDoes) {
  const auto hand = [](double time) {
    const double angle = 0.5 * std::min(time, 1.2);  // rad: a quarter of a metre a second
    return Vector3d(0.5 * std::sin(angle), 0.08, 0.5 * std::cos(angle));
  };
  EXPECT_LT(run({"follow", "hand", {}}, 67, hand), 0.5 * kDegree);
  EXPECT_LT(farthest_, 20 * kDegree) << "it was never near the image's edge";
}

TEST_F(FirmataGaze, LeapsBeyondTheImageAndStaysThere) {
  const Vector3d point(std::sin(1.2), -0.1, std::cos(1.2));
  EXPECT_LT(run({"saccade", "hand", point}, 46, [&](double) { return point; }), 1 * kDegree);
  ASSERT_EQ(events_.size(), 2U);
  EXPECT_EQ(events_[0].mode, GazeMode::saccade);
  EXPECT_EQ(events_[1].mode, GazeMode::fixate);
}

}  // namespace
}  // namespace armsreach::app
