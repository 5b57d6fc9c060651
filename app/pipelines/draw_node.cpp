#include "app/pipelines/draw_node.hpp"

#include <chrono>
#include <utility>

namespace armsreach::app {

DrawNode::DrawNode(Presenter& presenter, Journal& journal, EventLog& log, Pace pace,
                   Connections connections, std::function<void()> stop_sources, Narrator* narrator)
    : Node("drawing",
           [&log](const std::string& stage, const std::string& what) {
             log.write({log.now(), FaultEvent{stage, what, "see 'Displays' in the README"}});
           }),
      presenter_(presenter),
      journal_(journal),
      log_(log),
      pace_(pace),
      connections_(std::move(connections)),
      stop_sources_(std::move(stop_sources)),
      narrator_(narrator) {
  if (presenter_.interactive()) {
    connections_.scenes->set_listener([this] { presenter_.wake(); });
  }
}

bool DrawNode::turn() {
  const Next next = next_scene();
  write_journal(next);
  if (progress_.due()) progress_.show(journal_.progress());
  if (next.ended) {
    finish();
    return false;
  }
  if (next.fresh && next.scene) shown_ = next.scene;
  if (next.fresh && next.scene) write_events(*next.scene);
  if (presenter_.should_close()) {
    stop_sources_();
  } else if (shown_) {
    draw(*shown_, next.fresh && next.scene);
  }
  // The composer gets one answer to each of its scenes, no more and no less.
  if (next.fresh) connections_.user->push(std::exchange(user_, {}));
  return true;
}

// Without a person the scene is waited for; with one, the window answers whether or not there is a
// new scene.
DrawNode::Next DrawNode::next_scene() {
  if (!presenter_.interactive()) {
    auto scene = connections_.scenes->pop();
    return scene ? Next{*scene, true, false} : Next{nullptr, false, true};
  }
  // Looked for before waiting: one waking may stand for several scenes.
  for (const bool wait : {false, true}) {
    if (wait) presenter_.wait();
    if (auto scene = connections_.scenes->try_pop()) return {*scene, true, false};
    if (connections_.scenes->finished()) return {nullptr, false, true};
  }
  return {nullptr, false, false};
}

// Live, whatever is there, since scenes are skipped; else the entry of the scene's own frame, so
// that events are written in the same order whichever thread was faster.
void DrawNode::write_journal(const Next& next) {
  const bool all = pace_ == Pace::live || next.ended;
  if (!all && !next.fresh) return;
  do {
    const auto entry = all ? connections_.journal->try_pop() : connections_.journal->pop();
    if (!entry) return;
    if (*entry) journal_.record(**entry);
  } while (all);
}

// Scenes may have been skipped, their events are not.
void DrawNode::write_events(const Composed& composed) {
  std::int64_t number = composed.events_before;
  for (const Event& event : composed.events) {
    if (number++ < events_written_) continue;
    log_.write(event);
    events_written_ = number;
  }
  if (narrator_) narrator_->turn(timestamp_from_seconds(composed.scene->time));
}

void DrawNode::draw(const Composed& composed, bool fresh) {
  guarded([&] {
    Result<UserInput> presented = presenter_.present(*composed.scene);
    if (presented) {
      user_.add(*std::move(presented));
    } else {
      fail(presented.error());
    }
  });
  if (fresh) {
    const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
    latency_.record(1e-9 * static_cast<double>(now - composed.arrival));
  }
}

void DrawNode::finish() {
  if (auto status = presenter_.close(); !status) fail(status.error());
}

void DrawNode::fail(const Error& error) {
  if (failure_) return;
  failure_ = error;
  log_.write({log_.now(), FaultEvent{"drawing", error.where + ": " + error.what, error.remedy}});
  stop_sources_();
}

}  // namespace armsreach::app
