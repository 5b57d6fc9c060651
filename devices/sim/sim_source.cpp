#include "devices/sim/sim_source.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "devices/image_file.hpp"
#include "devices/sim/carrier.hpp"
#include "devices/sim/color_sensor.hpp"
#include "devices/sim/contacts.hpp"
#include "devices/sim/depth_sensor.hpp"
#include "devices/sim/exposure.hpp"
#include "devices/sim/hand_stage.hpp"
#include "devices/sim/hand_truth.hpp"
#include "devices/sim/motion.hpp"
#include "devices/sim/random.hpp"
#include "devices/sim/sim_gimbal.hpp"
#include "devices/sim/studio.hpp"
#include "devices/truth.hpp"
#include "vision/core/time.hpp"

namespace armsreach::sim {
namespace {

// What randomness is drawn for; each purpose has a seed of its own.
enum Purpose : std::uint64_t { kForPath = 1, kForPatterns, kForDepth, kForColor };

std::shared_ptr<const SensorInfo> sensor_info(const World& world, const SimOptions& options) {
  auto info = std::make_shared<SensorInfo>();
  info->name = options.sensor_name;
  info->color_camera = camera_of(world.sensor);
  info->depth_camera = info->color_camera;
  info->rate = world.sensor.rate;
  return info;
}

class SimSource final : public Source {
 public:
  SimSource(const World& world, const SimOptions& options)
      : world_(world),
        options_(options),
        sensor_(sensor_info(world, options)),
        carrier_(carrier_of(world, world.sensor, mixed(options.seed, kForPath))),
        depth_sensor_(world.sensor, sensor_->camera().fx, mixed(options.seed, kForDepth)),
        color_sensor_(world.sensor, mixed(options.seed, kForColor)),
        contacts_(world) {
    if (world.sensor.gimbal) {
      gimbal_ = std::make_shared<SimGimbal>(options.sensor_name, *world.sensor.gimbal,
                                            world.sensor.gimbal_script);
    }
    if (world.hands.empty()) return;
    const auto world_from_carrier = [this](double time) {
      return carrier_(time) * camera_on_mount(Eigen::Vector3d::Zero());
    };
    hands_.emplace(world, sensor_->camera(), world_from_carrier,
                   shoulders_of(world, world.sensor, mixed(options.seed, kForPath)));
  }

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  void stop() override { stopped_ = true; }
  std::vector<std::shared_ptr<Actuator>> actuators() const override {
    if (!gimbal_) return {};
    return {gimbal_};
  }
  std::optional<std::int64_t> frame_count() const override {
    if (options_.frames) return options_.frames;
    if (options_.endless) return std::nullopt;
    const double frames = world_.path.duration / options_.speed * world_.sensor.rate;
    return static_cast<std::int64_t>(std::ceil(frames - 1e-9));
  }

  Result<FramePtr> next() override {
    const auto count = frame_count();
    if (stopped_ || (count && index_ >= *count)) return FramePtr();
    const double time = static_cast<double>(index_) / world_.sensor.rate;
    const double path_time = options_.speed * time;
    if (gimbal_) gimbal_state_ = gimbal_->advance(timestamp_from_seconds(time));
    auto exact = draw(path_time);
    if (!exact) return failed(exact.error());
    auto frame = std::make_shared<Frame>();
    frame->world_from_camera = camera_at(path_time);
    frame->truth = truth_at(path_time, *exact);
    exact = while_exposed(std::move(*exact), path_time);
    if (!exact) return failed(exact.error());
    frame->index = index_;
    frame->time = timestamp_from_seconds(time);
    frame->color = color_sensor_.measure(exact->color, time, index_);
    frame->depth = in_whole_units(depth_sensor_.measure(exact->depth, exact->returned, index_));
    frame->sensor = sensor_;
    ++index_;
    return FramePtr(std::move(frame));
  }

 private:
  // There is no context: there will be none for the next frame either.
  Error failed(const Error& error) {
    stopped_ = true;
    return error;
  }

  // As a device hands depth over; an exact sensor is none.
  cv::Mat in_whole_units(const cv::Mat& depth) const {
    if (world_.sensor.noise == 0) return depth;
    const double units = sensor_->camera().depth_units_per_metre;
    return depth_from_units(units_from_depth(depth, units), units);
  }

  // Around a closed path the script begins anew as the path does.
  double script_time(double path_time) const {
    const double turn = world_.path.duration;
    return world_.path.closed ? path_time - turn * std::floor(path_time / turn) : path_time;
  }

  Pose camera_on_mount(const Eigen::Vector3d& angles) const {
    return gimbal_ ? mount_from_camera(gimbal_->model(), angles) : world_.sensor.mount_from_camera;
  }

  // The gimbal goes on as it moves now for the fractions of a frame that an exposure takes.
  Pose camera_at(double path_time) const {
    const double since = path_time / options_.speed - seconds_from_timestamp(gimbal_state_.time);
    return carrier_(path_time) *
           camera_on_mount(gimbal_state_.angles + since * gimbal_state_.rates);
  }

  std::vector<Pose> things_at(double path_time) const {
    const double script = script_time(path_time);
    std::vector<Pose> poses = poses_at(world_, script);
    if (!hands_) return poses;
    for (const PlacedThing& one : hands_->held(script)) poses[one.thing] = one.world_from_thing;
    return poses;
  }

  Result<ExactImages> draw(double path_time) {
    auto exact = studio_.draw(world_, sensor_->camera(), mixed(options_.seed, kForPatterns),
                              camera_at(path_time), things_at(path_time));
    if (exact && hands_) hands_->draw(script_time(path_time), camera_at(path_time), *exact);
    return exact;
  }

  // Right after what was drawn for that time.
  std::shared_ptr<const Truth> truth_at(double path_time, const ExactImages& exact) {
    auto truth = std::make_shared<Truth>();
    truth->world_from_camera = camera_at(path_time);
    if (gimbal_) truth->gimbal = gimbal_state_;
    truth->depth = exact.depth;
    truth->masks = exact.masks;
    const std::vector<Pose> poses = things_at(path_time);
    for (std::size_t i = 0; i < poses.size(); ++i)
      truth->things.push_back({world_.things[i].name, static_cast<int>(i) + 1, poses[i]});
    for (const auto& [a, b] : contacts_.at(poses)) {
      truth->contacts.emplace_back(world_.things[static_cast<std::size_t>(a)].name,
                                   world_.things[static_cast<std::size_t>(b)].name);
    }
    if (!hands_) return truth;
    const double script = script_time(path_time);
    add_hands(hands_->truth(script), *truth);
    add_touches(poses, *truth);
    truth->markers = hands_->markers(script, truth->world_from_camera, exact.depth);
    return truth;
  }

  void add_touches(const std::vector<Pose>& things, Truth& truth) {
    const auto touched = hands_->touched(things);
    for (std::size_t hand = 0; hand < touched.size(); ++hand) {
      for (const auto& [thing, part] : touched[hand]) {
        truth.contacts.emplace_back(world_.things[static_cast<std::size_t>(thing)].name,
                                    truth.hands[hand].name + "/" + std::string(name(part)));
      }
    }
  }

  // `middle` with the colour of the whole exposure around its moment.
  Result<ExactImages> while_exposed(ExactImages middle, double path_time) {
    const double duration = options_.speed * world_.sensor.color.exposure;
    if (duration == 0) return middle;
    const double moves = motion(middle.depth, path_time, duration);
    return exposed(std::move(middle), duration, moves,
                   [&](double moment) { return draw(path_time + moment); });
  }

  // How far anything moves in the picture, in px.
  double motion(const cv::Mat& depth, double path_time, double duration) const {
    const double begin = path_time - duration / 2;
    const double end = path_time + duration / 2;
    const Camera& camera = sensor_->camera();
    const Pose first = camera_at(begin).inverse();
    const Pose last = camera_at(end).inverse();
    double largest = picture_motion(depth, camera, last * first.inverse());
    const auto add = [&](const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
      largest = std::max(largest, picture_motion(camera, first * before, last * after));
    };
    const std::vector<Pose> things_before = things_at(begin);
    const std::vector<Pose> things_after = things_at(end);
    for (std::size_t i = 0; i < world_.things.size(); ++i) {
      if (world_.things[i].moves)
        add(things_before[i].translation(), things_after[i].translation());
    }
    if (!hands_) return largest;
    const auto before = hands_->truth(script_time(begin));
    const auto after = hands_->truth(script_time(end));
    for (std::size_t hand = 0; hand < before.size(); ++hand) {
      for (std::size_t joint = 0; joint < kHandJointCount; ++joint) {
        add(before[hand].world_from_joint[joint].translation(),
            after[hand].world_from_joint[joint].translation());
      }
    }
    return largest;
  }

  World world_;
  SimOptions options_;
  std::shared_ptr<const SensorInfo> sensor_;
  Carrier carrier_;
  DepthSensor depth_sensor_;
  ColorSensor color_sensor_;
  ContactFinder contacts_;
  Studio studio_;
  std::shared_ptr<SimGimbal> gimbal_;
  GimbalState gimbal_state_;
  std::optional<HandStage> hands_;
  std::int64_t index_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace

Camera camera_of(const SensorDescription& sensor) {
  const double focal = 0.5 * sensor.width / std::tan(0.5 * sensor.field_of_view);
  Camera camera = pinhole(sensor.width, sensor.height, focal, focal, 0.5 * sensor.width - 0.5,
                          0.5 * sensor.height - 0.5);
  camera.depth_units_per_metre = std::min(5000.0, std::floor(65534 / sensor.farthest));
  return camera;
}

std::unique_ptr<Source> make_sim_source(const World& world, const SimOptions& options) {
  return std::make_unique<SimSource>(world, options);
}

}  // namespace armsreach::sim
