#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "vision/gesture/template_set.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace armsreach::gesture;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  TemplateSet set;
  if (read_templates(in, "L", "fuzz", &set)) {
    // What was accepted can be written and is accepted again.
    std::stringstream copy;
    write_templates(copy, "L", set);
    TemplateSet again;
    if (!read_templates(copy, "L", "copy", &again)) __builtin_trap();
    if (again.templates.size() != set.templates.size()) __builtin_trap();
  }
  return 0;
}
