#include "app/pipelines/draw_node.hpp"

#include <chrono>
#include <utility>

namespace armsreach::app {

DrawNode::DrawNode(Presenter& presenter, Journal& journal, EventLog& log, Connections connections,
                   std::function<void()> stop_sources)
    : Node("drawing",
           [this, &log](const std::string& stage, const std::string& what) {
             log.write({log.now(), FaultEvent{stage, what, "see 'Displays' in the README"}});
             fail({what, stage, "", Error::Kind::device});
           }),
      presenter_(presenter),
      journal_(journal),
      log_(log),
      connections_(std::move(connections)),
      stop_sources_(std::move(stop_sources)) {
  if (presenter_.interactive()) {
    connections_.scenes->set_listener([this] { presenter_.wake(); });
  }
}

bool DrawNode::turn() {
  const Next next = next_scene();
  while (auto tracked = connections_.tracked->try_pop()) {
    if (*tracked) journal_.record(**tracked);
  }
  if (next.ended) {
    finish();
    return false;
  }
  if (next.fresh && next.scene) shown_ = next.scene;
  UserInput user;
  if (presenter_.should_close()) {
    stop_sources_();
  } else if (shown_) {
    user = draw(*shown_, next.fresh && next.scene);
  }
  // The composer waits for one answer to each of its scenes.
  if (next.fresh || user.asks()) connections_.user->push(std::move(user));
  return true;
}

// Without a person the scene is waited for; with one, the window answers whether or not there is a
// new scene.
DrawNode::Next DrawNode::next_scene() {
  if (!presenter_.interactive()) {
    auto scene = connections_.scenes->pop();
    return scene ? Next{*scene, true, false} : Next{nullptr, false, true};
  }
  presenter_.wait();
  if (auto scene = connections_.scenes->try_pop()) return {*scene, true, false};
  return {nullptr, false, connections_.scenes->finished()};
}

UserInput DrawNode::draw(const Composed& composed, bool fresh) {
  if (fresh) {
    for (const Event& event : composed.events) log_.write(event);
  }
  UserInput user;
  guarded([&] {
    Result<UserInput> presented = presenter_.present(*composed.scene);
    if (presented) {
      user = *std::move(presented);
    } else {
      fail(presented.error());
    }
  });
  if (fresh) {
    const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
    latency_.record(1e-9 * static_cast<double>(now - composed.arrival));
  }
  return user;
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
