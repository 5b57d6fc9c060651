// How stages are joined at either pace.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "app/runtime/connection.hpp"

namespace armsreach::app {

enum class Pace {
  live,         // stale frames are skipped, counted and reported
  every_frame,  // nothing is dropped; every stage reads its inputs at a fixed lag
};

struct Wiring {
  Pace pace = Pace::live;
  bool threads = true;  // false: one loop turns every stage; only with every_frame

  // What drives a stage.
  template <class T>
  std::shared_ptr<Connection<T>> driving() const {
    if (pace == Pace::live) return std::make_shared<LatestValue<T>>();
    return queue<T>(kQueueLength);
  }

  template <class T>
  std::shared_ptr<EventQueue<T>> queue(std::size_t capacity) const {
    using Queue = EventQueue<T>;
    return std::make_shared<Queue>(capacity,
                                   threads ? Queue::Waiting::allowed : Queue::Waiting::forbidden);
  }

 private:
  static constexpr std::size_t kQueueLength = 4;
};

// An input that goes along with the one that drives a stage: live, whatever is newest; lock-step,
// exactly the value that belongs to the frame `lag` frames earlier (T{} for the first ones). A T{}
// from a stage that failed leaves the value before it.
template <class T>
class Following {
 public:
  Following(const Wiring& wiring, int lag) : live_(wiring.pace == Pace::live) {
    if (live_) {
      connection_ = std::make_shared<LatestValue<T>>();
      return;
    }
    connection_ = wiring.queue<T>(static_cast<std::size_t>(lag) + 1);
    for (int i = 0; i < lag; ++i) connection_->push(T{});
  }

  const std::shared_ptr<Connection<T>>& connection() const { return connection_; }

  // What is taken until a first value comes.
  void start_with(T value) { last_ = std::move(value); }

  const T& take() {
    auto value = live_ ? connection_->try_pop() : connection_->pop();
    if (value && *value != T{}) last_ = std::move(*value);
    return last_;
  }

 private:
  bool live_;
  std::shared_ptr<Connection<T>> connection_;
  T last_{};
};

// The same for events, of which none may be lost: live, all that came since the last take;
// lock-step, those that belong to the frame `lag` frames earlier.
template <class T>
class FollowingEvents {
 public:
  FollowingEvents(const Wiring& wiring, int lag)
      : live_(wiring.pace == Pace::live),
        connection_(wiring.queue<T>(live_ ? kLongestWait : static_cast<std::size_t>(lag) + 1)) {
    for (int i = 0; i < lag && !live_; ++i) connection_->push(T{});
  }

  std::shared_ptr<Connection<T>> connection() const { return connection_; }

  std::vector<T> take() {
    std::vector<T> events;
    if (live_) {
      while (auto event = connection_->try_pop()) events.push_back(std::move(*event));
    } else if (auto event = connection_->pop()) {
      events.push_back(std::move(*event));
    }
    return events;
  }

 private:
  static constexpr std::size_t kLongestWait = 256;
  bool live_;
  std::shared_ptr<EventQueue<T>> connection_;
};

}  // namespace armsreach::app
