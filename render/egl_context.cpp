// EGL on Mesa's surfaceless platform: OpenGL without a display server, drawing into framebuffer
// objects only.
#include <array>
#include <mutex>
#include <sstream>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "render/context_kinds.hpp"

namespace armsreach::render {
namespace {

Error egl_error(const std::string& what) {
  std::ostringstream code;
  code << what << " (EGL error 0x" << std::hex << eglGetError() << ")";
  return {code.str(), "EGL surfaceless display",
          "install libegl-mesa0 and libgl1-mesa-dri, or use --display osmesa", Error::Kind::device};
}

// EGL hands every caller the same display, and terminating it takes all contexts down: it is
// shared, and closed with the last of them.
class SurfacelessDisplay {
 public:
  static Result<std::shared_ptr<SurfacelessDisplay>> open() {
    static std::mutex mutex;
    static std::weak_ptr<SurfacelessDisplay> shared;
    const std::lock_guard lock(mutex);
    if (auto opened = shared.lock()) return opened;
    EGLDisplay display =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) return egl_error("there is no surfaceless display");
    if (!eglInitialize(display, nullptr, nullptr)) return egl_error("it cannot be initialised");
    auto opened = std::make_shared<SurfacelessDisplay>(display);
    shared = opened;
    return opened;
  }

  explicit SurfacelessDisplay(EGLDisplay display) : display_(display) {}
  ~SurfacelessDisplay() { eglTerminate(display_); }
  SurfacelessDisplay(const SurfacelessDisplay&) = delete;
  SurfacelessDisplay& operator=(const SurfacelessDisplay&) = delete;

  EGLDisplay get() const { return display_; }

 private:
  EGLDisplay display_;
};

class EglContext final : public HeadlessContext {
 public:
  explicit EglContext(const ContextOptions& options) : HeadlessContext(ContextKind::egl, options) {}
  ~EglContext() override {
    if (context_ == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context_)
      eglMakeCurrent(display_->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_->get(), context_);
  }

  Status open() {
    auto display = SurfacelessDisplay::open();
    if (!display) return display.error();
    display_ = *display;
    const std::array config_wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                   EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_->get(), config_wanted.data(), &config, 1, &count) || count == 0)
      return egl_error("it has no configuration with OpenGL");
    if (!eglBindAPI(EGL_OPENGL_API)) return egl_error("it has no OpenGL");
    const std::array wanted{EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            3,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
    context_ = eglCreateContext(display_->get(), config, EGL_NO_CONTEXT, wanted.data());
    if (context_ == EGL_NO_CONTEXT) return egl_error("it has no OpenGL 3.3 core context");
    if (!eglMakeCurrent(display_->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      return egl_error("a context without a surface cannot be made current");
    auto gl = Gl::load([](const char* function) { return eglGetProcAddress(function); });
    if (!gl) return gl.error();
    gl_ = *gl;
    return ok();
  }

  void make_current() override {
    eglMakeCurrent(display_->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
  }

 private:
  std::shared_ptr<SurfacelessDisplay> display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

Result<std::unique_ptr<Context>> make_egl_context(const ContextOptions& options) {
  auto context = std::make_unique<EglContext>(options);
  if (const Status opened = context->open(); !opened) return opened.error();
  return std::unique_ptr<Context>(std::move(context));
}

}  // namespace armsreach::render
