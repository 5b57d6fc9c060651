// What a run does between its sensor and its picture: one graph of stages, whose parts are chosen
// by the experience.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/pipelines/hands_stage.hpp"
#include "app/pipelines/mono_stage.hpp"
#include "app/pipelines/narrator.hpp"
#include "app/pipelines/presenter.hpp"
#include "app/runtime/event_log.hpp"
#include "app/runtime/wiring.hpp"
#include "app/session/config.hpp"
#include "app/session/saved_world.hpp"
#include "devices/rig.hpp"
#include "vision/core/result.hpp"

namespace armsreach::app {

struct PipelineOptions {
  SensorInfoPtr sensor;  // of the rig, that is shown
  bool workspace = true;
  std::optional<MonoSetup> mono;    // tracks a plain camera; not together with the workspace
  std::optional<HandsSetup> hands;  // what the wearable experience needs; nothing: without it
  Pace pace = Pace::live;
  std::optional<std::int64_t> frames;
  std::string trajectory;  // files to write, or ""
  std::string stats;
  std::string map;               // file to save the map in, or ""
  std::string session;           // folder to save the map and all that belongs to it in, or ""
  Narrator* narrator = nullptr;  // says what happens
};

// What a run came to, also written as JSON with `stats`.
struct RunSummary {
  std::int64_t frames = 0;          // that were looked at
  std::int64_t tracked_frames = 0;  // with a pose that can be trusted
  double seconds = 0;               // wall time, with opening and finishing
  double rate = 0;                  // Hz, while frames came
  double latency_p50 = 0;           // s, from frame read to overlay drawn
  double latency_p95 = 0;
};

// `world` is gone on with; without a map in it the workspace makes its own.
Result<RunSummary> run_pipeline(Rig& rig, Presenter& presenter, EventLog& log, const Config& config,
                                const PipelineOptions& options, SavedWorld world);

}  // namespace armsreach::app
