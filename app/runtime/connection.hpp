// The two kinds of connection between stages, and no third: the latest value (live: what nobody
// took in time is dropped and counted) and every event (bounded, in order, nothing lost).
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace armsreach::app {

template <class T>
class Connection {
 public:
  virtual ~Connection() = default;

  // False, and the value is gone, when the connection was closed before it could be taken in.
  virtual bool push(T value) = 0;
  // Waits for a value; nothing once the connection is closed and empty.
  virtual std::optional<T> pop() = 0;
  virtual std::optional<T> try_pop() = 0;
  virtual void close() = 0;
  virtual bool finished() const = 0;  // closed and empty
  virtual std::int64_t drops() const { return 0; }

  // Called after every push and after closing, on the thread that did it. Set before use.
  void set_listener(std::function<void()> listener) { listener_ = std::move(listener); }

 protected:
  void tell_listener() const {
    if (listener_) listener_();
  }

 private:
  std::function<void()> listener_;
};

template <class T>
class LatestValue final : public Connection<T> {
 public:
  bool push(T value) override {
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return false;
      if (value_) ++drops_;
      value_ = std::move(value);
    }
    changed_.notify_one();
    this->tell_listener();
    return true;
  }

  std::optional<T> pop() override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return value_ || closed_; });
    return std::exchange(value_, std::nullopt);
  }

  std::optional<T> try_pop() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

  void close() override {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    changed_.notify_all();
    this->tell_listener();
  }

  bool finished() const override {
    const std::lock_guard lock(mutex_);
    return closed_ && !value_;
  }

  std::int64_t drops() const override {
    const std::lock_guard lock(mutex_);
    return drops_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<T> value_;
  std::int64_t drops_ = 0;
  bool closed_ = false;
};

template <class T>
class EventQueue final : public Connection<T> {
 public:
  enum class Waiting {
    allowed,
    forbidden,  // one thread turns all stages: waiting could never end, so it is a logic error
  };

  explicit EventQueue(std::size_t capacity, Waiting waiting = Waiting::allowed)
      : capacity_(capacity), waiting_(waiting) {}

  bool push(T value) override {
    {
      std::unique_lock lock(mutex_);
      wait(not_full_, lock, [this] { return values_.size() < capacity_ || closed_; });
      if (closed_) return false;
      values_.push_back(std::move(value));
    }
    not_empty_.notify_one();
    this->tell_listener();
    return true;
  }

  std::optional<T> pop() override {
    std::unique_lock lock(mutex_);
    wait(not_empty_, lock, [this] { return !values_.empty() || closed_; });
    return take(lock);
  }

  std::optional<T> try_pop() override {
    std::unique_lock lock(mutex_);
    return take(lock);
  }

  void close() override {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    not_empty_.notify_all();
    not_full_.notify_all();
    this->tell_listener();
  }

  bool finished() const override {
    const std::lock_guard lock(mutex_);
    return closed_ && values_.empty();
  }

 private:
  template <class Condition>
  void wait(std::condition_variable& variable, std::unique_lock<std::mutex>& lock,
            Condition condition) {
    if (waiting_ == Waiting::allowed) {
      variable.wait(lock, condition);
    } else if (!condition()) {
      throw std::logic_error("a stage's turn came before its input or after its output was full");
    }
  }

  std::optional<T> take(std::unique_lock<std::mutex>& lock) {
    if (values_.empty()) return std::nullopt;
    std::optional<T> value = std::move(values_.front());
    values_.pop_front();
    lock.unlock();
    not_full_.notify_one();
    return value;
  }

  const std::size_t capacity_;
  const Waiting waiting_;
  mutable std::mutex mutex_;
  std::condition_variable not_empty_;
  std::condition_variable not_full_;
  std::deque<T> values_;
  bool closed_ = false;
};

}  // namespace armsreach::app
