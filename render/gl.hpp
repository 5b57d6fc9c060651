// OpenGL 3.3 core functions of one context. Nothing is global: contexts from different libraries
// (window, EGL, OSMesa) live side by side in one process and on several threads, each with its own
// table, and code that draws is given the table of the context it draws in.
#pragma once

#include <functional>

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES  // for the prototypes' types; nothing links to them
#endif
#include <GL/glcorearb.h>

#include "vision/core/result.hpp"

// clang-format off
#define ARMSREACH_GL_FUNCTIONS(X)                                                                  \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindBufferRange) X(BindFramebuffer)             \
  X(BindRenderbuffer) X(BindTexture) X(BindVertexArray) X(BlendEquation) X(BlendFunc)              \
  X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData) X(BufferSubData)                           \
  X(CheckFramebufferStatus) X(Clear) X(ClearBufferfv) X(ClearColor) X(ClearDepth) X(ClearStencil)  \
  X(ColorMask) X(CompileShader) X(CopyBufferSubData) X(CreateProgram) X(CreateShader) X(CullFace)  \
  X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteRenderbuffers) X(DeleteShader)   \
  X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) X(DrawArrays)       \
  X(DrawArraysInstanced) X(DrawBuffers) X(DrawElements) X(DrawElementsBaseVertex) X(Enable)        \
  X(EnableVertexAttribArray) X(Finish) X(Flush) X(FramebufferRenderbuffer)                         \
  X(FramebufferTexture2D) X(FrontFace) X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers)        \
  X(GenTextures) X(GenVertexArrays) X(GetError) X(GetIntegerv) X(GetProgramInfoLog)                \
  X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetUniformLocation)            \
  X(LineWidth) X(LinkProgram) X(MapBufferRange) X(MultiDrawArrays) X(PixelStorei) X(PointSize)     \
  X(PolygonOffset) X(ReadBuffer) X(ReadPixels) X(RenderbufferStorage)                              \
  X(RenderbufferStorageMultisample) X(Scissor) X(ShaderSource) X(StencilFunc) X(StencilMask)       \
  X(StencilOp) X(TexImage2D) X(TexParameteri) X(TexSubImage2D) X(Uniform1f) X(Uniform1fv)          \
  X(Uniform1i) X(Uniform2f) X(Uniform3f) X(Uniform4f) X(UniformMatrix3fv) X(UniformMatrix4fv)      \
  X(UnmapBuffer) X(UseProgram) X(VertexAttribDivisor) X(VertexAttribIPointer)                      \
  X(VertexAttribPointer) X(Viewport)
// clang-format on

namespace armsreach::render {

class Gl {
 public:
  using Function = void (*)();
  using Loader = std::function<Function(const char* name)>;

  // Fails, naming the function, when the context lacks one.
  static Result<Gl> load(const Loader& loader);

#define ARMSREACH_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  ARMSREACH_GL_FUNCTIONS(ARMSREACH_GL_MEMBER)
#undef ARMSREACH_GL_MEMBER
};

}  // namespace armsreach::render
