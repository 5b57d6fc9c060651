// Finds out, of a source that does not say, whether colour and depth are registered, and where they
// are not, the colour camera.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/runtime/stage.hpp"
#include "vision/core/event.hpp"
#include "vision/core/frame.hpp"
#include "vision/registration/color_camera_estimator.hpp"

namespace armsreach::app {

// What has become known since the run began, to be told whenever it is another one.
struct RegistrationState {
  Registration registration = Registration::cannot_tell;
  std::shared_ptr<const SensorInfo> sensor;  // with the colour camera; null unless estimated
  std::optional<FaultEvent> fault;           // none where all is as assumed
};
using RegistrationStatePtr = std::shared_ptr<const RegistrationState>;

// The frame as it is, or with the sensor that was found for it.
FramePtr with_known_color(const FramePtr& frame, const RegistrationStatePtr& registration);

class RegistrationStage final : public Stage<FramePtr, RegistrationStatePtr> {
 public:
  // `sensor` has a colour and a depth camera.
  explicit RegistrationStage(std::shared_ptr<const SensorInfo> sensor);
  std::string name() const override { return "registration"; }
  // Always all that is known, so that a reader may skip any; null while that is nothing.
  RegistrationStatePtr process(const FramePtr& frame) override;

 private:
  std::shared_ptr<const SensorInfo> sensor_;
  ColorCameraEstimator estimator_;
  RegistrationStatePtr state_;
};

}  // namespace armsreach::app
