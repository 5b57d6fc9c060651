// The end of the line, on the main thread: draws what was composed, writes the journal and the
// events, has them told, and sends what the person did back to the composer.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/pipelines/composer.hpp"
#include "app/pipelines/journal.hpp"
#include "app/pipelines/narrator.hpp"
#include "app/pipelines/presenter.hpp"
#include "app/runtime/event_log.hpp"
#include "app/runtime/progress.hpp"
#include "app/runtime/stage.hpp"
#include "app/runtime/wiring.hpp"

namespace armsreach::app {

class DrawNode final : public Node {
 public:
  struct Connections {
    std::shared_ptr<Connection<ComposedPtr>> scenes;
    std::shared_ptr<Connection<std::optional<JournalEntry>>> journal;  // every event
    std::shared_ptr<Connection<UserInput>> user;
  };

  DrawNode(Presenter& presenter, Journal& journal, EventLog& log, Pace pace,
           Connections connections, std::function<void()> stop_sources,
           Narrator* narrator = nullptr);  // who says what happens, or nobody

  bool turn() override;

  const LatencyHistogram& latency() const { return latency_; }  // frame read to overlay drawn
  // The first picture, film or file that could not be written.
  const std::optional<Error>& failure() const { return failure_; }

 private:
  struct Next {
    ComposedPtr scene;  // null: nothing new, or composing failed
    bool fresh = false;
    bool ended = false;
  };
  Next next_scene();
  void write_journal(const Next& next);
  void write_events(const Composed& composed);
  void draw(const Composed& composed, bool fresh);
  void finish();
  void fail(const Error& error);

  Presenter& presenter_;
  Progress progress_;
  Journal& journal_;
  EventLog& log_;
  Pace pace_;
  Connections connections_;
  std::function<void()> stop_sources_;
  Narrator* narrator_;
  ComposedPtr shown_;
  UserInput user_;  // what was done since the last answer to the composer
  std::int64_t events_written_ = 0;
  LatencyHistogram latency_;
  std::optional<Error> failure_;
};

}  // namespace armsreach::app
