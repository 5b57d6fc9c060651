// In programs built with a sanitizer the drivers are held in memory: AddressSanitizer names their
// frames at exit, and ThreadSanitizer ends a program that unloads a library it has a rule for. A
// few hundred bytes that Mesa keeps for each context, and a few thousand that OpenNI2 keeps each
// time it is started, are not our leaks.
#include <cstdio>
#include <dlfcn.h>
#include <initializer_list>

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libEGL_mesa\nleak:libGLX_mesa\nleak:swrast_dri\n"
         "leak:libOpenNI2\nleak:libOniFile\nleak:libPS1080\nleak:libPSLink\n";
}

namespace {

[[maybe_unused]] const bool held = [] {
  for (const char* driver : {"dri/swrast_dri.so", "OpenNI2/Drivers/libOniFile.so.0",
                             "OpenNI2/Drivers/libPS1080.so.0", "OpenNI2/Drivers/libPSLink.so.0"}) {
    char path[128];
    std::snprintf(path, sizeof path, "/usr/lib/x86_64-linux-gnu/%s", driver);
    dlopen(path, RTLD_LAZY | RTLD_NODELETE);
  }
  return true;
}();

}  // namespace
