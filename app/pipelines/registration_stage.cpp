#include "app/pipelines/registration_stage.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <utility>

#include "vision/core/camera_yaml.hpp"

namespace armsreach::app {
namespace {

constexpr double kWellKnown = 2;  // px

// One standard deviation at each depth, and where there was anything to judge by.
std::string reliability(const ColorSearchResult& search) {
  std::string text = "; good to";
  char item[80];
  for (std::size_t i = 0; i < kUncertaintyDepths.size(); ++i) {
    std::snprintf(item, sizeof item, "%s %.1f px at %g m", i == 0 ? "" : ",",
                  search.uncertainty_at[i], kUncertaintyDepths[i]);
    text += item;
  }
  std::snprintf(item, sizeof item, " (one sigma; contours were seen at %.1f to %.1f m)",
                search.nearest, search.farthest);
  return text + item;
}

// Only near things tell the baseline.
bool wants_near_things(const ColorSearchResult& search) {
  return search.uncertainty_at.front() > kWellKnown && search.nearest > kUncertaintyDepths.front();
}

FaultEvent estimated(const RegistrationVerdict& verdict, const SensorInfo& sensor) {
  const Pose& pose = sensor.color_from_depth;
  const Camera& camera = *sensor.color_camera;
  char message[240];
  std::snprintf(message, sizeof message,
                "colour is not registered with depth (%.0f px off); its camera as estimated from "
                "%d frames: f %.1f px, centre %.1f, %.1f, %.1f mm beside, roll %.2f deg",
                verdict.search.displacement, verdict.frames, camera.fx, camera.cx, camera.cy,
                1e3 * std::abs(pose.translation().x()),
                so3_log(pose.rotation()).z() * 180 / std::numbers::pi);
  std::ostringstream remedy;
  if (wants_near_things(verdict.search)) {
    remedy << "to know it better up close, begin with things at arm's length before others; else ";
  }
  remedy << "write this as the recording's camera_color.yaml:\n";
  write_camera_yaml(remedy, {camera, pose});
  return {"registration", message + reliability(verdict.search), remedy.str()};
}

FaultEvent cannot_tell() {
  return {"registration",
          "too little structure to tell whether colour and depth are registered: assuming so",
          "move the camera past things that stand before others, or write camera_color.yaml (with "
          "a camera_from_depth of zeros if they are registered)"};
}

}  // namespace

FramePtr with_known_color(const FramePtr& frame, const RegistrationStatePtr& registration) {
  if (!registration || !registration->sensor) return frame;
  auto known = std::make_shared<Frame>(*frame);
  known->sensor = registration->sensor;
  return known;
}

RegistrationStage::RegistrationStage(std::shared_ptr<const SensorInfo> sensor)
    : sensor_(std::move(sensor)), estimator_(*sensor_->depth_camera, *sensor_->color_camera) {}

RegistrationStatePtr RegistrationStage::process(const FramePtr& frame) {
  const auto verdict = estimator_.add(*frame);
  if (!verdict) return state_;
  auto state = std::make_shared<RegistrationState>();
  state->registration = verdict->registration;
  if (verdict->registration == Registration::cannot_tell) state->fault = cannot_tell();
  if (verdict->registration == Registration::estimated) {
    auto sensor = std::make_shared<SensorInfo>(*sensor_);
    sensor->registered = false;
    sensor->color_camera = verdict->color.camera;
    sensor->color_camera->name += "_color";
    sensor->color_from_depth = verdict->color.camera_from_depth;
    state->fault = estimated(*verdict, *sensor);
    state->sensor = std::move(sensor);
  }
  state_ = std::move(state);
  return state_;
}

}  // namespace armsreach::app
