// The only place where results of vision become things in the scene.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/interaction/placement.hpp"
#include "app/pipelines/map_state.hpp"
#include "app/runtime/event_log.hpp"
#include "app/runtime/stage.hpp"
#include "render/scene.hpp"
#include "vision/core/tracked_frame.hpp"

namespace armsreach::app {

// What a person did on the pictures since the last frame.
struct UserInput {
  std::vector<Click> clicks;
  bool delete_selected = false;
  std::vector<FaultEvent> faults;  // what could not be done

  bool asks() const { return !clicks.empty() || delete_selected || !faults.empty(); }
};

struct ComposeInput {
  TrackedFramePtr tracked;
  MapStatePtr map;  // null until something is mapped
  std::vector<UserInput> user;
};

struct Composed {
  render::ScenePtr scene;
  Events events;
  std::int64_t arrival = 0;  // of the frame, steady-clock ns
};
using ComposedPtr = std::shared_ptr<const Composed>;

class Composer final : public Stage<ComposeInput, ComposedPtr> {
 public:
  using StageRows = std::function<std::vector<render::StageRow>()>;
  using Latency = std::function<double()>;  // s, of the overlay that was drawn last
  Composer(const EventLog& log, StageRows stage_rows, Latency latency);

  std::string name() const override { return "composing"; }
  ComposedPtr process(const ComposeInput& input) override;

 private:
  void add_video(const TrackedFrame& tracked, render::Scene* scene);
  void add_tracking(const TrackedFrame& tracked, render::Scene* scene);
  void add_objects(const WorldView* world, render::Scene* scene);
  void add_messages(Timestamp now, render::Scene* scene);
  Events apply(const std::vector<UserInput>& user, const WorldView* world,
               const TrackedFrame& tracked);
  void measure_rate(std::int64_t arrival);

  const EventLog& log_;
  StageRows stage_rows_;
  Latency latency_;
  Placement placement_;
  std::vector<Eigen::Vector3f> camera_trail_;
  std::int64_t last_arrival_ = 0;
  double frame_rate_ = 0;
};

}  // namespace armsreach::app
