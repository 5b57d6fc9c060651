// The workspace experience: a depth camera tracked against the map it builds.
//
//    registration
//      ^      | colour camera, where the source does not state it
//      |      v
//   frames -> tracking -> outlet
//              |  | ^
//              |  | | map
//              |  v |
//              | mapping -> for composing
//              v  ^
//     relocalisation
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/pipelines/part.hpp"
#include "app/pipelines/vision_stages.hpp"
#include "app/session/saved_world.hpp"

namespace armsreach::app {

class WorkspacePart {
 public:
  // `world` is gone on with; without a map in it the run makes its own.
  WorkspacePart(const PartContext& context, const SensorInfoPtr& sensor, Outlet<FramePtr>& frames,
                SavedWorld world);

  Outlet<TrackedFramePtr>& outlet() { return tracking_->outlet(); }
  std::vector<PartNode> nodes();  // in the order of the data

  // What goes along with a tracked frame to whoever composes its picture; to be taken once a frame.
  MapStatePtr take_map() { return mapping_ ? map_for_composing_.take() : nullptr; }
  RegistrationStatePtr take_registration() {
    return registration_ ? registration_for_composing_.take() : nullptr;
  }
  void close_composing();  // nobody takes any more

  // After the run. Null without mapping; empty or null while nothing was mapped.
  const MappingStage* mapping() const { return mapping_stage_; }
  const relocalisation::KeyFrames& key_frames() const {
    return relocalisation_stage_->key_frames();
  }

 private:
  using RegistrationNode = StageNode<FramePtr, RegistrationStatePtr>;
  using TrackingNode = StageNode<TrackInput, TrackedFramePtr>;
  using RelocalisationNode = StageNode<TrackedFramePtr, ProposalPtr>;
  using MappingNode = StageNode<MapInput, MapStatePtr>;

  void join_registration(const SensorInfoPtr& sensor, Outlet<FramePtr>& frames);
  void join_tracking(bool map_exists);
  void join_relocalisation(const relocalisation::KeyFrames& known);
  void join_mapping(const SensorInfoPtr& sensor, std::optional<mapping::VoxelMap> map);

  const PartContext& context_;
  std::shared_ptr<Connection<FramePtr>> frames_;
  std::shared_ptr<Connection<FramePtr>> to_register_;
  std::shared_ptr<Connection<TrackedFramePtr>> to_map_;
  std::shared_ptr<Connection<TrackedFramePtr>> to_relocalise_;
  Following<RegistrationStatePtr> registration_for_tracking_;
  Following<RegistrationStatePtr> registration_for_composing_;
  Following<MapStatePtr> map_for_tracking_;
  Following<MapStatePtr> map_for_composing_;
  Following<ProposalPtr> proposal_;

  std::unique_ptr<RegistrationNode> registration_;  // null where the source states it
  std::unique_ptr<TrackingNode> tracking_;
  std::unique_ptr<RelocalisationNode> relocalisation_;  // null without mapping
  std::unique_ptr<MappingNode> mapping_;
  // Owned by their nodes.
  RelocalisationStage* relocalisation_stage_ = nullptr;
  MappingStage* mapping_stage_ = nullptr;
};

}  // namespace armsreach::app
