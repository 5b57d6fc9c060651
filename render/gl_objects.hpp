// OpenGL objects that free themselves. Each remembers the table of the context it was made in and
// must be destroyed while that context is current, on its thread.
//
// Images and framebuffers are stored top row first, like cv::Mat: row 0 of a texture is the image's
// upper edge, and what is read back needs no flip (see view.hpp).
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "render/gl.hpp"
#include "vision/core/result.hpp"

namespace armsreach::render {

// A name given by OpenGL and the call that gives it back.
class GlHandle {
 public:
  using Destroy = void (*)(const Gl&, GLuint);

  GlHandle() = default;
  GlHandle(const Gl& gl, GLuint id, Destroy destroy) : gl_(&gl), id_(id), destroy_(destroy) {}
  GlHandle(GlHandle&& other) noexcept { swap(other); }
  GlHandle& operator=(GlHandle&& other) noexcept {
    swap(other);
    return *this;
  }
  GlHandle(const GlHandle&) = delete;
  GlHandle& operator=(const GlHandle&) = delete;
  ~GlHandle() {
    if (id_) destroy_(*gl_, id_);
  }

  const Gl& gl() const { return *gl_; }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void swap(GlHandle& other) {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    std::swap(destroy_, other.destroy_);
  }

  const Gl* gl_ = nullptr;
  GLuint id_ = 0;
  Destroy destroy_ = nullptr;
};

class Program {
 public:
  Program() = default;
  // The stages' sources are the named assets, joined in order after the #version line. Errors carry
  // the compiler's log.
  static Result<Program> from_assets(const Gl& gl, const std::vector<std::string_view>& vertex,
                                     const std::vector<std::string_view>& fragment);
  static Result<Program> from_source(const Gl& gl, std::string_view name, std::string_view vertex,
                                     std::string_view fragment);

  void use() const;
  // Uniforms of the program in use; names it does not have are ignored.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;
  void set(const char* name, const std::vector<float>& values) const;

 private:
  GLint uniform(const char* name) const;
  GlHandle handle_;
};

struct TextureFormat {
  GLint internal = GL_RGBA8;
  GLenum format = GL_RGBA;
  GLenum type = GL_UNSIGNED_BYTE;
};

class Texture {
 public:
  Texture() = default;
  Texture(const Gl& gl, int width, int height, const TextureFormat& format,
          GLint filter = GL_LINEAR);

  // Tightly packed rows, or rows `stride` pixels apart.
  void upload(const void* pixels, int stride = 0);
  // An image of the texture's format into a part of it.
  void upload_part(int x, int y, const cv::Mat& image) const;
  void bind(int unit) const;

  GLuint id() const { return handle_.id(); }
  int width() const { return width_; }
  int height() const { return height_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  GlHandle handle_;
  TextureFormat format_;
  int width_ = 0;
  int height_ = 0;
};

class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(const Gl& gl);
  void bind(GLenum target) const { handle_.gl().BindBuffer(target, handle_.id()); }
  GLuint id() const { return handle_.id(); }

 private:
  GlHandle handle_;
};

class VertexArray {
 public:
  VertexArray() = default;
  explicit VertexArray(const Gl& gl);
  void bind() const { handle_.gl().BindVertexArray(handle_.id()); }

 private:
  GlHandle handle_;
};

struct VertexAttribute {
  GLint size;  // components
  GLenum type;
  bool normalised;
  std::size_t offset;  // bytes, in a vertex
};
// Of the bound array: vertices lie `stride` bytes apart in the bound buffer, and attributes take
// the shader's locations 0, 1, ...
void describe_vertices(const Gl& gl, std::size_t stride,
                       const std::vector<VertexAttribute>& attributes);

struct FramebufferOptions {
  int width = 0;
  int height = 0;
  int samples = 0;  // 0: drawn straight into the textures; else resolve() fills them
  std::vector<TextureFormat> colors{TextureFormat{}};
  bool depth = false;  // a 24-bit depth and 8-bit stencil buffer
};

// Colour textures to draw into, with MSAA where wished.
class Framebuffer {
 public:
  Framebuffer() = default;
  static Result<Framebuffer> make(const Gl& gl, const FramebufferOptions& options);

  void bind() const;  // for drawing, viewport over the whole of it
  // Averages the samples of a rectangle (all of it by default) into the textures.
  void resolve() const { resolve(0, 0, width(), height()); }
  void resolve(int x, int y, int width, int height) const;
  // Reads the resolved colour `index`, top row first, tightly packed.
  void read(GLenum format, GLenum type, void* pixels, int index = 0) const;

  // Copies the resolved first colour to a place in another framebuffer's textures, unscaled.
  void copy_to(const Framebuffer& target, int x, int y) const;

  const Texture& color(int index = 0) const { return textures_[static_cast<std::size_t>(index)]; }
  int width() const { return options_.width; }
  int height() const { return options_.height; }
  // What is read from and blitted from: the framebuffer that the textures are attached to.
  GLuint resolved_id() const { return textures_framebuffer_.id(); }

 private:
  const Gl* gl_ = nullptr;
  FramebufferOptions options_;
  std::vector<Texture> textures_;
  std::vector<GlHandle> sample_buffers_;
  GlHandle depth_;
  GlHandle textures_framebuffer_;
  GlHandle samples_framebuffer_;  // only with samples
};

}  // namespace armsreach::render
