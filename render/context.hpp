// A place to draw: a window, EGL without a surface, or OSMesa. All give OpenGL 3.3 core or later
// and behave alike. A context is current on the thread that made it and stays there; any number of
// headless contexts may live on different threads at once, a window only on the main thread.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "render/gl.hpp"
#include "render/input.hpp"
#include "vision/core/result.hpp"

namespace armsreach::render {

enum class ContextKind { automatic, window, egl, osmesa };
std::string_view name(ContextKind kind);

struct ContextOptions {
  ContextKind kind = ContextKind::automatic;  // window if a display exists, else EGL, else OSMesa
  int width = 1280;                           // px, of a window
  int height = 720;
  std::string title = "Armsreach";
};

class Context {
 public:
  virtual ~Context() = default;
  virtual ContextKind kind() const = 0;
  // The functions of this context; call them only while it is current.
  const Gl& gl() const { return gl_; }
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
  // Shows what was drawn into framebuffer 0; nothing where there is no window.
  virtual void swap() = 0;

 protected:
  Gl gl_;
};

// Errors say what was tried and which package or variable mends it.
Result<std::unique_ptr<Context>> make_context(const ContextOptions& options);

// A headless context: EGL surfaceless, else OSMesa; for sensors that are simulated by drawing.
Result<std::unique_ptr<Context>> make_headless_context();

// True when a window could be opened: DISPLAY or WAYLAND_DISPLAY names a display.
bool display_exists();

}  // namespace armsreach::render
