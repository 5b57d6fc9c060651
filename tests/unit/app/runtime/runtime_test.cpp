// Connections, stages and runners: lock-step equals threaded bit for bit, a slow stage delays no
// other when live, a throwing stage takes nothing down, and shutdown is ordered.
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "app/runtime/runner.hpp"
#include "app/runtime/stage.hpp"
#include "app/runtime/wiring.hpp"

namespace armsreach::app {
namespace {

using Value = std::shared_ptr<const double>;

class FunctionStage final : public Stage<std::pair<Value, Value>, Value> {
 public:
  using Function = std::function<double(double, double)>;
  FunctionStage(std::string name, Function function)
      : name_(std::move(name)), function_(std::move(function)) {}
  std::string name() const override { return name_; }
  Value process(const std::pair<Value, Value>& in) override {
    return std::make_shared<const double>(
        function_(in.first ? *in.first : -1, in.second ? *in.second : 0));
  }

 private:
  std::string name_;
  Function function_;
};
using FunctionNode = StageNode<std::pair<Value, Value>, Value>;

// The shape of the real thing: a tracker that follows its map three frames late, and an end.
struct Loop {
  explicit Loop(const Wiring& wiring, int count, FunctionStage::Function track,
                FunctionStage::Function map)
      : feedback(wiring, 3) {
    const FaultHandler fault = [this](const std::string&, const std::string&) { ++faults; };
    auto to_track = wiring.driving<Value>();
    auto to_map = wiring.driving<Value>();
    auto to_end = wiring.driving<Value>();
    source = std::make_unique<FunctionNode>(
        std::make_unique<FunctionStage>("source", [this](double, double) { return next++; }),
        [this, count]() -> std::optional<std::pair<Value, Value>> {
          if (next >= count || stop) return std::nullopt;
          if (period.count() > 0) std::this_thread::sleep_for(period);
          return std::pair<Value, Value>();
        },
        fault);
    source->outlet().connect(to_track);
    tracking = std::make_unique<FunctionNode>(
        std::make_unique<FunctionStage>("tracking", std::move(track)),
        [this, to_track]() -> std::optional<std::pair<Value, Value>> {
          auto value = to_track->pop();
          if (!value) return std::nullopt;
          return std::pair(*value, feedback.take());
        },
        fault);
    tracking->outlet().connect(to_map);
    tracking->outlet().connect(to_end);
    mapping = std::make_unique<FunctionNode>(
        std::make_unique<FunctionStage>("mapping", std::move(map)),
        [to_map]() -> std::optional<std::pair<Value, Value>> {
          auto value = to_map->pop();
          if (!value) return std::nullopt;
          return std::pair(*value, Value());
        },
        fault);
    mapping->outlet().connect(feedback.connection());
    end = std::make_unique<FunctionNode>(
        std::make_unique<FunctionStage>("end",
                                        [this](double value, double) {
                                          results.push_back(value);
                                          return value;
                                        }),
        [to_end]() -> std::optional<std::pair<Value, Value>> {
          auto value = to_end->pop();
          if (!value) return std::nullopt;
          return std::pair(*value, Value());
        },
        fault);
  }

  std::vector<Node*> nodes() { return {source.get(), tracking.get(), mapping.get(), end.get()}; }

  double next = 0;
  std::atomic<bool> stop{false};
  std::chrono::milliseconds period{0};
  std::atomic<int> faults{0};
  Following<Value> feedback;
  std::vector<double> results;
  std::unique_ptr<FunctionNode> source, tracking, mapping, end;
};

double chaotic(double frame, double map) { return 3.7 * (map + 0.1) * (0.9 - map) + 1e-3 * frame; }
double halved(double tracked, double) { return tracked / 2; }

TEST(Runtime, LockStepEqualsThreadedBitForBit) {
  Loop turns({Pace::every_frame, false}, 500, chaotic, halved);
  run_in_turns(turns.nodes());
  ASSERT_EQ(turns.results.size(), 500U);
  for (int repeat = 0; repeat < 5; ++repeat) {
    Loop threaded({Pace::every_frame, true}, 500, chaotic, halved);
    run_threaded(threaded.nodes());
    EXPECT_EQ(threaded.results, turns.results);
  }
}

TEST(Runtime, LiveASlowStageDelaysNoOther) {
  // Mapping takes a second; 30 frames at 100 Hz must still come through tracking and out at once.
  Loop live({Pace::live, true}, 30, chaotic, [](double value, double) {
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return value;
  });
  live.period = std::chrono::milliseconds(10);
  std::vector<Node*> nodes = live.nodes();
  run_threaded(nodes);
  EXPECT_GT(live.end->statistics().frames.load(), 20);
  EXPECT_LE(live.mapping->statistics().frames.load(), 3);
  EXPECT_LT(live.tracking->statistics().processing.percentile(0.95), 0.2);
  EXPECT_LT(live.end->statistics().processing.percentile(0.95), 0.2);
}

TEST(Runtime, AnExceptionIsAFaultAndNothingStops) {
  for (const bool threads : {false, true}) {
    Loop loop({Pace::every_frame, threads}, 50, chaotic, [](double value, double) -> double {
      if (value > 0.2) throw std::runtime_error("no");
      return value;
    });
    threads ? run_threaded(loop.nodes()) : run_in_turns(loop.nodes());
    EXPECT_EQ(loop.results.size(), 50U);
    EXPECT_GT(loop.mapping->statistics().faults.load(), 1);
    EXPECT_EQ(loop.faults.load(), 1) << "a fault that repeats is told once";
  }
}

TEST(Runtime, StartsAndStopsAHundredTimes) {
  for (int i = 0; i < 100; ++i) {
    Loop loop({i % 2 ? Pace::live : Pace::every_frame, true}, 1 << 30, chaotic, halved);
    std::jthread stopper([&loop, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * (i % 7)));
      loop.stop = true;
    });
    run_threaded(loop.nodes());
  }
}

TEST(RuntimeConnection, LatestValueSkipsAndCounts) {
  LatestValue<int> latest;
  latest.push(1);
  latest.push(2);
  EXPECT_EQ(latest.drops(), 1);
  EXPECT_EQ(latest.pop(), 2);
  EXPECT_EQ(latest.try_pop(), std::nullopt);
  latest.push(3);
  latest.close();
  EXPECT_FALSE(latest.push(4));
  EXPECT_FALSE(latest.finished());
  EXPECT_EQ(latest.pop(), 3);  // what was in flight at closing is still delivered
  EXPECT_EQ(latest.pop(), std::nullopt);
  EXPECT_TRUE(latest.finished());
}

TEST(RuntimeConnection, EventQueueKeepsOrderAndPressesBack) {
  EventQueue<int> queue(2);
  queue.push(1);
  queue.push(2);
  std::atomic<bool> third{false};
  std::jthread producer([&] {
    queue.push(3);
    third = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(third);
  EXPECT_EQ(queue.pop(), 1);
  producer.join();
  EXPECT_EQ(queue.pop(), 2);
  EXPECT_EQ(queue.pop(), 3);
}

TEST(RuntimeConnection, ClosingFreesThoseWhoWait) {
  EventQueue<int> empty(1);
  EventQueue<int> full(1);
  full.push(1);
  std::jthread popper([&] { EXPECT_EQ(empty.pop(), std::nullopt); });
  std::jthread pusher([&] { EXPECT_FALSE(full.push(2)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  empty.close();
  full.close();
}

TEST(RuntimeConnection, WaitingInOneLoopIsALogicError) {
  EventQueue<int> queue(1, EventQueue<int>::Waiting::forbidden);
  EXPECT_THROW(queue.pop(), std::logic_error);
  queue.push(1);
  EXPECT_THROW(queue.push(2), std::logic_error);
}

TEST(RuntimeStatistics, PercentilesAreGoodToABin) {
  LatencyHistogram histogram;
  for (int i = 1; i <= 1000; ++i) histogram.record(i * 1e-4);
  EXPECT_EQ(histogram.count(), 1000);
  EXPECT_NEAR(histogram.percentile(0.5), 0.05, 0.001);
  EXPECT_NEAR(histogram.percentile(0.95), 0.095, 0.002);
  EXPECT_NEAR(histogram.mean(), 0.05005, 1e-4);
  EXPECT_EQ(LatencyHistogram().percentile(0.5), 0);
}

}  // namespace
}  // namespace armsreach::app
