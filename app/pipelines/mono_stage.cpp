#include "app/pipelines/mono_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/core/registration.hpp"

namespace armsreach::app {
namespace {

constexpr int kWidth = 320;             // px, that pictures are reduced to
constexpr std::int64_t kPatience = 60;  // frames without the start target before that is said
constexpr double kHandMargin = 0.03;    // of the picture's width, that a hand may have moved by

// A camera on a gimbal is carried by a body, not held in a hand: besides what is commanded it moves
// less abruptly.
mono_slam::MonoSlamOptions carried(mono_slam::MonoSlamOptions options, bool by_gimbal) {
  if (!by_gimbal) return options;
  options.motion.acceleration = 1;          // m/s^2
  options.motion.angular_acceleration = 1;  // rad/s^2
  return options;
}

}  // namespace

Camera reduced(const Camera& camera) {
  if (camera.width <= kWidth) return camera;
  return resized(camera, kWidth,
                 cvRound(static_cast<double>(kWidth) * camera.height / camera.width));
}

Eigen::Vector3d up_in_world(const MonoSetup& setup) {
  bool on_target = setup.options.target.has_value();
  if (setup.map) {
    const auto& known = setup.map->landmarks;
    on_target |= std::any_of(known.begin(), known.end(), [](const auto& l) { return l.of_target; });
  }
  return on_target ? Eigen::Vector3d(0, 1, 0) : Eigen::Vector3d(0, -1, 0);
}

MonoStage::MonoStage(const SensorInfo& sensor, const MonoSetup& setup,
                     const std::optional<GimbalModel>& gimbal)
    : camera_(reduced(*sensor.color_camera)),
      color_from_depth_(sensor.depth_camera ? sensor.color_from_depth : Pose()),
      up_in_world_(app::up_in_world(setup)),
      waits_for_target_(setup.options.target && !setup.map),
      stated_distance_(setup.options.stated_distance),
      gimbal_(gimbal),
      slam_(camera_, carried(setup.options, gimbal.has_value())) {
  if (setup.map) slam_.enter(*setup.map);
}

MonoStageOutput MonoStage::process(const MonoStageInput& input) {
  if (input.frame->color.empty()) throw std::runtime_error("a frame has no picture to track");
  const auto result = std::make_shared<const mono_slam::MonoResult>(slam_.step(slam_input(input)));
  statistics_.add(*result);

  MonoStageOutput out;
  tell_of_start(input, *result, &out.events);
  tell_scale(*result, &out.events);
  auto seen = std::make_shared<Frame>(*input.frame);
  seen->depth.release();
  auto tracked = std::make_shared<TrackedFrame>();
  tracked->frame = std::move(seen);
  tracked->state = result->state;
  tracked->camera = camera_;
  tracked->world_from_camera = result->world_from_camera * color_from_depth_;
  tracked->pose_seen = result->pose_seen;
  tracked->compared = result->visible;
  tracked->inliers = result->inliers;
  double squares = 0;
  for (const mono_slam::MapPoint& point : result->points) {
    if (point.outcome == mono_slam::Outcome::measured) squares += point.residual * point.residual;
  }
  if (result->inliers > 0) tracked->rms = std::sqrt(squares / result->inliers);
  if (result->scale != mono_slam::ScaleFrom::nothing_yet)
    view_ = views_.view(*result, up_in_world_);
  tracked->world = view_;
  tracked->mono = result;
  tracked->up_in_world = up_in_world_;
  out.tracked = std::move(tracked);
  return out;
}

mono_slam::MonoInput MonoStage::slam_input(const MonoStageInput& input) {
  mono_slam::MonoInput out;
  out.time = input.frame->time;
  out.grey = reduced_grey(input.frame->color);
  if (input.hands) out.allowed = without_hands(*input.hands, *input.frame);
  if (slam_.state() == TrackingState::initialising) out.depth = first_depth(*input.frame);
  out.control = commanded(input.gimbal);
  return out;
}

cv::Mat MonoStage::reduced_grey(const cv::Mat& picture) const {
  cv::Mat grey = picture;
  if (picture.channels() == 3) cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  const cv::Size size(camera_.width, camera_.height);
  if (grey.size() == size) return grey;
  cv::Mat small;
  cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
  return small;
}

cv::Mat MonoStage::first_depth(const Frame& frame) const {
  if (frame.depth.empty()) return {};
  const Camera camera = resized(*frame.sensor->depth_camera, frame.depth.cols, frame.depth.rows);
  return registered_depth(frame.depth, camera, camera_, color_from_depth_);
}

// Nothing is mapped where hands are, or may have moved to. What shows no gesture may as well be
// wood or a wall, which is where the points are.
cv::Mat MonoStage::without_hands(const HandsState& hands, const Frame& frame) const {
  std::vector<std::vector<cv::Point>> outlines;
  const double scale = static_cast<double>(camera_.width) / frame.color.cols;
  for (const gesture::Hand& hand : hands.hands) {
    if (hand.gesture.empty()) continue;
    std::vector<cv::Point> outline;
    for (const cv::Point& p : hand.seen.outline)
      outline.emplace_back(cvRound(scale * p.x), cvRound(scale * p.y));
    if (!outline.empty()) outlines.push_back(std::move(outline));
  }
  if (outlines.empty()) return {};
  cv::Mat allowed(camera_.height, camera_.width, CV_8UC1, cv::Scalar(255));
  cv::fillPoly(allowed, outlines, cv::Scalar(0));
  const int margin = 2 * cvRound(kHandMargin * camera_.width) + 1;
  cv::erode(allowed, allowed, cv::getStructuringElement(cv::MORPH_RECT, {margin, margin}));
  return allowed;
}

// How the gimbal has turned the camera since the last frame, and how far that is to be trusted:
// servos read their angles to a milliradian, and late by a small part of the way.
std::optional<mono_slam::CameraControl> MonoStage::commanded(
    const std::optional<GimbalState>& now) {
  if (!gimbal_ || !now) return std::nullopt;
  const std::optional<GimbalState> before = std::exchange(gimbal_before_, now);
  if (!before) return std::nullopt;
  constexpr double kReading = 0.001;  // rad
  constexpr double kShare = 0.005;
  constexpr double kArm = 0.03;  // m, over which a wrong angle moves the camera
  const Pose turned = camera_motion(*gimbal_, before->angles, now->angles);
  mono_slam::CameraControl control;
  control.before_from_after = color_from_depth_ * turned * color_from_depth_.inverse();
  const double angle = (now->angles - before->angles).norm();
  // A gimbal at rest commands nothing, and nothing is doubted because of it.
  if (angle < 1e-4) return control;
  control.rotation_sigma = kReading + kShare * angle;
  control.translation_sigma = kArm * control.rotation_sigma;
  return control;
}

// What a session that cannot start yet waits for.
void MonoStage::tell_of_start(const MonoStageInput& input, const mono_slam::MonoResult& result,
                              Events* events) {
  const auto tell = [&](const char* what, const char* remedy) {
    events->push_back({result.time, FaultEvent{"tracking", what, remedy}});
  };
  const bool waits = result.state == TrackingState::initialising;
  if (waits && result.target == mono_slam::TargetSight::too_far && !too_far_told_) {
    too_far_told_ = true;
    tell("the start target is seen, but too small to say where the camera is",
         "bring the target closer, or the camera to it, until it fills a fifth of the picture's "
         "width");
  } else if (waits && waits_for_target_ && !too_far_told_ && result.frame == kPatience) {
    tell("the start target has not been seen yet",
         "hold the camera so that the whole target is in the picture, upright and from the front");
  }
  if (result.state_changed && result.scale == mono_slam::ScaleFrom::stated &&
      !input.frame->depth.empty()) {
    tell("the depth frames show too little to measure the scale by",
         "start before things within the depth camera's range");
  }
}

void MonoStage::tell_scale(const mono_slam::MonoResult& result, Events* events) {
  if (std::exchange(scale_told_, result.scale) == result.scale ||
      result.scale != mono_slam::ScaleFrom::stated)
    return;
  char text[96];
  std::snprintf(text, sizeof text,
                "the scale is stated, not measured: what is seen first is %g m away",
                stated_distance_);
  events->push_back(
      {result.time, FaultEvent{"tracking", text,
                               "start on a target (`armsreach calibrate target`), or in the "
                               "configuration mono_slam: {stated_distance: METRES}"}});
}

}  // namespace armsreach::app
