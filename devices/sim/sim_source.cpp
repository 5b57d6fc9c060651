#include "devices/sim/sim_source.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "devices/sim/color_sensor.hpp"
#include "devices/sim/depth_sensor.hpp"
#include "devices/sim/exposure.hpp"
#include "devices/sim/hand_stage.hpp"
#include "devices/sim/own_thread.hpp"
#include "devices/sim/path.hpp"
#include "devices/sim/random.hpp"
#include "devices/sim/world_renderer.hpp"
#include "render/context.hpp"
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

// A context and the world in it; all of it happens on one thread of its own.
class Studio {
 public:
  ~Studio() {
    thread_.run([this] {
      renderer_.reset();
      context_.reset();
    });
  }

  Result<ExactImages> draw(const World& world, const Camera& camera, std::uint64_t seed,
                           const Pose& world_from_camera, const std::vector<PlacedThing>& moved) {
    Result<ExactImages> images = ExactImages{};
    thread_.run([&] {
      if (!renderer_) {
        if (const Status made = make(world, camera, seed); !made) {
          images = made.error();
          return;
        }
      }
      for (const PlacedThing& one : moved) renderer_->place(one.thing, one.world_from_thing);
      images = renderer_->draw(world_from_camera);
    });
    return images;
  }

 private:
  Status make(const World& world, const Camera& camera, std::uint64_t seed) {
    auto context = render::make_headless_context();
    if (!context) return context.error();
    context_ = std::move(*context);
    auto renderer = WorldRenderer::make(context_->gl(), world, camera, seed);
    if (!renderer) return renderer.error();
    renderer_ = std::move(*renderer);
    return ok();
  }

  OwnThread thread_;
  std::unique_ptr<render::Context> context_;
  std::unique_ptr<WorldRenderer> renderer_;
};

class SimSource final : public Source {
 public:
  SimSource(const World& world, const SimOptions& options)
      : world_(world),
        options_(options),
        sensor_(sensor_info(world, options)),
        path_(world.path, mixed(options.seed, kForPath)),
        depth_sensor_(world.sensor, sensor_->camera().fx, mixed(options.seed, kForDepth)),
        color_sensor_(world.sensor, mixed(options.seed, kForColor)) {
    if (world.hands.empty()) return;
    hands_.emplace(world, sensor_->camera(),
                   [this](double time) { return path_.world_from_camera(time); });
  }

  const std::shared_ptr<const SensorInfo>& sensor() const override { return sensor_; }
  void stop() override { stopped_ = true; }
  std::optional<std::int64_t> frame_count() const override {
    if (options_.frames) return options_.frames;
    if (options_.endless) return std::nullopt;
    const double frames = path_.duration() / options_.speed * world_.sensor.rate;
    return static_cast<std::int64_t>(std::ceil(frames - 1e-9));
  }

  Result<FramePtr> next() override {
    const auto count = frame_count();
    if (stopped_ || (count && index_ >= *count)) return FramePtr();
    const double time = static_cast<double>(index_) / world_.sensor.rate;
    const double path_time = options_.speed * time;
    const Pose pose = path_.world_from_camera(path_time);
    auto exact = draw(path_time);
    if (exact) exact = while_exposed(std::move(*exact), path_time);
    if (!exact) {  // there is no context: there will be none for the next frame either
      stopped_ = true;
      return exact.error();
    }
    auto frame = std::make_shared<Frame>();
    frame->index = index_;
    frame->time = timestamp_from_seconds(time);
    frame->color = color_sensor_.measure(exact->color, time, index_);
    frame->depth = depth_sensor_.measure(exact->depth, exact->returned, index_);
    frame->sensor = sensor_;
    frame->world_from_camera = pose;
    ++index_;
    return FramePtr(std::move(frame));
  }

 private:
  // Around a closed path the script begins anew as the path does.
  double script_time(double path_time) const {
    const double turn = path_.duration();
    return world_.path.closed ? path_time - turn * std::floor(path_time / turn) : path_time;
  }

  Result<ExactImages> draw(double path_time) {
    const double script = script_time(path_time);
    auto exact = studio_.draw(world_, sensor_->camera(), mixed(options_.seed, kForPatterns),
                              path_.world_from_camera(path_time),
                              hands_ ? hands_->held(script) : std::vector<PlacedThing>());
    if (exact && hands_) hands_->draw(script, *exact);
    return exact;
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
    const Pose first = path_.world_from_camera(begin).inverse();
    const Pose last = path_.world_from_camera(end).inverse();
    double largest = picture_motion(depth, camera, last * first.inverse());
    if (!hands_) return largest;
    const auto before = hands_->truth(script_time(begin));
    const auto after = hands_->truth(script_time(end));
    for (std::size_t hand = 0; hand < before.size(); ++hand) {
      for (std::size_t joint = 0; joint < kHandJointCount; ++joint) {
        largest = std::max(
            largest,
            picture_motion(camera, first * before[hand].world_from_joint[joint].translation(),
                           last * after[hand].world_from_joint[joint].translation()));
      }
    }
    return largest;
  }

  World world_;
  SimOptions options_;
  std::shared_ptr<const SensorInfo> sensor_;
  CameraPath path_;
  DepthSensor depth_sensor_;
  ColorSensor color_sensor_;
  Studio studio_;
  std::optional<HandStage> hands_;
  std::int64_t index_ = 0;
  std::atomic<bool> stopped_{false};
};

}  // namespace

Camera camera_of(const SensorDescription& sensor) {
  const double focal = 0.5 * sensor.width / std::tan(0.5 * sensor.field_of_view);
  return pinhole(sensor.width, sensor.height, focal, focal, 0.5 * sensor.width - 0.5,
                 0.5 * sensor.height - 0.5);
}

std::unique_ptr<Source> make_sim_source(const World& world, const SimOptions& options) {
  return std::make_unique<SimSource>(world, options);
}

}  // namespace armsreach::sim
