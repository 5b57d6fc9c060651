#include "render/context.hpp"

#include <cstdlib>

#include "render/context_kinds.hpp"

namespace armsreach::render {
namespace {

Result<std::unique_ptr<Context>> first_that_works(const ContextOptions& options, bool window) {
  std::string tried;
  if (window) {
    auto context = make_window_context(options);
    if (context) return context;
    tried = context.error().message() + "; ";
  }
  auto egl = make_egl_context(options);
  if (egl) return egl;
  auto osmesa = make_osmesa_context(options);
  if (osmesa) return osmesa;
  return Error{"no OpenGL context could be made: " + tried + egl.error().message() + "; " +
                   osmesa.error().message(),
               "display",
               "install libegl-mesa0 libgl1-mesa-dri or libosmesa6, or use --display none",
               Error::Kind::device};
}

}  // namespace

std::string_view name(ContextKind kind) {
  switch (kind) {
    case ContextKind::automatic:
      return "auto";
    case ContextKind::window:
      return "window";
    case ContextKind::egl:
      return "egl";
    case ContextKind::osmesa:
      return "osmesa";
  }
  return "";
}

bool display_exists() {
  const auto is_set = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

Result<std::unique_ptr<Context>> make_context(const ContextOptions& options) {
  switch (options.kind) {
    case ContextKind::automatic:
      return first_that_works(options, display_exists());
    case ContextKind::window:
      return make_window_context(options);
    case ContextKind::egl:
      return make_egl_context(options);
    case ContextKind::osmesa:
      return make_osmesa_context(options);
  }
  return Error{"unknown kind of context", "display", "use auto, window, egl or osmesa"};
}

Result<std::unique_ptr<Context>> make_headless_context() { return first_that_works({}, false); }

}  // namespace armsreach::render
