#include "app/render/gl/gl_objects.h"

#include <algorithm>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr const char* kUniformNames[] = {
#define TWINARM_UNIFORM_NAME(name) #name,
    TWINARM_UNIFORMS(TWINARM_UNIFORM_NAME)
#undef TWINARM_UNIFORM_NAME
};

GLuint compile(const GlTable& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint ok = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (!ok) {
    std::array<char, 4096> log{};
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::logic_error("shader does not compile: " + std::string(log.data()) + source);
  }
  return shader;
}

template <class Element>
void upload(const GlTable& gl, GLenum target, GLuint buffer, const std::vector<Element>& data) {
  gl.BindBuffer(target, buffer);
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(Element)), data.data(),
                GL_STATIC_DRAW);
}

// Of the bound buffer.
void set_attribute(const GlTable& gl, GLuint index, GLint numbers) {
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, numbers, GL_FLOAT, GL_FALSE, 0, nullptr);
}

void check_framebuffer(const GlTable& gl, const std::string& what) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw InputError({Diagnostic{"", 0, "renderer", "cannot allocate " + what,
                                 "use a smaller picture or free memory", "render.memory"}});
}

}  // namespace

Program::Program(const GlTable& gl, const ShaderSource& source) : gl_(gl), id_(gl.CreateProgram()) {
  const GLuint shaders[] = {compile(gl, GL_VERTEX_SHADER, source.vertex),
                            compile(gl, GL_FRAGMENT_SHADER, source.fragment)};
  for (const GLuint shader : shaders) gl.AttachShader(id_, shader);
  gl.LinkProgram(id_);
  for (const GLuint shader : shaders) gl.DeleteShader(shader);  // when the program is deleted
  GLint ok = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (!ok) {
    std::array<char, 4096> log{};
    gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::logic_error("program does not link: " + std::string(log.data()));
  }
  for (std::size_t i = 0; i < location_.size(); ++i)
    location_[i] = gl.GetUniformLocation(id_, kUniformNames[i]);
}

GpuMesh::GpuMesh(const GlTable& gl, const DrawMesh& mesh)
    : gl_(gl), index_count_(static_cast<GLsizei>(3 * mesh.triangles.size())) {
  gl.GenVertexArrays(1, &array_);
  gl.BindVertexArray(array_);
  gl.GenBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
  upload(gl, GL_ARRAY_BUFFER, buffers_[0], mesh.positions);
  set_attribute(gl, 0, 3);
  upload(gl, GL_ARRAY_BUFFER, buffers_[1], mesh.normals);
  set_attribute(gl, 1, 3);
  upload(gl, GL_ELEMENT_ARRAY_BUFFER, buffers_[2], mesh.triangles);
  if (!mesh.uv.empty()) {
    upload(gl, GL_ARRAY_BUFFER, buffers_[3], mesh.uv);
    set_attribute(gl, 2, 2);
  }
  gl.BindVertexArray(0);
}

GpuMesh::~GpuMesh() {
  gl_.DeleteVertexArrays(1, &array_);
  gl_.DeleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
}

void GpuMesh::draw() const {
  gl_.BindVertexArray(array_);
  gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

GpuTexture::GpuTexture(const GlTable& gl, const Image& image) : gl_(gl) {
  gl.GenTextures(1, &id_);
  gl.BindTexture(GL_TEXTURE_2D, id_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA,
                GL_UNSIGNED_BYTE, image.rgba.data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

GpuTexture::~GpuTexture() {
  gl_.DeleteTextures(1, &id_);
}

ShadowMap::ShadowMap(const GlTable& gl, int side, bool compares) : side_px(side) {
  const GLint filter = compares ? GL_LINEAR : GL_NEAREST;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT16, side, side, 0, GL_DEPTH_COMPONENT,
                GL_UNSIGNED_SHORT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE,
                   compares ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);

  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  check_framebuffer(gl, "a shadow map");
}

Canvas::Canvas(const GlTable& gl, int width, int height, bool multisampled)
    : gl_(gl), width_(width), height_(height) {
  GLint limit = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
  if (width < 1 || height < 1 || width > limit || height > limit) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    throw InputError(
        {Diagnostic{"", 0, "picture", "size is " + size + " pixels",
                    "give 1 to " + std::to_string(limit) + " pixels each way", "render.size"}});
  }
  GLint samples = 0;
  gl.GetIntegerv(GL_MAX_SAMPLES, &samples);
  draw_ = make_framebuffer(multisampled ? std::min(4, samples) : 0, true);
  resolved_ = multisampled ? make_framebuffer(0, false) : draw_;
}

GLuint Canvas::make_framebuffer(int samples, bool with_depth) const {
  GLuint framebuffer = 0;
  gl_.GenFramebuffers(1, &framebuffer);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const auto attach = [&](GLenum format, GLenum attachment) {
    GLuint buffer = 0;
    gl_.GenRenderbuffers(1, &buffer);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width_, height_);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
  if (with_depth) attach(GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
  check_framebuffer(gl_, std::to_string(width_) + " x " + std::to_string(height_) + " pixels");
  return framebuffer;
}

void Canvas::begin() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, draw_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void Canvas::read(std::uint8_t* rgba) {
  if (resolved_ != draw_) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, draw_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                        GL_NEAREST);
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
}

}  // namespace twinarm
