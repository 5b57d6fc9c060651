// The only place where results of vision become things in the scene.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/interaction/hand_interaction.hpp"
#include "app/interaction/placement.hpp"
#include "app/pipelines/hands_stage.hpp"
#include "app/pipelines/map_state.hpp"
#include "app/pipelines/registration_stage.hpp"
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

  void add(const UserInput& more);
};

struct ComposeInput {
  TrackedFramePtr tracked;
  MapStatePtr map;  // null until something is mapped
  std::vector<UserInput> user;
  RegistrationStatePtr registration = nullptr;  // null until something is known of it
  HandsStatePtr hands = nullptr;                // of this frame; null where nobody looks for hands
  std::vector<HandNews> news = {};              // since the last frame
};

struct Composed {
  render::ScenePtr scene;
  // The newest events, also those of earlier scenes, in case one was skipped: the first is number
  // `events_before` of the run.
  Events events;
  std::int64_t events_before = 0;
  std::int64_t arrival = 0;  // of the frame, steady-clock ns
};
using ComposedPtr = std::shared_ptr<const Composed>;

class Composer final : public Stage<ComposeInput, ComposedPtr> {
 public:
  using StageRows = std::function<std::vector<render::StageRow>()>;
  using Latency = std::function<double()>;  // s, of the overlay that was drawn last
  Composer(const EventLog& log, Placement placement, HandInteraction hands, StageRows stage_rows,
           Latency latency);

  std::string name() const override { return "composing"; }
  ComposedPtr process(const ComposeInput& input) override;

  const Placement& placement() const { return placement_; }  // after the run

 private:
  void add_video(const TrackedFrame& tracked, render::Scene* scene);
  void add_tracking(const TrackedFrame& tracked, render::Scene* scene);
  void add_objects(const WorldView* world, render::Scene* scene);
  void add_messages(Timestamp now, render::Scene* scene);
  void apply(const HandNews& news, const WorldView* world, const TrackedFrame& tracked,
             const render::Scene& scene);
  void apply(const UserInput& user, const WorldView* world, const TrackedFrame& tracked,
             const render::Scene& scene);
  void tell(Event event);
  void measure_rate(std::int64_t arrival);

  const EventLog& log_;
  StageRows stage_rows_;
  Latency latency_;
  RegistrationStatePtr registration_;  // the last one told
  Placement placement_;
  HandInteraction hands_;
  UserInput pending_;           // done on frames whose tracking failed
  std::vector<HandNews> news_;  // the same
  Events events_;               // the newest
  std::int64_t events_told_ = 0;
  std::vector<Eigen::Vector3f> camera_trail_;
  std::int64_t last_arrival_ = 0;
  double frame_rate_ = 0;
};

}  // namespace armsreach::app
