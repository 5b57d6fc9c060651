// The tracker, the mapper and the relocaliser as stages.
#pragma once

#include <memory>
#include <string>

#include "app/pipelines/map_state.hpp"
#include "app/pipelines/registration_stage.hpp"
#include "app/runtime/stage.hpp"
#include "app/session/config.hpp"
#include "app/session/saved_world.hpp"
#include "vision/alignment/tracker.hpp"
#include "vision/core/tracked_frame.hpp"
#include "vision/mapping/mapper.hpp"
#include "vision/relocalisation/relocaliser.hpp"

namespace armsreach::app {

mapping::MapperOptions mapper_options(const MappingConfig& config);

struct TrackInput {
  FramePtr frame;
  MapStatePtr map;                              // null until something is mapped
  RegistrationStatePtr registration = nullptr;  // null until something is known of it
};

class TrackingStage final : public Stage<TrackInput, TrackedFramePtr> {
 public:
  // In a map that is there already the camera is lost until it is found; without one, the world is
  // where the camera is first.
  TrackingStage(const TrackingConfig& config, bool map_exists);
  std::string name() const override { return "tracking"; }
  TrackedFramePtr process(const TrackInput& input) override;

 private:
  Tracker tracker_;
};

// Where a lost camera may be.
struct Proposal {
  Camera camera;  // of the reduced images
  Pose world_from_camera;
  std::int64_t frame = -1;  // index of the frame that was recognised
};
using ProposalPtr = std::shared_ptr<const Proposal>;

// Keeps key frames while the camera is tracked, and recognises them once it is lost.
class RelocalisationStage final : public Stage<TrackedFramePtr, ProposalPtr> {
 public:
  explicit RelocalisationStage(const relocalisation::KeyFrames& known);
  std::string name() const override { return "relocalisation"; }
  ProposalPtr process(const TrackedFramePtr& tracked) override;

  const relocalisation::KeyFrames& key_frames() const { return relocaliser_.key_frames(); }

 private:
  relocalisation::Relocaliser relocaliser_;
};

struct MapInput {
  TrackedFramePtr tracked;
  ProposalPtr proposal;  // the newest; null until there is one
};

class MappingStage final : public Stage<MapInput, MapStatePtr> {
 public:
  explicit MappingStage(const MappingConfig& config);
  // Goes on with a map, which a `camera` (of reduced images) may first be seen from its origin.
  MappingStage(const MappingConfig& config, mapping::VoxelMap map, const Camera& camera);
  std::string name() const override { return "mapping"; }
  MapStatePtr process(const MapInput& input) override;

  const MapStatePtr& state() const { return state_; }  // the last one published; null before
  const mapping::VoxelMap& map() const { return mapper_.map(); }
  bool grew() const { return mapper_.insertions() > 0; }

 private:
  mapping::Mapper mapper_;
  SurfaceCollector surface_;
  ProposalPtr proposal_;  // the last one that was drawn
  MapStatePtr state_;
};

}  // namespace armsreach::app
