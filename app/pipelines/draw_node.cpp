#include "app/pipelines/draw_node.hpp"

#include <chrono>
#include <utility>

namespace armsreach::app {

DrawNode::DrawNode(Presenter& presenter, Journal& journal, EventLog& log, Connections connections,
                   std::function<void()> stop_sources)
    : Node("drawing",
           [this, &log](const std::string& stage, const std::string& what) {
             log.write({0, FaultEvent{stage, what, "see the README's list of displays"}});
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
  std::optional<ComposedPtr> next = next_scene();
  while (auto tracked = connections_.tracked->try_pop()) {
    if (*tracked) journal_.record(**tracked);
  }
  if (!next) {
    finish();
    return false;
  }
  const bool fresh = *next != nullptr && *next != shown_;
  if (*next) shown_ = *next;
  if (shown_ && !presenter_.should_close()) draw(*shown_, fresh);
  if (presenter_.should_close()) stop_sources_();
  return true;
}

// Without a person the scene is waited for; with one, the window answers whether or not there is a
// new scene. Nothing at the end.
std::optional<ComposedPtr> DrawNode::next_scene() {
  if (!presenter_.interactive()) {
    auto next = connections_.scenes->pop();
    if (next && !*next) connections_.user->push({});  // keep step with the composer
    return next;
  }
  presenter_.wait();
  auto next = connections_.scenes->try_pop();
  if (next) return next;
  if (connections_.scenes->finished()) return std::nullopt;
  return shown_;
}

void DrawNode::draw(const Composed& composed, bool fresh) {
  if (fresh) {
    for (const Event& event : composed.events) log_.write(event);
  }
  guarded([&] {
    Result<UserInput> user = presenter_.present(*composed.scene);
    if (!user) {
      fail(user.error());
      user = UserInput{};
    }
    if (fresh || !user->clicks.empty() || user->delete_selected) {
      connections_.user->push(std::move(*user));
    }
  });
  if (!fresh) return;
  const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
  latency_.record(1e-9 * static_cast<double>(now - composed.arrival));
}

void DrawNode::finish() {
  if (auto status = presenter_.close(); !status) fail(status.error());
}

void DrawNode::fail(const Error& error) {
  if (failure_) return;
  failure_ = error;
  log_.write({0, FaultEvent{"drawing", error.where + ": " + error.what, error.remedy}});
  stop_sources_();
}

}  // namespace armsreach::app
