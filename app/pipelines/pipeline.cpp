#include "app/pipelines/pipeline.hpp"

#include <chrono>
#include <utility>

#include <nlohmann/json.hpp>

#include "app/pipelines/capture_node.hpp"
#include "app/pipelines/composer.hpp"
#include "app/pipelines/draw_node.hpp"
#include "app/pipelines/journal.hpp"
#include "app/pipelines/mono_part.hpp"
#include "app/pipelines/wearable_part.hpp"
#include "app/pipelines/workspace_part.hpp"
#include "app/runtime/interrupt.hpp"
#include "app/runtime/memory.hpp"
#include "app/runtime/output_file.hpp"
#include "app/runtime/runner.hpp"

namespace armsreach::app {
namespace {

using ComposingNode = StageNode<ComposeInput, ComposedPtr>;

constexpr size_t kJournalLength = 8192;  // entries waiting to be written down
constexpr int kUserLag = 2;              // frames from a picture to the click on it, every-frame

// A frame of which nobody asks where it was taken.
TrackedFramePtr untracked(const FramePtr& frame) {
  auto tracked = std::make_shared<TrackedFrame>();
  tracked->frame = frame;
  tracked->state = TrackingState::untracked;
  return tracked;
}

SeenFrame without_hands(const TrackedFramePtr& tracked) { return {tracked, nullptr}; }

// All parts and how they are joined; each may be left out:
//
//   capture -> workspace -> wearable -> composing -> drawing
//      ^        or mono        |  |       ^  ^  user  |
//      |          |  map, news |  | news  |  +--------+
//      |          +------------|--+-------+
//      +-----------------------+ gimbal
class Pipeline {
 public:
  Pipeline(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
           const PipelineOptions& options, SavedWorld world);

  Result<RunSummary> run();

 private:
  void join_capture();
  void join_parts(SavedWorld world);
  template <class T, class Convert>
  void connect_tracked(const std::shared_ptr<Connection<T>>& to, Convert convert);
  void join_composing(const std::vector<SavedObject>& objects);
  void join_drawing();
  std::optional<ComposeInput> take_composing();
  FaultHandler fault_handler();
  std::vector<PartNode> nodes();
  std::vector<render::StageRow> stage_rows();
  RunSummary summary(double seconds);
  Status write_stats(const RunSummary& summary);
  Status save_world();
  Status save_sparse_world();
  std::vector<SavedObject> objects(const WorldView* view) const;
  Status first_failure();

  const PipelineOptions& options_;
  Rig& rig_;
  EventLog& log_;
  Presenter& presenter_;
  PartContext context_;
  Journal journal_;

  std::shared_ptr<Connection<SeenFrame>> to_compose_;
  std::shared_ptr<Connection<std::optional<JournalEntry>>> to_journal_;
  std::shared_ptr<Connection<ComposedPtr>> scenes_;
  FollowingEvents<UserInput> user_;

  CaptureNode capture_;
  std::unique_ptr<WorkspacePart> workspace_;  // null without it
  std::unique_ptr<MonoPart> mono_;            // null without it
  std::unique_ptr<WearablePart> wearable_;    // null without it
  std::unique_ptr<ComposingNode> composing_;
  std::unique_ptr<DrawNode> drawing_;
  Composer* composer_ = nullptr;  // owned by its node
};

Pipeline::Pipeline(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
                   const PipelineOptions& options, SavedWorld world)
    : options_(options),
      rig_(rig),
      log_(log),
      presenter_(presenter),
      context_{config, {options.pace, config.threads}, fault_handler()},
      journal_(log),
      to_compose_(context_.wiring.driving<SeenFrame>()),
      to_journal_(context_.wiring.queue<std::optional<JournalEntry>>(kJournalLength)),
      scenes_(context_.wiring.driving<ComposedPtr>()),
      user_(context_.wiring, kUserLag),
      capture_(rig, {options.sensor->name, options.pace, options.frames}, log) {
  const std::vector<SavedObject> objects = world.objects;
  join_parts(std::move(world));
  join_capture();
  join_composing(objects);
  join_drawing();
}

void Pipeline::join_parts(SavedWorld world) {
  const SensorInfo& sensor = *options_.sensor;
  const auto gimbal = rig_.gimbal_of(sensor.name);
  if (options_.workspace) {
    workspace_ = std::make_unique<WorkspacePart>(context_, options_.sensor, capture_.outlet(),
                                                 std::move(world));
    workspace_->outlet().connect(to_journal_, entry_from_tracked);
  } else if (options_.mono) {
    mono_ = std::make_unique<MonoPart>(context_, sensor, *options_.mono, capture_.outlet(), gimbal);
    mono_->outlet().connect(to_journal_, [](const MonoStageOutput& output) {
      return entry_from_tracked(output.tracked);
    });
  } else {
    capture_.outlet().connect(
        to_journal_, [](const FramePtr& frame) { return entry_from_tracked(untracked(frame)); });
  }
  if (!options_.hands) return connect_tracked(to_compose_, without_hands);
  wearable_ = std::make_unique<WearablePart>(
      context_, *options_.hands, sensor, gimbal,
      mono_ ? up_in_world(*options_.mono) : Eigen::Vector3d(Eigen::Vector3d::Zero()), log_);
  connect_tracked(wearable_->input(), [](const TrackedFramePtr& tracked) { return tracked; });
  wearable_->outlet().connect(to_compose_, [](const HandsOutput& output) { return output.seen; });
  if (mono_) mono_->look_out_for_hands(wearable_->outlet());
}

// Whatever tracks, or else the capture, to whoever comes next.
template <class T, class Convert>
void Pipeline::connect_tracked(const std::shared_ptr<Connection<T>>& to, Convert convert) {
  if (workspace_) return workspace_->outlet().connect(to, convert);
  if (mono_) {
    return mono_->outlet().connect(
        to, [convert](const MonoStageOutput& output) { return convert(output.tracked); });
  }
  capture_.outlet().connect(to,
                            [convert](const FramePtr& frame) { return convert(untracked(frame)); });
}

void Pipeline::join_capture() {
  if (wearable_) capture_.before_reading([this] { wearable_->command_gimbal(); });
  capture_.at_end([this] {
    capture_.outlet().close();
    if (wearable_) wearable_->close_capture();
  });
}

std::optional<ComposeInput> Pipeline::take_composing() {
  auto seen = to_compose_->pop();
  if (!seen) return std::nullopt;
  ComposeInput input;
  input.tracked = seen->tracked;
  input.hands = seen->hands;
  if (workspace_) input.map = workspace_->take_map();
  if (workspace_) input.registration = workspace_->take_registration();
  if (mono_) input.news = mono_->take_news();
  if (wearable_) {
    for (HandNews& news : wearable_->take_news()) input.news.push_back(std::move(news));
  }
  input.user = user_.take();
  return input;
}

void Pipeline::join_composing(const std::vector<SavedObject>& objects) {
  std::vector<PlacedObject> placed;
  placed.reserve(objects.size());
  for (const SavedObject& object : objects) {
    placed.push_back({object.id, object.mesh, {0, object.world_from_object}, false});
  }
  auto composer = std::make_unique<Composer>(
      log_, Placement(std::move(placed)), HandInteraction(context_.config.gesture.insert),
      [this] { return stage_rows(); }, [this] { return drawing_->latency().percentile(0.5); });
  composer_ = composer.get();
  composing_ = std::make_unique<ComposingNode>(
      std::move(composer), [this] { return take_composing(); }, context_.fault);
  composing_->outlet().connect(scenes_);
  if (wearable_) wearable_->look_at_objects(composing_->outlet());
  composing_->at_end([this] {
    to_compose_->close();
    if (workspace_) workspace_->close_composing();
    if (mono_) mono_->close_composing();
    composing_->outlet().close();
    if (wearable_) wearable_->close_composing();
    user_.connection()->close();
  });
}

void Pipeline::join_drawing() {
  drawing_ = std::make_unique<DrawNode>(
      presenter_, journal_, log_, context_.wiring.pace,
      DrawNode::Connections{scenes_, to_journal_, user_.connection()}, [this] { capture_.stop(); },
      options_.narrator);
  drawing_->at_end([this] {
    scenes_->close();
    to_journal_->close();
    user_.connection()->close();
    capture_.stop();
  });
}

FaultHandler Pipeline::fault_handler() {
  return [this](const std::string& stage, const std::string& what) {
    log_.write({log_.now(), FaultEvent{stage, what, "the stage goes on with the next frame"}});
  };
}

std::vector<PartNode> Pipeline::nodes() {
  std::vector<PartNode> all{{&capture_, [] { return std::int64_t{0}; }}};
  const auto add = [&all](const std::vector<PartNode>& part) {
    all.insert(all.end(), part.begin(), part.end());
  };
  if (workspace_) add(workspace_->nodes());
  if (mono_) add(mono_->nodes());
  if (wearable_) add(wearable_->nodes());
  all.push_back({composing_.get(), [this] { return to_compose_->drops(); }});
  all.push_back({drawing_.get(), [this] { return scenes_->drops(); }});
  return all;
}

std::vector<render::StageRow> Pipeline::stage_rows() {
  std::vector<render::StageRow> rows;
  for (const auto& [node, drops] : nodes()) {
    const LatencyHistogram& spent = node->statistics().processing;
    rows.push_back({node->name(), node->statistics().frames.load(), drops(), spent.percentile(0.5),
                    spent.percentile(0.95), spent.percentile(0.99)});
  }
  return rows;
}

Result<RunSummary> Pipeline::run() {
  if (auto status = journal_.open(options_.trajectory); !status) return status.error();
  const auto start = std::chrono::steady_clock::now();
  {
    const InterruptGuard guard([this] { capture_.stop(); });
    std::vector<Node*> all;
    for (const PartNode& part : nodes()) all.push_back(part.node);
    context_.config.threads ? run_threaded(all) : run_in_turns(all);
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

Status Pipeline::save_world() {
  if (options_.map.empty() && options_.session.empty()) return ok();
  if (mono_) return save_sparse_world();
  const MappingStage* mapping = workspace_ ? workspace_->mapping() : nullptr;
  if (!mapping) return ok();
  // A map that nothing was added to stays as it is; of a session the objects may have changed.
  const mapping::VoxelGrid& grid = mapping->map().grid();
  const bool unchanged =
      options_.session.empty() ? !mapping->grew() : grid.blocks.block_count() == 0;
  if (unchanged) {
    log_.write({log_.now(), FaultEvent{"mapping", "nothing was added to the map: it is not saved",
                                       "a camera with depth that is tracked maps what it sees"}});
    return ok();
  }
  if (!options_.map.empty()) return save_map(options_.map, grid);
  const WorldViewPtr view = mapping->state() ? mapping->state()->view : nullptr;
  return save_session(options_.session, grid, workspace_->key_frames(), objects(view.get()));
}

Status Pipeline::save_sparse_world() {
  const mono_slam::SparseMap map = mono_->stage().map();
  if (map.landmarks.empty()) {
    log_.write({log_.now(), FaultEvent{"mono_slam", "nothing was mapped: the session is not saved",
                                       "move the camera sideways, so that points are seen from "
                                       "several places"}});
    return ok();
  }
  return save_session(options_.session, map, objects(mono_->stage().view().get()));
}

std::vector<SavedObject> Pipeline::objects(const WorldView* view) const {
  std::vector<SavedObject> all;
  for (const PlacedObject& object : composer_->placement().objects()) {
    all.push_back({object.id, object.mesh, Placement::world_from_object(object, view)});
  }
  return all;
}

RunSummary Pipeline::summary(double seconds) {
  RunSummary result;
  result.frames = journal_.frames();
  result.tracked_frames = journal_.tracked_frames();
  result.seconds = seconds;
  result.rate = journal_.rate();
  result.latency_p50 = drawing_->latency().percentile(0.5);
  result.latency_p95 = drawing_->latency().percentile(0.95);
  return result;
}

Status Pipeline::write_stats(const RunSummary& result) {
  if (options_.stats.empty()) return ok();
  nlohmann::json stages;
  for (const auto& [node, drops] : nodes()) {
    const StageStatistics& s = node->statistics();
    stages[node->name()] = {
        {"frames", s.frames.load()},           {"drops", drops()},
        {"faults", s.faults.load()},           {"mean", s.processing.mean()},
        {"p50", s.processing.percentile(0.5)}, {"p95", s.processing.percentile(0.95)},
        {"p99", s.processing.percentile(0.99)}};
  }
  const LatencyHistogram& latency = drawing_->latency();
  const Narrator* narrator = options_.narrator;
  nlohmann::json stats = {{"frames", result.frames},
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
  if (mono_) {
    stats["mono_slam"] = mono_->stage().statistics().json();
    stats["mono_slam"]["milliseconds"] = {{"mean", 1e3 * mono_->spent().mean()},
                                          {"p95", 1e3 * mono_->spent().percentile(0.95)}};
  }
  return write_file(options_.stats, [&](std::ostream& out) { out << stats.dump(2) << "\n"; });
}

Status Pipeline::first_failure() {
  if (capture_.failure()) return *capture_.failure();
  if (drawing_->failure()) return *drawing_->failure();
  return ok();
}

}  // namespace

Result<RunSummary> run_pipeline(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
                                const PipelineOptions& options, SavedWorld world) {
  return Pipeline(rig, presenter, log, config, options, std::move(world)).run();
}

}  // namespace armsreach::app
