#include "render/gl.hpp"

namespace armsreach::render {

Result<Gl> Gl::load(const Loader& loader) {
  Gl gl;
#define ARMSREACH_GL_LOAD(name)                                                \
  gl.name = reinterpret_cast<decltype(gl.name)>(loader("gl" #name));           \
  if (!gl.name)                                                                \
    return Error{"OpenGL function gl" #name " is missing", "OpenGL context",   \
                 "install libgl1-mesa-dri (Mesa) or a driver with OpenGL 3.3", \
                 Error::Kind::device};
  ARMSREACH_GL_FUNCTIONS(ARMSREACH_GL_LOAD)
#undef ARMSREACH_GL_LOAD
  return gl;
}

}  // namespace armsreach::render
