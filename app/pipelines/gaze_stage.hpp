// Turns the camera on its gimbal after what the wearer does.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/pipelines/hands_stage.hpp"
#include "app/runtime/stage.hpp"
#include "app/session/config.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/gaze/gaze_controller.hpp"

namespace armsreach::app {

struct GazeStageInput {
  SeenFrame seen;
  std::optional<GimbalState> gimbal;  // at the time of the frame
};

struct GazeOutput {
  std::shared_ptr<const GimbalCommand> command;  // null: none
  Events events;
};

class GazeStage final : public Stage<GazeStageInput, GazeOutput> {
 public:
  // `camera` is the one whose pixels hands are seen in.
  GazeStage(const GazeConfig& config, const GimbalModel& model, const Camera& camera);
  std::string name() const override { return "gaze"; }
  GazeOutput process(const GazeStageInput& input) override;

 private:
  std::optional<Eigen::Vector2d> target(const HandsState& hands) const;

  std::string target_;
  GazeController controller_;
};

}  // namespace armsreach::app
