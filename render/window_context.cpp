// A window through GLFW, and what the person does with mouse and keyboard in it.
#include <algorithm>
#include <array>
#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "render/context_kinds.hpp"

namespace armsreach::render {
namespace {

Error window_error(const std::string& what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return {what + (reason ? std::string(": ") + reason : ""), "window",
          "check DISPLAY and the OpenGL driver (libgl1-mesa-dri), or use --display egl",
          Error::Kind::device};
}

std::string utf8_from_codepoint(unsigned int c) {
  std::string text;
  const auto push = [&text](unsigned int byte) { text.push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    push(c);
  } else if (c < 0x800) {
    push(0xC0 | c >> 6);
    push(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    push(0xE0 | c >> 12);
    push(0x80 | (c >> 6 & 0x3F));
    push(0x80 | (c & 0x3F));
  } else {
    push(0xF0 | c >> 18);
    push(0x80 | (c >> 12 & 0x3F));
    push(0x80 | (c >> 6 & 0x3F));
    push(0x80 | (c & 0x3F));
  }
  return text;
}

std::optional<KeyPress> key_press(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
    return KeyPress{Key::letter, static_cast<char>('a' + (key - GLFW_KEY_A))};
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return KeyPress{Key::escape};
    case GLFW_KEY_SPACE:
      return KeyPress{Key::space};
    case GLFW_KEY_TAB:
      return KeyPress{Key::tab};
    case GLFW_KEY_ENTER:
      return KeyPress{Key::enter};
    case GLFW_KEY_DELETE:
    case GLFW_KEY_BACKSPACE:
      return KeyPress{Key::del};
    case GLFW_KEY_LEFT:
      return KeyPress{Key::left};
    case GLFW_KEY_RIGHT:
      return KeyPress{Key::right};
    case GLFW_KEY_UP:
      return KeyPress{Key::up};
    case GLFW_KEY_DOWN:
      return KeyPress{Key::down};
    case GLFW_KEY_F1:
      return KeyPress{Key::f1};
    case GLFW_KEY_F11:
      return KeyPress{Key::f11};
    default:
      return std::nullopt;
  }
}

class WindowContext final : public Context {
 public:
  ~WindowContext() override {
    if (window_) glfwDestroyWindow(window_);
    if (initialised_) glfwTerminate();
  }

  Status open(const ContextOptions& options) {
    if (!display_exists())
      return Error{"there is no display: DISPLAY and WAYLAND_DISPLAY are not set", "window",
                   "start it on a desktop, under xvfb-run, or use --display egl",
                   Error::Kind::device};
    if (!glfwInit()) return window_error("GLFW cannot be initialised");
    initialised_ = true;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    window_ =
        glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (!window_) return window_error("no window with OpenGL 3.3 core");
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    listen();
    auto gl = Gl::load([](const char* function) { return glfwGetProcAddress(function); });
    if (!gl) return gl.error();
    gl_ = *gl;
    return ok();
  }

  ContextKind kind() const override { return ContextKind::window; }
  void make_current() override { glfwMakeContextCurrent(window_); }
  int width() const override { return framebuffer_size()[0]; }
  int height() const override { return framebuffer_size()[1]; }

  InputState poll_input() override {
    glfwPollEvents();
    InputState input = std::move(pending_);
    pending_ = {};
    // GLFW's cursor is in window units, which are not pixels on scaled displays.
    std::array<int, 2> window{1, 1};
    glfwGetWindowSize(window_, &window[0], &window[1]);
    const auto pixels = framebuffer_size();
    double x = 0;
    double y = 0;
    glfwGetCursorPos(window_, &x, &y);
    input.mouse = {static_cast<float>(x * pixels[0] / std::max(window[0], 1)),
                   static_cast<float>(y * pixels[1] / std::max(window[1], 1))};
    constexpr std::array buttons{GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT,
                                 GLFW_MOUSE_BUTTON_MIDDLE};
    for (std::size_t i = 0; i < buttons.size(); ++i) {
      // A press and release within one frame still counts as down once.
      input.down[i] = input.clicked[i] || glfwGetMouseButton(window_, buttons[i]) == GLFW_PRESS;
    }
    return input;
  }

  void wait() override { glfwWaitEvents(); }
  void wake() override { glfwPostEmptyEvent(); }
  bool should_close() const override { return glfwWindowShouldClose(window_); }
  void swap() override { glfwSwapBuffers(window_); }

 private:
  static WindowContext& of(GLFWwindow* window) {
    return *static_cast<WindowContext*>(glfwGetWindowUserPointer(window));
  }

  std::array<int, 2> framebuffer_size() const {
    std::array<int, 2> size{};
    glfwGetFramebufferSize(window_, &size[0], &size[1]);
    return size;
  }

  void listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
      constexpr std::array order{GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT,
                                 GLFW_MOUSE_BUTTON_MIDDLE};
      const auto* found = std::find(order.begin(), order.end(), button);
      if (action == GLFW_PRESS && found != order.end())
        of(window).pending_.clicked[static_cast<std::size_t>(found - order.begin())] = true;
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double notches) {
      of(window).pending_.wheel += static_cast<float>(notches);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
      if (action == GLFW_RELEASE) return;
      if (key == GLFW_KEY_F11 && action == GLFW_PRESS) of(window).toggle_full_screen();
      if (const auto press = key_press(key)) of(window).pending_.keys.push_back(*press);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int codepoint) {
      of(window).pending_.text += utf8_from_codepoint(codepoint);
    });
  }

  void toggle_full_screen() {
    if (glfwGetWindowMonitor(window_)) {
      glfwSetWindowMonitor(window_, nullptr, place_[0], place_[1], place_[2], place_[3], 0);
      return;
    }
    glfwGetWindowPos(window_, &place_[0], &place_[1]);
    glfwGetWindowSize(window_, &place_[2], &place_[3]);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (mode)
      glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }

  GLFWwindow* window_ = nullptr;
  std::array<int, 4> place_{};  // position and size to return to from the full screen
  bool initialised_ = false;
  InputState pending_;
};

}  // namespace

Result<std::unique_ptr<Context>> make_window_context(const ContextOptions& options) {
  auto context = std::make_unique<WindowContext>();
  if (const Status opened = context->open(options); !opened) return opened.error();
  return std::unique_ptr<Context>(std::move(context));
}

}  // namespace armsreach::render
