#include "devices/sim/hand_source.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "devices/sim/color_sensor.hpp"
#include "devices/sim/depth_sensor.hpp"
#include "devices/sim/hand/hand_painter.hpp"
#include "devices/sim/hand_layer.hpp"
#include "devices/sim/hand_truth.hpp"
#include "devices/sim/hand_yaml.hpp"
#include "devices/sim/picture_light.hpp"
#include "devices/sim/random.hpp"
#include "render/assets.hpp"

namespace armsreach {
namespace sim {
namespace {

constexpr double kColorNoise = 2;  // grey levels, of an ordinary camera indoors
enum Purpose : std::uint64_t { kForColor = 11, kForDepth };

SensorDescription sensor_of(const Camera& camera) {
  SensorDescription sensor;
  sensor.width = camera.width;
  sensor.height = camera.height;
  sensor.nearest = 0;
  sensor.farthest = 100;
  sensor.color = kCleanColor;
  sensor.color.noise = kColorNoise;
  sensor.color.sharpness = ColorDescription().sharpness;
  return sensor;
}

// Depth as the colour camera would have it, where the two are apart: every depth pixel falls on
// about one colour pixel and its right and lower neighbour.
cv::Mat depth_for_color(const Frame& frame) {
  const SensorInfo& sensor = *frame.sensor;
  if (frame.depth.empty() || sensor.registered) return frame.depth;
  const Camera& camera = *sensor.color_camera;
  cv::Mat seen(camera.height, camera.width, CV_32F, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < frame.depth.rows; ++y) {
    for (int x = 0; x < frame.depth.cols; ++x) {
      const double z = static_cast<double>(frame.depth.at<float>(y, x));
      if (!(z > 0)) continue;
      const Eigen::Vector3d point =
          sensor.color_from_depth * Eigen::Vector3d(z * unproject(*sensor.depth_camera, {x, y}));
      const auto pixel = project(camera, point);
      if (!pixel || !camera.contains(*pixel)) continue;
      const int u = static_cast<int>(std::lround(pixel->x()));
      const int v = static_cast<int>(std::lround(pixel->y()));
      for (int i = 0; i < 4; ++i) {
        const cv::Point at(std::min(u + i % 2, seen.cols - 1), std::min(v + i / 2, seen.rows - 1));
        float& nearest = seen.at<float>(at);
        if (!(nearest <= static_cast<float>(point.z()))) nearest = static_cast<float>(point.z());
      }
    }
  }
  return seen;
}

class HandSource final : public Source {
 public:
  HandSource(std::unique_ptr<Source> scene, const std::vector<HandDescription>& hands,
             std::uint64_t seed)
      : scene_(std::move(scene)), painter_(hands) {
    const SensorInfo& info = *scene_->sensor();
    if (info.color_camera) {
      color_raster_.emplace(*info.color_camera);
      color_sensor_.emplace(sensor_of(*info.color_camera), mixed(seed, kForColor));
    }
    if (info.depth_camera) {
      depth_raster_.emplace(*info.depth_camera);
      depth_sensor_.emplace(sensor_of(*info.depth_camera), info.depth_camera->fx,
                            mixed(seed, kForDepth));
    }
    in_world_ = std::any_of(hands.begin(), hands.end(), [](const HandDescription& hand) {
      return hand.frame == HandFrame::world;
    });
  }

  const std::shared_ptr<const SensorInfo>& sensor() const override { return scene_->sensor(); }
  std::vector<std::shared_ptr<Actuator>> actuators() const override { return scene_->actuators(); }
  void stop() override { scene_->stop(); }
  Events take_events() override { return scene_->take_events(); }
  bool live() const override { return scene_->live(); }
  std::optional<std::int64_t> frame_count() const override { return scene_->frame_count(); }

  Result<FramePtr> next() override {
    auto behind = scene_->next();
    if (!behind || !*behind) return behind;
    auto frame = std::make_shared<Frame>(**behind);
    if (in_world_ && !frame->world_from_camera) {
      return Error{"a hand is scripted in the world, and this frame's pose is not known",
                   "frame " + std::to_string(frame->index),
                   "use a script in the camera's frame, or a source with poses"};
    }
    if (!start_) start_ = frame->time;
    draw_hands(*frame);
    return FramePtr(std::move(frame));
  }

 private:
  void draw_hands(Frame& frame) {
    const Pose world_from_camera = frame.world_from_camera.value_or(Pose());
    const double time = seconds_from_timestamp(frame.time - *start_);
    painter_.set_time(time, world_from_camera);
    auto truth = std::make_shared<Truth>(frame.truth ? *frame.truth : Truth());
    if (!frame.truth) truth->world_from_camera = world_from_camera;
    const int last = last_mask(*truth);
    const cv::Mat exact = frame.truth ? frame.truth->depth : cv::Mat();
    if (!frame.color.empty() && color_raster_) {
      const Raster::Images hands = draw_color(frame, world_from_camera, exact);
      lay_truth(hands, frame.color.size(), last, *truth);
    }
    if (!frame.depth.empty() && depth_raster_) {
      const Raster::Images hands = draw_depth(frame, world_from_camera, exact);
      if (frame.color.empty()) lay_truth(hands, frame.depth.size(), last, *truth);
    }
    add_hands(painter_.truth(time, world_from_camera), *truth);
    frame.truth = std::move(truth);
  }

  // In the picture's own camera. A recording knows no depth to lay the hands into.
  static void lay_truth(const Raster::Images& hands, const cv::Size& size, int last, Truth& truth) {
    const bool known = truth.masks.size() == size;
    truth.masks = known ? truth.masks.clone() : cv::Mat::zeros(size, CV_16U);
    lay_masks(hands, last, truth.masks);
    if (truth.depth.size() != size) return;
    truth.depth = truth.depth.clone();
    lay_depth(hands, truth.depth);
  }

  // What hides hands: the exact depth where it is known, else what is measured.
  static cv::Mat hiding(const cv::Mat& exact, const cv::Size& size, const cv::Mat& measured) {
    return exact.size() == size ? exact : measured;
  }

  Raster::Images draw_color(Frame& frame, const Pose& world_from_camera, const cv::Mat& exact) {
    const Pose world_from_color = world_from_camera * frame.sensor->color_from_depth.inverse();
    light_.look_at(frame.color);
    Raster::Images hands =
        painter_.draw(*color_raster_, world_from_color, light_.lighting(world_from_color));
    if (hands.place.empty()) return hands;
    hide_behind(hiding(exact, frame.color.size(), depth_for_color(frame)), hands);
    cv::Mat drawn = frame.color.clone();
    lay_color(hands, drawn);
    // Lens and noise of a camera, on the hand alone: the picture behind has its own.
    if (drawn.type() == CV_8UC3) {
      const cv::Mat measured = color_sensor_->measure(drawn, 0, frame.index);
      measured(hands.place).copyTo(drawn(hands.place), hands.coverage);
    }
    frame.color = drawn;
    return hands;
  }

  Raster::Images draw_depth(Frame& frame, const Pose& world_from_camera, const cv::Mat& exact) {
    Raster::Images hands =
        painter_.draw(*depth_raster_, world_from_camera, light_.lighting(world_from_camera));
    if (hands.place.empty()) return hands;
    hide_behind(hiding(exact, frame.depth.size(), frame.depth), hands);
    cv::Mat alone(frame.depth.size(), CV_32F, std::numeric_limits<float>::quiet_NaN());
    lay_depth(hands, alone);
    const cv::Mat returned(frame.depth.size(), CV_8U, cv::Scalar(kSkinReturns));
    const cv::Mat measured = depth_sensor_->measure(alone, returned, frame.index);
    cv::Mat depth = frame.depth.clone();
    measured.copyTo(depth, alone == alone);
    frame.depth = depth;
    return hands;
  }

  std::unique_ptr<Source> scene_;
  HandPainter painter_;
  std::optional<Raster> color_raster_;
  std::optional<Raster> depth_raster_;
  std::optional<ColorSensor> color_sensor_;
  std::optional<DepthSensor> depth_sensor_;
  PictureLight light_;
  bool in_world_ = false;
  std::optional<Timestamp> start_;
};

// A script by the name of one that comes with the program, or by its file.
Result<std::vector<HandDescription>> load_script(const std::string& script) {
  if (!script.ends_with(".yaml")) {
    if (script != "gestures" && script != "numerals" && script != "tour") {
      return Error{"there is no hand script '" + script + "'", "script=" + script,
                   "give gestures, numerals, tour, or a file that ends in .yaml"};
    }
    const std::string name = "hands/" + script + ".yaml";
    std::istringstream text{std::string(render::asset(name))};
    return read_hand_script(text, name);
  }
  std::ifstream file(script);
  if (!file) return Error{"cannot be read", script, "check the path of the hand script"};
  return read_hand_script(file, script);
}

}  // namespace

std::unique_ptr<Source> make_hand_source(std::unique_ptr<Source> scene,
                                         const std::vector<HandDescription>& hands,
                                         std::uint64_t seed) {
  return std::make_unique<HandSource>(std::move(scene), hands, seed);
}

}  // namespace sim

SourceKind hand_source_kind(const std::vector<SourceKind>& others) {
  SourceKind kind;
  kind.name = "sim-hand";
  kind.usage =
      "sim-hand:SOURCE[,script=gestures|numerals|tour|FILE.yaml][,seed=N][,the source's own "
      "options]";
  kind.option_keys = {"script", "seed"};
  for (const SourceKind& other : others) {
    for (const std::string& key : other.option_keys) {
      if (std::count(kind.option_keys.begin(), kind.option_keys.end(), key) == 0)
        kind.option_keys.push_back(key);
    }
  }
  kind.open = [others](const SourceSpec& spec,
                       const OpenOptions& options) -> Result<std::unique_ptr<Source>> {
    auto behind = parse_source_spec(spec.place);
    if (!behind) return behind.error();
    const auto seed = number_option(spec, "seed", 1, 0, 1e15);
    if (!seed) return seed.error();
    const auto kind_behind = std::find_if(others.begin(), others.end(), [&](const SourceKind& one) {
      return one.name == behind->kind;
    });
    for (const auto& one : spec.options) {
      const bool own = one.first == "script";
      // The seed is the hand's, and the source's own if it has one.
      const bool unknown =
          one.first == "seed" && kind_behind != others.end() &&
          std::count(kind_behind->option_keys.begin(), kind_behind->option_keys.end(), "seed") == 0;
      if (!own && !unknown) behind->options.push_back(one);
    }
    auto hands = sim::load_script(option(spec, "script").value_or("gestures"));
    if (!hands) return hands.error();
    auto scene = open_source(*behind, options, others);
    if (!scene) return scene;
    return sim::make_hand_source(std::move(*scene), *hands, static_cast<std::uint64_t>(*seed));
  };
  kind.probe = [] {
    return std::vector<Availability>{
        {"sim-hand:SOURCE", true, "a simulated hand in front of another source", ""}};
  };
  return kind;
}

}  // namespace armsreach
