// In programs built with AddressSanitizer: a few hundred bytes that Mesa keeps for each context are
// not our leaks. The driver is held in memory so that its frames still have a name at exit.
#include <dlfcn.h>

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libEGL_mesa\nleak:libGLX_mesa\nleak:swrast_dri\n";
}

namespace {
[[maybe_unused]] void* const driver =
    dlopen("/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so", RTLD_LAZY | RTLD_NODELETE);
}
