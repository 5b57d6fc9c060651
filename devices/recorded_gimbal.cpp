#include "devices/recorded_gimbal.hpp"

#include <fstream>
#include <mutex>
#include <utility>

#include "devices/gimbal_lists.hpp"

namespace armsreach {
namespace {

class RecordedGimbal final : public Gimbal {
 public:
  RecordedGimbal(std::string name, const GimbalModel& model, std::vector<GimbalState> states)
      : name_(std::move(name)), model_(model), states_(std::move(states)) {}

  const std::string& name() const override { return name_; }
  Status rest() override { return ok(); }
  const GimbalModel& model() const override { return model_; }
  std::optional<GimbalState> state_at(Timestamp time) const override {
    return interpolated_state(states_, time);
  }
  std::vector<GimbalCommand> take_commands() override { return {}; }

  Status command(const GimbalCommand& command) override {
    const std::lock_guard lock(mutex_);
    if (std::exchange(told_, true)) return ok();
    FaultEvent fault{"gimbal '" + name_ + "'", "a recorded gimbal moves as it once did",
                     "use a live or simulated source to move it"};
    events_.push_back({command.time, std::move(fault)});
    return ok();
  }

  Events take_events() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
  }

 private:
  std::string name_;
  GimbalModel model_;
  std::vector<GimbalState> states_;
  std::mutex mutex_;
  bool told_ = false;
  Events events_;
};

}  // namespace

Result<std::unique_ptr<Gimbal>> open_recorded_gimbal(const std::string& name,
                                                     const GimbalModel& model,
                                                     const std::filesystem::path& states) {
  std::ifstream in(states);
  if (!in) {
    return Error{"no gimbal's states", states.string(),
                 "record again, or take 'gimbal' out of the rig file"};
  }
  auto read = read_gimbal_states(in, states.string());
  if (!read) return std::move(read).error();
  return std::unique_ptr<Gimbal>(std::make_unique<RecordedGimbal>(name, model, std::move(*read)));
}

}  // namespace armsreach
