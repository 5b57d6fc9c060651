// A stage is a pure step with a name; a node is a stage with its connections. The same node runs on
// a thread of its own (live, or in lock-step) or takes turns with others in one loop.
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/runtime/connection.hpp"
#include "app/runtime/statistics.hpp"

namespace armsreach::app {

template <class Input, class Output>
class Stage {
 public:
  virtual ~Stage() = default;
  virtual std::string name() const = 0;
  // One output for each input. An exception becomes a fault event and a default Output.
  virtual Output process(const Input& input) = 0;
};

// Tells of an exception in a stage: (stage, what it said).
using FaultHandler = std::function<void(const std::string&, const std::string&)>;

class Node {
 public:
  Node(std::string name, FaultHandler fault) : name_(std::move(name)), fault_(std::move(fault)) {}
  virtual ~Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  // Takes one input, waiting for it, and gives one output. False at the end, with outputs closed.
  virtual bool turn() = 0;

  // What to do when the node has ended, however it did: closing its connections, so that nobody
  // waits for it.
  void at_end(std::function<void()> end) { end_ = std::move(end); }
  void end() {
    if (end_) end_();
  }
  // Tells of an exception; of one that repeats only once.
  void report(const std::string& what) {
    statistics_.faults.fetch_add(1);
    if (std::exchange(last_fault_, what) != what) fault_(name_, what);
  }

  const std::string& name() const { return name_; }
  StageStatistics& statistics() { return statistics_; }

 protected:
  // Runs the step of one frame, timed and guarded; false when it threw.
  template <class Step>
  bool guarded(Step step) {
    const auto start = std::chrono::steady_clock::now();
    const bool good = reported(step);
    count_frame(start);
    return good;
  }

  // Runs `step`; false when it threw, which is reported.
  template <class Step>
  bool reported(Step step) {
    try {
      step();
      return true;
    } catch (const std::exception& e) {
      report(e.what());
      return false;
    }
  }

  void count_frame(std::chrono::steady_clock::time_point start) {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    statistics_.processing.record(spent.count());
    statistics_.frames.fetch_add(1);
  }

 private:
  std::string name_;
  FaultHandler fault_;
  std::function<void()> end_;
  std::string last_fault_;
  StageStatistics statistics_;
};

// One output to any number of connections.
template <class T>
class Outlet {
 public:
  void connect(const std::shared_ptr<Connection<T>>& to) {
    connect(to, [](const T& value) { return value; });
  }
  // To a connection that carries what `convert` makes of the output.
  template <class U, class Convert>
  void connect(std::shared_ptr<Connection<U>> to, Convert convert) {
    ends_.push_back(
        {[to, convert](const T& value) { to->push(convert(value)); }, [to] { to->close(); }});
  }

  void push(const T& value) {
    for (const End& end : ends_) end.push(value);
  }
  void close() {
    for (const End& end : ends_) end.close();
  }

 private:
  struct End {
    std::function<void(const T&)> push;
    std::function<void()> close;
  };
  std::vector<End> ends_;
};

template <class Input, class Output>
class StageNode final : public Node {
 public:
  // `take` joins the stage's inputs: nothing at the end of the one that drives it.
  using Take = std::function<std::optional<Input>()>;

  StageNode(std::unique_ptr<Stage<Input, Output>> stage, Take take, FaultHandler fault)
      : Node(stage->name(), std::move(fault)), stage_(std::move(stage)), take_(std::move(take)) {}

  Outlet<Output>& outlet() { return outlet_; }

  bool turn() override {
    std::optional<Input> input = take_();
    if (!input) {
      outlet_.close();
      return false;
    }
    Output output{};
    guarded([&] { output = stage_->process(*input); });
    outlet_.push(output);
    return true;
  }

 private:
  std::unique_ptr<Stage<Input, Output>> stage_;
  Take take_;
  Outlet<Output> outlet_;
};

}  // namespace armsreach::app
