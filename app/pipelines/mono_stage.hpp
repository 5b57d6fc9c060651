// A plain camera, tracked by its picture alone.
#pragma once

#include <optional>
#include <string>

#include "app/pipelines/hands_stage.hpp"
#include "app/pipelines/mono_statistics.hpp"
#include "app/runtime/stage.hpp"
#include "vision/core/gimbal.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/mono_slam/mono_slam.hpp"
#include "vision/mono_slam/sparse_view.hpp"

namespace armsreach::app {

struct MonoSetup {
  mono_slam::MonoSlamOptions options;
  std::optional<mono_slam::SparseMap> map;  // of another day, to be entered
};

// The direction against gravity, as far as the way a session starts says: a target is looked at
// upright, and so is whatever is seen first.
Eigen::Vector3d up_in_world(const MonoSetup& setup);

// The camera as the filter, and with it a saved map, has it.
Camera reduced(const Camera& camera);

struct MonoStageInput {
  FramePtr frame;
  HandsStatePtr hands = nullptr;        // of an earlier frame: nothing is mapped on them
  std::optional<GimbalState> gimbal{};  // at the time of the frame
};

struct MonoStageOutput {
  TrackedFramePtr tracked;
  Events events;
};

class MonoStage final : public Stage<MonoStageInput, MonoStageOutput> {
 public:
  // `sensor` has a colour camera; `gimbal` carries it, where one does.
  MonoStage(const SensorInfo& sensor, const MonoSetup& setup,
            const std::optional<GimbalModel>& gimbal);
  std::string name() const override { return "mono_slam"; }
  // The frame is passed on without its depth: what is known of the world is what was seen.
  MonoStageOutput process(const MonoStageInput& input) override;

  const MonoStatistics& statistics() const { return statistics_; }
  // The last ones; the view is null before anything is mapped.
  mono_slam::SparseMap map() const { return slam_.map(); }
  const WorldViewPtr& view() const { return view_; }

 private:
  mono_slam::MonoInput slam_input(const MonoStageInput& input);
  cv::Mat reduced_grey(const cv::Mat& picture) const;
  cv::Mat first_depth(const Frame& frame) const;
  cv::Mat without_hands(const HandsState& hands, const Frame& frame) const;
  std::optional<mono_slam::CameraControl> commanded(const std::optional<GimbalState>& now);
  void tell_of_start(const MonoStageInput& input, const mono_slam::MonoResult& result,
                     Events* events);
  void tell_scale(const mono_slam::MonoResult& result, Events* events);

  Camera camera_;  // reduced
  Pose color_from_depth_;
  Eigen::Vector3d up_in_world_;
  bool waits_for_target_;
  bool too_far_told_ = false;
  double stated_distance_;
  std::optional<GimbalModel> gimbal_;
  std::optional<GimbalState> gimbal_before_;
  mono_slam::MonoSlam slam_;
  mono_slam::SparseViewMaker views_;
  WorldViewPtr view_;
  MonoStatistics statistics_;
  mono_slam::ScaleFrom scale_told_ = mono_slam::ScaleFrom::nothing_yet;
};

}  // namespace armsreach::app
