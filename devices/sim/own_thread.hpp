// A thread that runs what it is given, one thing at a time. A graphics context belongs to one
// thread from making to destruction, while a source is used and destroyed from any.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

namespace armsreach::sim {

class OwnThread {
 public:
  OwnThread() : thread_([this] { work(); }) {}
  ~OwnThread() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_one();
    thread_.join();
  }
  OwnThread(const OwnThread&) = delete;
  OwnThread& operator=(const OwnThread&) = delete;

  // Returns when it is done; what it throws is thrown here. From one thread at a time.
  void run(const std::function<void()>& what) {
    std::packaged_task<void()> task(what);
    std::future<void> done = task.get_future();
    {
      const std::lock_guard lock(mutex_);
      task_ = &task;
    }
    wake_.notify_one();
    done.get();
  }

 private:
  void work() {
    while (true) {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return task_ || ending_; });
      if (!task_) return;
      std::packaged_task<void()> task = std::move(*std::exchange(task_, nullptr));
      lock.unlock();
      task();
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_;
  std::packaged_task<void()>* task_ = nullptr;
  bool ending_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace armsreach::sim
