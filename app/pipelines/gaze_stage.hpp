// Turns the camera on its gimbal after what the wearer does, or to a place in the world.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/pipelines/hand_watch.hpp"
#include "app/pipelines/hands_stage.hpp"
#include "app/runtime/stage.hpp"
#include "app/session/config.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/gaze/gaze_controller.hpp"

namespace armsreach::app {

// Where inserted objects are, by their ids.
using ObjectPlaces = std::map<std::int64_t, Eigen::Vector3d>;
using ObjectPlacesPtr = std::shared_ptr<const ObjectPlaces>;

struct GazeStageInput {
  SeenFrame seen;
  std::optional<GimbalState> gimbal;  // at the time of the frame
  ObjectPlacesPtr objects = nullptr;  // of an earlier frame
};

struct GazeOutput {
  std::shared_ptr<const GimbalCommand> command;  // null: none
  Events events;
};

class GazeStage final : public Stage<GazeStageInput, GazeOutput> {
 public:
  // `camera` is the one whose pixels hands are seen in; `up_in_world` is zero where nobody knows;
  // `delay` [s] is how long after its frame a command will be given.
  GazeStage(const GazeConfig& config, const GimbalModel& model, const Camera& camera,
            const Eigen::Vector3d& up_in_world, double delay);
  std::string name() const override { return "gaze"; }
  GazeOutput process(const GazeStageInput& input) override;

 private:
  std::optional<Eigen::Vector2d> target(const HandsState& hands) const;
  std::optional<Eigen::Vector2d> followed(const SeenFrame& seen);
  std::optional<Eigen::Vector3d> point_in_world(const GazeStageInput& input) const;
  void aim(const GazeStageInput& input);

  GazeConfig config_;
  std::optional<Eigen::Vector3d> aimed_at_;  // in the world
  Timestamp delay_;
  GazeController controller_;
  HandWatch watch_;
};

}  // namespace armsreach::app
