// A place to draw: a window, EGL without a surface, or OSMesa. All give OpenGL 3.3 core or later
// and behave alike; a context is made current on the thread that makes it and stays there.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "render/input.hpp"
#include "vision/core/result.hpp"

namespace armsreach::render {

enum class ContextKind { automatic, window, egl, osmesa };

struct ContextOptions {
  ContextKind kind = ContextKind::automatic;  // window if a display exists, else EGL, else OSMesa
  int width = 1280;                           // px, of a window
  int height = 720;
  std::string title = "Armsreach";
};

class Context {
 public:
  using Function = void (*)();

  virtual ~Context() = default;
  virtual ContextKind kind() const = 0;
  virtual Function load(const char* name) const = 0;  // the context's own GetProcAddress
  virtual void make_current() = 0;

  // A window's drawable size in pixels and what the person did since the last call; headless
  // contexts have the size they were made with and never any input.
  virtual int width() const = 0;
  virtual int height() const = 0;
  virtual InputState poll_input() = 0;
  // Sleeps until there is input or `wake` is called; headless contexts until `wake` is called.
  virtual void wait() = 0;
  virtual void wake() = 0;  // from any thread
  virtual bool should_close() const = 0;
  virtual void swap() = 0;
};

// Errors say what was tried and which package or variable mends it.
Result<std::unique_ptr<Context>> make_context(const ContextOptions& options);

}  // namespace armsreach::render
