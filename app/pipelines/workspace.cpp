#include "app/pipelines/workspace.hpp"

#include <chrono>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/pipelines/capture_node.hpp"
#include "app/pipelines/composer.hpp"
#include "app/pipelines/draw_node.hpp"
#include "app/pipelines/journal.hpp"
#include "app/pipelines/vision_stages.hpp"
#include "app/runtime/interrupt.hpp"
#include "app/runtime/memory.hpp"
#include "app/runtime/output_file.hpp"
#include "app/runtime/runner.hpp"
#include "vision/alignment/frame_reducer.hpp"

namespace armsreach::app {
namespace {

using RegistrationNode = StageNode<FramePtr, RegistrationStatePtr>;
using TrackingNode = StageNode<TrackInput, TrackedFramePtr>;
using RelocalisationNode = StageNode<TrackedFramePtr, ProposalPtr>;
using MappingNode = StageNode<MapInput, MapStatePtr>;
using ComposingNode = StageNode<ComposeInput, ComposedPtr>;

constexpr size_t kJournalLength = 8192;  // entries waiting to be written down
constexpr int kUserLag = 2;              // frames from a picture to the click on it, every-frame

// All stages of the experience and how they are joined:
//
//      registration
//        ^      | colour camera, where the source does not state it
//        |      v
//   capture -> tracking -> composing -> drawing
//                |  | ^        ^  ^        |
//                |  | | map    |  |  user  |
//                |  v |        |  +--------+
//                | mapping ----+
//                v  ^
//       relocalisation
class Workspace {
 public:
  Workspace(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
            const WorkspaceOptions& options, SavedWorld world);

  Result<RunSummary> run();

 private:
  void join_registration();
  void join_tracking(bool map_exists);
  void join_mapping(std::optional<mapping::VoxelMap> map);
  void join_relocalisation(const relocalisation::KeyFrames& known);
  void join_composing(const std::vector<SavedObject>& objects);
  void join_drawing();
  FaultHandler fault_handler();
  std::vector<Node*> nodes();
  std::vector<render::StageRow> stage_rows();
  std::int64_t drops(const Node& node) const;
  RunSummary summary(double seconds);
  Status write_stats(const RunSummary& summary);
  Status save_world();
  Status first_failure();

  const Config& config_;
  const WorkspaceOptions& options_;
  EventLog& log_;
  Presenter& presenter_;
  Wiring wiring_;
  Journal journal_;

  std::shared_ptr<Connection<FramePtr>> frames_ = wiring_.driving<FramePtr>();
  std::shared_ptr<Connection<TrackedFramePtr>> to_map_ = wiring_.driving<TrackedFramePtr>();
  std::shared_ptr<Connection<TrackedFramePtr>> to_relocalise_ = wiring_.driving<TrackedFramePtr>();
  std::shared_ptr<Connection<TrackedFramePtr>> to_compose_ = wiring_.driving<TrackedFramePtr>();
  std::shared_ptr<Connection<std::optional<JournalEntry>>> to_journal_;
  std::shared_ptr<Connection<ComposedPtr>> scenes_ = wiring_.driving<ComposedPtr>();
  std::shared_ptr<Connection<FramePtr>> to_register_ = wiring_.driving<FramePtr>();
  Following<RegistrationStatePtr> registration_for_tracking_{wiring_, config_.lag};
  Following<RegistrationStatePtr> registration_for_composing_{wiring_, config_.lag};
  Following<MapStatePtr> map_for_tracking_{wiring_, config_.lag};
  Following<MapStatePtr> map_for_composing_{wiring_, config_.lag};
  Following<ProposalPtr> proposal_{wiring_, config_.lag};
  FollowingEvents<UserInput> user_{wiring_, kUserLag};

  CaptureNode capture_;
  std::unique_ptr<RegistrationNode> registration_;  // null where the source states it
  std::unique_ptr<TrackingNode> tracking_;
  std::unique_ptr<RelocalisationNode> relocalisation_;
  std::unique_ptr<MappingNode> mapping_;
  std::unique_ptr<ComposingNode> composing_;
  std::unique_ptr<DrawNode> drawing_;
  // Owned by their nodes; asked after the run for what is to be saved. Null without mapping.
  RelocalisationStage* relocalisation_stage_ = nullptr;
  MappingStage* mapping_stage_ = nullptr;
  Composer* composer_ = nullptr;
};

Workspace::Workspace(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
                     const WorkspaceOptions& options, SavedWorld world)
    : config_(config),
      options_(options),
      log_(log),
      presenter_(presenter),
      wiring_{options.pace, config.threads},
      journal_(log),
      to_journal_(wiring_.queue<std::optional<JournalEntry>>(kJournalLength)),
      capture_(rig, {options.sensor->name, options.pace, options.frames}, log) {
  capture_.outlet().connect(frames_);
  capture_.at_end([this] {
    frames_->close();
    to_register_->close();
  });
  if (!options.sensor->registration_stated) join_registration();
  join_tracking(world.map.has_value());
  if (config_.mapping.enabled) {
    join_relocalisation(world.key_frames);
    join_mapping(std::move(world.map));
  }
  join_composing(world.objects);
  join_drawing();
}

void Workspace::join_registration() {
  registration_ = std::make_unique<RegistrationNode>(
      std::make_unique<RegistrationStage>(options_.sensor), [this] { return to_register_->pop(); },
      fault_handler());
  capture_.outlet().connect(to_register_);
  registration_->outlet().connect(registration_for_tracking_.connection());
  registration_->outlet().connect(registration_for_composing_.connection());
  registration_->at_end([this] {
    to_register_->close();
    registration_for_tracking_.connection()->close();
    registration_for_composing_.connection()->close();
  });
}

void Workspace::join_tracking(bool map_exists) {
  tracking_ = std::make_unique<TrackingNode>(
      std::make_unique<TrackingStage>(config_.tracking, map_exists),
      [this]() -> std::optional<TrackInput> {
        auto frame = frames_->pop();
        if (!frame) return std::nullopt;
        return TrackInput{*frame, mapping_ ? map_for_tracking_.take() : nullptr,
                          registration_ ? registration_for_tracking_.take() : nullptr};
      },
      fault_handler());
  tracking_->outlet().connect(to_journal_, entry_from_tracked);
  tracking_->outlet().connect(to_compose_);
  tracking_->at_end([this] {
    frames_->close();
    map_for_tracking_.connection()->close();
    registration_for_tracking_.connection()->close();
    to_journal_->close();
    for (const auto& out : {to_relocalise_, to_map_, to_compose_}) out->close();
  });
}

void Workspace::join_relocalisation(const relocalisation::KeyFrames& known) {
  auto stage = std::make_unique<RelocalisationStage>(known);
  relocalisation_stage_ = stage.get();
  relocalisation_ = std::make_unique<RelocalisationNode>(
      std::move(stage), [this] { return to_relocalise_->pop(); }, fault_handler());
  tracking_->outlet().connect(to_relocalise_);
  relocalisation_->outlet().connect(proposal_.connection());
  relocalisation_->at_end([this] {
    to_relocalise_->close();
    proposal_.connection()->close();
  });
}

void Workspace::join_mapping(std::optional<mapping::VoxelMap> map) {
  std::unique_ptr<MappingStage> stage;
  if (map) {
    const Camera camera = FrameReducer(options_.sensor, config_.tracking.width).camera();
    stage = std::make_unique<MappingStage>(config_.mapping, *std::move(map), camera);
    map_for_tracking_.start_with(stage->state());
    map_for_composing_.start_with(stage->state());
  } else {
    stage = std::make_unique<MappingStage>(config_.mapping);
  }
  mapping_stage_ = stage.get();
  mapping_ = std::make_unique<MappingNode>(
      std::move(stage),
      [this]() -> std::optional<MapInput> {
        auto tracked = to_map_->pop();
        if (!tracked) return std::nullopt;
        return MapInput{*tracked, proposal_.take()};
      },
      fault_handler());
  tracking_->outlet().connect(to_map_);
  mapping_->outlet().connect(map_for_tracking_.connection());
  mapping_->outlet().connect(map_for_composing_.connection());
  mapping_->at_end([this] {
    to_map_->close();
    proposal_.connection()->close();
    map_for_tracking_.connection()->close();
    map_for_composing_.connection()->close();
  });
}

void Workspace::join_composing(const std::vector<SavedObject>& objects) {
  std::vector<PlacedObject> placed;
  for (const SavedObject& object : objects) {
    placed.push_back({object.id, object.mesh, {0, object.world_from_object}, false});
  }
  auto composer = std::make_unique<Composer>(
      log_, Placement(std::move(placed)), [this] { return stage_rows(); },
      [this] { return drawing_->latency().percentile(0.5); });
  composer_ = composer.get();
  composing_ = std::make_unique<ComposingNode>(
      std::move(composer),
      [this]() -> std::optional<ComposeInput> {
        auto tracked = to_compose_->pop();
        if (!tracked) return std::nullopt;
        return ComposeInput{*tracked, mapping_ ? map_for_composing_.take() : nullptr, user_.take(),
                            registration_ ? registration_for_composing_.take() : nullptr};
      },
      fault_handler());
  composing_->outlet().connect(scenes_);
  composing_->at_end([this] {
    to_compose_->close();
    map_for_composing_.connection()->close();
    registration_for_composing_.connection()->close();
    user_.connection()->close();
    scenes_->close();
  });
}

void Workspace::join_drawing() {
  drawing_ = std::make_unique<DrawNode>(
      presenter_, journal_, log_, wiring_.pace,
      DrawNode::Connections{scenes_, to_journal_, user_.connection()}, [this] { capture_.stop(); },
      options_.narrator);
  drawing_->at_end([this] {
    scenes_->close();
    to_journal_->close();
    user_.connection()->close();
    capture_.stop();
  });
}

FaultHandler Workspace::fault_handler() {
  return [this](const std::string& stage, const std::string& what) {
    log_.write({log_.now(), FaultEvent{stage, what, "the stage goes on with the next frame"}});
  };
}

std::vector<Node*> Workspace::nodes() {
  std::vector<Node*> all = {&capture_};
  if (registration_) all.push_back(registration_.get());
  all.push_back(tracking_.get());
  if (relocalisation_) all.push_back(relocalisation_.get());
  if (mapping_) all.push_back(mapping_.get());
  all.push_back(composing_.get());
  all.push_back(drawing_.get());
  return all;
}

std::int64_t Workspace::drops(const Node& node) const {
  if (&node == tracking_.get()) return frames_->drops();
  if (&node == registration_.get()) return to_register_->drops();
  if (&node == relocalisation_.get()) return to_relocalise_->drops();
  if (&node == mapping_.get()) return to_map_->drops();
  if (&node == composing_.get()) return to_compose_->drops();
  if (&node == drawing_.get()) return scenes_->drops();
  return 0;
}

std::vector<render::StageRow> Workspace::stage_rows() {
  std::vector<render::StageRow> rows;
  for (Node* node : nodes()) {
    const LatencyHistogram& spent = node->statistics().processing;
    rows.push_back({node->name(), node->statistics().frames.load(), drops(*node),
                    spent.percentile(0.5), spent.percentile(0.95), spent.percentile(0.99)});
  }
  return rows;
}

Result<RunSummary> Workspace::run() {
  if (auto status = journal_.open(options_.trajectory); !status) return status.error();
  const auto start = std::chrono::steady_clock::now();
  {
    const InterruptGuard guard([this] { capture_.stop(); });
    config_.threads ? run_threaded(nodes()) : run_in_turns(nodes());
  }
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  const RunSummary result = summary(spent.count());
  // Every output is finished whatever became of the others; the first complaint is the answer.
  for (const Status& status :
       {first_failure(), journal_.close(), write_stats(result), save_world()}) {
    if (!status) return status.error();
  }
  return result;
}

Status Workspace::save_world() {
  if (!mapping_stage_ || (options_.map.empty() && options_.session.empty())) return ok();
  // A map that nothing was added to stays as it is; of a session the objects may have changed.
  const mapping::VoxelGrid& grid = mapping_stage_->map().grid();
  const bool unchanged =
      options_.session.empty() ? !mapping_stage_->grew() : grid.blocks.block_count() == 0;
  if (unchanged) {
    log_.write({log_.now(), FaultEvent{"mapping", "nothing was added to the map: it is not saved",
                                       "a camera with depth that is tracked maps what it sees"}});
    return ok();
  }
  if (!options_.map.empty()) return save_map(options_.map, grid);
  const WorldViewPtr view = mapping_stage_->state() ? mapping_stage_->state()->view : nullptr;
  std::vector<SavedObject> objects;
  for (const PlacedObject& object : composer_->placement().objects()) {
    objects.push_back({object.id, object.mesh, Placement::world_from_object(object, view.get())});
  }
  return save_session(options_.session, grid, relocalisation_stage_->key_frames(), objects);
}

RunSummary Workspace::summary(double seconds) {
  RunSummary result;
  result.frames = journal_.frames();
  result.tracked_frames = journal_.tracked_frames();
  result.seconds = seconds;
  result.rate = journal_.rate();
  result.latency_p50 = drawing_->latency().percentile(0.5);
  result.latency_p95 = drawing_->latency().percentile(0.95);
  return result;
}

Status Workspace::write_stats(const RunSummary& result) {
  if (options_.stats.empty()) return ok();
  nlohmann::json stages;
  for (Node* node : nodes()) {
    const StageStatistics& s = node->statistics();
    stages[node->name()] = {
        {"frames", s.frames.load()},           {"drops", drops(*node)},
        {"faults", s.faults.load()},           {"mean", s.processing.mean()},
        {"p50", s.processing.percentile(0.5)}, {"p95", s.processing.percentile(0.95)},
        {"p99", s.processing.percentile(0.99)}};
  }
  const LatencyHistogram& latency = drawing_->latency();
  const Narrator* narrator = options_.narrator;
  const nlohmann::json stats = {{"frames", result.frames},
                                {"tracked_frames", result.tracked_frames},
                                {"seconds", result.seconds},
                                {"rate", result.rate},
                                {"latency",
                                 {{"p50", latency.percentile(0.5)},
                                  {"p95", latency.percentile(0.95)},
                                  {"p99", latency.percentile(0.99)}}},
                                {"film_frames_dropped", presenter_.dropped_film_frames()},
                                {"speech",
                                 {{"said", narrator ? narrator->said() : 0},
                                  {"dropped", narrator ? narrator->dropped() : 0}}},
                                {"peak_memory_mb", peak_memory_mb()},
                                {"stages", stages}};
  return write_file(options_.stats, [&](std::ostream& out) { out << stats.dump(2) << "\n"; });
}

Status Workspace::first_failure() {
  if (capture_.failure()) return *capture_.failure();
  if (drawing_->failure()) return *drawing_->failure();
  return ok();
}

}  // namespace

Result<RunSummary> run_workspace(Rig& rig, Presenter& presenter, EventLog& log,
                                 const Config& config, const WorkspaceOptions& options,
                                 SavedWorld world) {
  return Workspace(rig, presenter, log, config, options, std::move(world)).run();
}

}  // namespace armsreach::app
