// Files of assets/ that the program cannot do without (shaders, meshes): compiled in, so that the
// binary runs from anywhere. Fonts are the system's (see fonts.hpp).
#pragma once

#include <string_view>

namespace armsreach::render {

// The contents of an asset by its path below assets/, e.g. "shaders/view.glsl". The name is a
// constant of the program: a wrong one is a programming error and asserts.
std::string_view asset(std::string_view name);

}  // namespace armsreach::render
