#include "render/gl_objects.hpp"

#include <string>

#include "render/assets.hpp"

namespace armsreach::render {
namespace {

void delete_program(const Gl& gl, GLuint id) { gl.DeleteProgram(id); }
void delete_shader(const Gl& gl, GLuint id) { gl.DeleteShader(id); }
void delete_texture(const Gl& gl, GLuint id) { gl.DeleteTextures(1, &id); }
void delete_buffer(const Gl& gl, GLuint id) { gl.DeleteBuffers(1, &id); }
void delete_vertex_array(const Gl& gl, GLuint id) { gl.DeleteVertexArrays(1, &id); }
void delete_framebuffer(const Gl& gl, GLuint id) { gl.DeleteFramebuffers(1, &id); }
void delete_renderbuffer(const Gl& gl, GLuint id) { gl.DeleteRenderbuffers(1, &id); }

Result<GlHandle> compile(const Gl& gl, GLenum stage, std::string_view name,
                         std::string_view source) {
  GlHandle shader(gl, gl.CreateShader(stage), delete_shader);
  const GLchar* text = source.data();
  const GLint length = static_cast<GLint>(source.size());
  gl.ShaderSource(shader.id(), 1, &text, &length);
  gl.CompileShader(shader.id());
  GLint compiled = 0;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string log(2000, '\0');
  GLsizei written = 0;
  gl.GetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return Error{"shader does not compile: " + log, std::string(name),
               "report it with the name of your OpenGL driver", Error::Kind::device};
}

std::string joined(const std::vector<std::string_view>& assets) {
  std::string source = "#version 330 core\n";
  for (const std::string_view name : assets) source += asset(name);
  return source;
}

GlHandle make_framebuffer(const Gl& gl) {
  GLuint id = 0;
  gl.GenFramebuffers(1, &id);
  return {gl, id, delete_framebuffer};
}

GlHandle make_renderbuffer(const Gl& gl, GLenum format, const FramebufferOptions& options) {
  GLuint id = 0;
  gl.GenRenderbuffers(1, &id);
  gl.BindRenderbuffer(GL_RENDERBUFFER, id);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, options.samples, format, options.width,
                                    options.height);
  return {gl, id, delete_renderbuffer};
}

GLenum attachment(std::size_t index) { return GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index); }

}  // namespace

Result<Program> Program::from_assets(const Gl& gl, const std::vector<std::string_view>& vertex,
                                     const std::vector<std::string_view>& fragment) {
  return from_source(gl, fragment.back(), joined(vertex), joined(fragment));
}

Result<Program> Program::from_source(const Gl& gl, std::string_view name, std::string_view vertex,
                                     std::string_view fragment) {
  auto vertex_shader = compile(gl, GL_VERTEX_SHADER, name, vertex);
  if (!vertex_shader) return vertex_shader.error();
  auto fragment_shader = compile(gl, GL_FRAGMENT_SHADER, name, fragment);
  if (!fragment_shader) return fragment_shader.error();
  Program program;
  program.handle_ = GlHandle(gl, gl.CreateProgram(), delete_program);
  gl.AttachShader(program.handle_.id(), vertex_shader->id());
  gl.AttachShader(program.handle_.id(), fragment_shader->id());
  gl.LinkProgram(program.handle_.id());
  GLint linked = 0;
  gl.GetProgramiv(program.handle_.id(), GL_LINK_STATUS, &linked);
  if (linked) return program;
  std::string log(2000, '\0');
  GLsizei written = 0;
  gl.GetProgramInfoLog(program.handle_.id(), static_cast<GLsizei>(log.size()), &written,
                       log.data());
  log.resize(static_cast<std::size_t>(written));
  return Error{"shaders do not link: " + log, std::string(name),
               "report it with the name of your OpenGL driver", Error::Kind::device};
}

void Program::use() const { handle_.gl().UseProgram(handle_.id()); }

GLint Program::uniform(const char* name) const {
  return handle_.gl().GetUniformLocation(handle_.id(), name);
}
void Program::set(const char* name, int value) const {
  handle_.gl().Uniform1i(uniform(name), value);
}
void Program::set(const char* name, float value) const {
  handle_.gl().Uniform1f(uniform(name), value);
}
void Program::set(const char* name, const Eigen::Vector2f& v) const {
  handle_.gl().Uniform2f(uniform(name), v.x(), v.y());
}
void Program::set(const char* name, const Eigen::Vector3f& v) const {
  handle_.gl().Uniform3f(uniform(name), v.x(), v.y(), v.z());
}
void Program::set(const char* name, const Eigen::Vector4f& v) const {
  handle_.gl().Uniform4f(uniform(name), v.x(), v.y(), v.z(), v.w());
}
void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  handle_.gl().UniformMatrix4fv(uniform(name), 1, GL_FALSE, value.data());
}
void Program::set(const char* name, const std::vector<float>& values) const {
  handle_.gl().Uniform1fv(uniform(name), static_cast<GLsizei>(values.size()), values.data());
}

Texture::Texture(const Gl& gl, int width, int height, const TextureFormat& format, GLint filter)
    : format_(format), width_(width), height_(height) {
  GLuint id = 0;
  gl.GenTextures(1, &id);
  handle_ = GlHandle(gl, id, delete_texture);
  gl.BindTexture(GL_TEXTURE_2D, id);
  gl.TexImage2D(GL_TEXTURE_2D, 0, format.internal, width, height, 0, format.format, format.type,
                nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Texture::upload(const void* pixels, int stride) {
  const Gl& gl = handle_.gl();
  gl.BindTexture(GL_TEXTURE_2D, handle_.id());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, stride);
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, format_.format, format_.type, pixels);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::upload_part(int x, int y, const cv::Mat& image) const {
  const Gl& gl = handle_.gl();
  gl.BindTexture(GL_TEXTURE_2D, handle_.id());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(image.step[0] / image.elemSize()));
  gl.TexSubImage2D(GL_TEXTURE_2D, 0, x, y, image.cols, image.rows, format_.format, format_.type,
                   image.data);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

void Texture::bind(int unit) const {
  const Gl& gl = handle_.gl();
  gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl.BindTexture(GL_TEXTURE_2D, handle_.id());
}

Buffer::Buffer(const Gl& gl) {
  GLuint id = 0;
  gl.GenBuffers(1, &id);
  handle_ = GlHandle(gl, id, delete_buffer);
}

void describe_vertices(const Gl& gl, std::size_t stride,
                       const std::vector<VertexAttribute>& attributes) {
  for (GLuint location = 0; location < attributes.size(); ++location) {
    const VertexAttribute& attribute = attributes[location];
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, attribute.size, attribute.type,
                           attribute.normalised ? GL_TRUE : GL_FALSE, static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(attribute.offset));
  }
}

VertexArray::VertexArray(const Gl& gl) {
  GLuint id = 0;
  gl.GenVertexArrays(1, &id);
  handle_ = GlHandle(gl, id, delete_vertex_array);
}

Result<Framebuffer> Framebuffer::make(const Gl& gl, const FramebufferOptions& options) {
  Framebuffer made;
  made.gl_ = &gl;
  made.options_ = options;
  made.textures_framebuffer_ = make_framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, made.textures_framebuffer_.id());
  std::vector<GLenum> attachments;
  for (std::size_t i = 0; i < options.colors.size(); ++i) {
    made.textures_.emplace_back(gl, options.width, options.height, options.colors[i]);
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachment(i), GL_TEXTURE_2D,
                            made.textures_.back().id(), 0);
    attachments.push_back(attachment(i));
  }
  gl.DrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  if (options.samples > 0) {
    made.samples_framebuffer_ = make_framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, made.samples_framebuffer_.id());
    for (std::size_t i = 0; i < options.colors.size(); ++i) {
      made.sample_buffers_.push_back(
          make_renderbuffer(gl, static_cast<GLenum>(options.colors[i].internal), options));
      gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment(i), GL_RENDERBUFFER,
                                 made.sample_buffers_.back().id());
    }
    gl.DrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  }
  if (options.depth) {
    made.depth_ = make_renderbuffer(gl, GL_DEPTH24_STENCIL8, options);
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                               made.depth_.id());
  }
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return Error{
        "cannot draw into " + std::to_string(options.width) + "x" + std::to_string(options.height) +
            " px with " + std::to_string(options.samples) + " samples",
        "OpenGL framebuffer", "use a smaller picture or fewer samples", Error::Kind::device};
  return made;
}

void Framebuffer::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, samples_framebuffer_ ? samples_framebuffer_.id()
                                                            : textures_framebuffer_.id());
  gl_->Viewport(0, 0, width(), height());
}

void Framebuffer::resolve(int x, int y, int width, int height) const {
  if (!samples_framebuffer_) return;
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, samples_framebuffer_.id());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, textures_framebuffer_.id());
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    gl_->ReadBuffer(attachment(i));
    std::vector<GLenum> only(i + 1, GL_NONE);
    only[i] = attachment(i);
    gl_->DrawBuffers(static_cast<GLsizei>(only.size()), only.data());
    gl_->BlitFramebuffer(x, y, x + width, y + height, x, y, x + width, y + height,
                         GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
}

void Framebuffer::copy_to(const Framebuffer& target, int x, int y) const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_id());
  gl_->ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.resolved_id());
  gl_->BlitFramebuffer(0, 0, width(), height(), x, y, x + width(), y + height(),
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void Framebuffer::read(GLenum format, GLenum type, void* pixels, int index) const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, textures_framebuffer_.id());
  gl_->ReadBuffer(attachment(static_cast<std::size_t>(index)));
  gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_->ReadPixels(0, 0, width(), height(), format, type, pixels);
}

}  // namespace armsreach::render
