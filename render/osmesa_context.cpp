// OSMesa: Mesa's software rasteriser drawing into memory, for machines where not even EGL works.
//
// The library is opened at run time with its symbols kept to itself: it exports the gl* functions
// under the same names as libGL, and must not lend them to anyone else in the process.
#include <array>
#include <cstdint>
#include <dlfcn.h>

// osmesa.h brings GL/gl.h along, which must then declare what gl.hpp takes the types of.
#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>

#include "render/context_kinds.hpp"

namespace armsreach::render {
namespace {

Error osmesa_error(const std::string& what) {
  return {what, "OSMesa", "install libosmesa6, or use --display egl", Error::Kind::device};
}

struct Library {
  decltype(&::OSMesaCreateContextAttribs) create = nullptr;
  decltype(&::OSMesaMakeCurrent) make_current = nullptr;
  decltype(&::OSMesaDestroyContext) destroy = nullptr;
  decltype(&::OSMesaGetProcAddress) load = nullptr;
  decltype(&::OSMesaGetCurrentContext) current = nullptr;
};

template <class F>
bool find(void* library, const char* function, F& found) {
  found = reinterpret_cast<F>(dlsym(library, function));
  return found != nullptr;
}

// Never closed again: Mesa keeps thread-local state that outlives its contexts.
Result<Library> open_library() {
  void* file = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!file) return osmesa_error(dlerror());
  Library library;
  if (!find(file, "OSMesaCreateContextAttribs", library.create) ||
      !find(file, "OSMesaMakeCurrent", library.make_current) ||
      !find(file, "OSMesaDestroyContext", library.destroy) ||
      !find(file, "OSMesaGetProcAddress", library.load) ||
      !find(file, "OSMesaGetCurrentContext", library.current))
    return osmesa_error("libOSMesa.so.8 is too old for core contexts");
  return library;
}

class OsMesaContext final : public HeadlessContext {
 public:
  explicit OsMesaContext(const ContextOptions& options)
      : HeadlessContext(ContextKind::osmesa, options) {}
  ~OsMesaContext() override {
    if (context_) library_.destroy(context_);
  }

  Status open() {
    auto library = open_library();
    if (!library) return library.error();
    library_ = *library;
    // A forward-compatible context is refused by OSMesa, a core one is given.
    const std::array wanted{OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
    context_ = library_.create(wanted.data(), nullptr);
    if (!context_) return osmesa_error("no OpenGL 3.3 core context");
    if (!attach()) return osmesa_error("the context cannot be made current");
    auto gl = Gl::load([this](const char* function) { return library_.load(function); });
    if (!gl) return gl.error();
    gl_ = *gl;
    return ok();
  }

  void make_current() override { attach(); }

 private:
  // Everything is drawn into framebuffer objects; the buffer that OSMesa asks for stays small.
  bool attach() {
    return library_.make_current(context_, unused_buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide);
  }

  static constexpr int kSide = 16;
  Library library_;
  OSMesaContext context_ = nullptr;
  std::array<std::uint8_t, kSide * kSide * 4> unused_buffer_{};
};

}  // namespace

Result<std::unique_ptr<Context>> make_osmesa_context(const ContextOptions& options) {
  auto context = std::make_unique<OsMesaContext>(options);
  if (const Status opened = context->open(); !opened) return opened.error();
  return std::unique_ptr<Context>(std::move(context));
}

}  // namespace armsreach::render
