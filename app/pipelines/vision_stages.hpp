// The tracker and the mapper as stages.
#pragma once

#include <memory>
#include <string>

#include "app/pipelines/map_state.hpp"
#include "app/runtime/stage.hpp"
#include "app/session/config.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/core/result.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/mapping/mapper.hpp"

namespace armsreach::app {

struct TrackInput {
  FramePtr frame;
  MapStatePtr map;  // null until something is mapped
};

class TrackingStage final : public Stage<TrackInput, TrackedFramePtr> {
 public:
  explicit TrackingStage(const TrackingConfig& config);
  std::string name() const override { return "tracking"; }
  TrackedFramePtr process(const TrackInput& input) override;

 private:
  Tracker tracker_;
};

class MappingStage final : public Stage<TrackedFramePtr, MapStatePtr> {
 public:
  explicit MappingStage(const MappingConfig& config);
  std::string name() const override { return "mapping"; }
  MapStatePtr process(const TrackedFramePtr& tracked) override;

  Status save(const std::string& path) const;  // as OctoMap .ot, after the run

 private:
  mapping::Mapper mapper_;
  SurfaceCollector surface_;
  MapStatePtr state_;  // the last one published
};

}  // namespace armsreach::app
