// The three kinds of context, one file each; inside render/ only.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>

#include "render/context.hpp"

namespace armsreach::render {

Result<std::unique_ptr<Context>> make_window_context(const ContextOptions& options);
Result<std::unique_ptr<Context>> make_egl_context(const ContextOptions& options);
Result<std::unique_ptr<Context>> make_osmesa_context(const ContextOptions& options);

// What contexts without a window have in common.
class HeadlessContext : public Context {
 public:
  HeadlessContext(ContextKind kind, const ContextOptions& options)
      : kind_(kind), width_(options.width), height_(options.height) {}

  ContextKind kind() const override { return kind_; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  InputState poll_input() override { return {}; }
  void wait() override {
    std::unique_lock lock(mutex_);
    woken_.wait(lock, [this] { return wake_requested_; });
    wake_requested_ = false;
  }
  void wake() override {
    {
      const std::lock_guard lock(mutex_);
      wake_requested_ = true;
    }
    woken_.notify_one();
  }
  bool should_close() const override { return false; }
  void swap() override {}

 private:
  ContextKind kind_;
  int width_;
  int height_;
  std::mutex mutex_;
  std::condition_variable woken_;
  bool wake_requested_ = false;
};

}  // namespace armsreach::render
