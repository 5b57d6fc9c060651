#include "devices/live_gimbal.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "devices/command_log.hpp"
#include "vision/core/gimbal_motion.hpp"

namespace armsreach {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kBetweenCommands = 20ms;  // a servo's own period
constexpr auto kBetweenChecks = 1s;
constexpr auto kBetweenTries = 500ms;      // to find a device that has gone
constexpr Timestamp kSampled = 2'000'000;  // ns: a frame just taken is covered
constexpr Timestamp kRemembered = 3'000'000'000;

Timestamp time_now() { return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count(); }

class LiveGimbal final : public Gimbal {
 public:
  LiveGimbal(std::unique_ptr<GimbalDriver> driver, std::string name, const GimbalModel& model)
      : driver_(std::move(driver)),
        name_(std::move(name)),
        motion_(model, GimbalState{.time = time_now()}),
        thread_([this](const std::stop_token& stop) { drive(stop); }) {}

  const std::string& name() const override { return name_; }
  const GimbalModel& model() const override { return motion_.model(); }

  Status rest() override { return command({time_now(), Eigen::Vector3d::Zero()}); }

  Status command(const GimbalCommand& command) override {
    if (!command.angles.allFinite()) {
      return Error{"the gimbal's angles are not finite", name_, "command finite angles"};
    }
    const std::lock_guard lock(mutex_);
    wanted_ = GimbalCommand{command.time, clamped(model(), command.angles)};
    log_.add(*wanted_);
    ++commands_;
    commanded_.notify_all();
    return ok();
  }

  std::optional<GimbalState> state_at(Timestamp time) const override {
    const std::lock_guard lock(mutex_);
    catch_up(time_now());
    return interpolated_state(states_, time);
  }

  std::vector<GimbalCommand> take_commands() override {
    const std::lock_guard lock(mutex_);
    return log_.take();
  }
  Events take_events() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
  }

 private:
  void drive(const std::stop_token& stop) {
    Status status = send(Eigen::Vector3d::Zero());  // wherever it was left
    while (!stop.stop_requested()) {
      if (!status) {
        if (!find_again(status.error(), stop)) return;
        status = send(last_sent_);
        continue;
      }
      const auto next = next_command(stop);
      if (stop.stop_requested()) break;
      status = next ? send(next->angles) : driver_->check();
    }
    // Nobody is left to be told whether it worked.
    static_cast<void>(driver_->move(Eigen::Vector3d::Zero()));
  }

  // The newest command once it is due; nothing when it is time for a check.
  std::optional<GimbalCommand> next_command(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested() && Clock::now() < next_check_) {
      if (wanted_ && due() <= Clock::now()) return std::exchange(wanted_, std::nullopt);
      const auto until = wanted_ ? std::min(next_check_, due()) : next_check_;
      commanded_.wait_until(lock, stop, until,
                            [this, seen = commands_] { return commands_ != seen; });
    }
    next_check_ = Clock::now() + kBetweenChecks;
    return std::nullopt;
  }

  Clock::time_point due() const {
    const Clock::time_point asked{std::chrono::nanoseconds(wanted_->time)};
    return std::max(asked, sent_at_ + kBetweenCommands);
  }

  Status send(const Eigen::Vector3d& angles) {
    last_sent_ = angles;
    Status status = driver_->move(angles);
    const std::lock_guard lock(mutex_);
    sent_at_ = Clock::now();
    catch_up(time_now());
    if (status) motion_.command({time_now(), angles});
    return status;
  }

  // False when it shall stop meanwhile.
  bool find_again(const Error& error, const std::stop_token& stop) {
    say(error.what, error.remedy);
    {
      const std::lock_guard lock(mutex_);
      catch_up(time_now());
      motion_.halt();
    }
    while (!stop.stop_requested()) {
      if (driver_->connect(stop)) {
        say("is back", "nothing needs to be done");
        return true;
      }
      std::unique_lock lock(mutex_);
      commanded_.wait_for(lock, stop, kBetweenTries, [] { return false; });
    }
    return false;
  }

  void say(const std::string& what, const std::string& remedy) {
    const std::lock_guard lock(mutex_);
    events_.push_back({time_now(), FaultEvent{"gimbal '" + name_ + "'", what, remedy}});
  }

  // Brings the predicted states up to `now`.
  void catch_up(Timestamp now) const {
    Timestamp time = states_.empty() ? now : states_.back().time + kSampled;
    time = std::max(time, now - kRemembered);
    for (; time <= now; time += kSampled) states_.push_back(motion_.advance(time));
    if (states_.back().time < now) states_.push_back(motion_.advance(now));
    while (states_.front().time + kRemembered < now) states_.pop_front();
  }

  std::unique_ptr<GimbalDriver> driver_;  // of the thread
  std::string name_;
  Eigen::Vector3d last_sent_{0, 0, 0};                            // of the thread
  Clock::time_point next_check_ = Clock::now() + kBetweenChecks;  // of the thread
  mutable std::mutex mutex_;                                      // of everything below
  std::condition_variable_any commanded_;
  std::optional<GimbalCommand> wanted_;  // not yet sent
  std::int64_t commands_ = 0;
  Clock::time_point sent_at_;
  CommandLog log_;
  Events events_;
  mutable GimbalMotion motion_;
  mutable std::deque<GimbalState> states_;
  std::jthread thread_;
};

}  // namespace

std::shared_ptr<Gimbal> live_gimbal(std::unique_ptr<GimbalDriver> driver, const std::string& name,
                                    const GimbalModel& model) {
  return std::make_shared<LiveGimbal>(std::move(driver), name, model);
}

}  // namespace armsreach
