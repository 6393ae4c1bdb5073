// OpenGL objects of the painter: functions, programs, meshes, textures, framebuffers.
//
// They require a current context and are destroyed with it; meshes and textures are freed earlier.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "app/render/list/draw_mesh.h"
#include "app/render/list/image.h"

namespace twinarm {

// Shaders, GLSL 3.30 (glsl/). World frame, linear colours; opaque shaders write sRGB, blended ones
// linear light. Variants by #define: llvmpipe executes both sides of a branch.

struct ShaderVariant {
  bool soft_shadow = true;  // over 3 x 3 texels of the map, else 2 x 2 by the sampler
  bool sky_sample = false;  // one sky direction with its shadow map (studio quality)
  bool key_shadow = true;   // shadows of the key light
  bool textured = false;    // the colour is multiplied by a texture
  bool horizon = false;     // floor and background of a landscape
};

struct ShaderSource {
  std::string vertex, fragment;
};
ShaderSource solid_shader(const ShaderVariant& variant);
ShaderSource translucent_shader(const ShaderVariant& variant);
ShaderSource depth_shader();  // bodies into a shadow map
ShaderSource floor_shader(const ShaderVariant& variant);
ShaderSource background_shader(const ShaderVariant& variant);

// OpenGL 3.3 functions, loaded by name from an OffscreenContext. To use another function, add its
// name without "gl". Types come from decltype, which links no gl* symbol.
// clang-format off
#define TWINARM_GL_FUNCTIONS(X)                                                                   \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer)           \
  X(BindTexture) X(BindVertexArray) X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData)                 \
  X(CheckFramebufferStatus) X(Clear) X(ColorMask) X(CompileShader) X(CreateProgram) \
  X(CreateShader) X(DeleteBuffers) X(DeleteShader) X(DeleteTextures) X(DeleteVertexArrays)              \
  X(DepthFunc) X(DepthMask) X(Disable) X(DrawArrays) X(DrawBuffer) X(DrawElements) X(Enable)      \
  X(EnableVertexAttribArray) X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(GenBuffers) X(GenerateMipmap)     \
  X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays) X(GetError)            \
  X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv)          \
  X(GetUniformLocation) X(LinkProgram) X(PixelStorei) X(PolygonOffset) X(ReadBuffer)              \
  X(ReadPixels) X(RenderbufferStorageMultisample) X(Scissor) X(ShaderSource)          \
  X(TexImage2D) X(TexParameteri) X(Uniform1f) X(Uniform1i) X(Uniform2f)         \
  X(Uniform3f) X(Uniform4f) X(UniformMatrix3fv) X(UniformMatrix4fv) X(UseProgram)                 \
  X(VertexAttribPointer) X(Viewport)
// clang-format on

struct GlTable {
#define TWINARM_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
  TWINARM_GL_FUNCTIONS(TWINARM_GL_MEMBER)
#undef TWINARM_GL_MEMBER

  // `proc` returns the address of a function; the context must be current.
  template <class Proc>
  void load(Proc&& proc) {
#define TWINARM_GL_LOAD(name)                                     \
  name = reinterpret_cast<decltype(&gl##name)>(proc("gl" #name)); \
  if (name == nullptr) throw std::runtime_error("OpenGL has no gl" #name);
    TWINARM_GL_FUNCTIONS(TWINARM_GL_LOAD)
#undef TWINARM_GL_LOAD
  }
};

// Uniforms of all shaders.
// clang-format off
#define TWINARM_UNIFORMS(X)                                                                       \
  X(world_from_mesh) X(normal_from_mesh) X(clip_from_world) X(world_from_clip) X(key_from_world)  \
  X(sky_from_world) X(normal_offset) X(eye) X(key_direction) X(sky_direction) X(color) X(picture) \
  X(shininess) X(key_shadow) X(sky_shadow) X(texel) X(shadow_reach) X(per_height)                 \
  X(background_bottom) X(background_top) X(background_ground) X(ground) X(grid) X(per_grid)
// clang-format on
enum class Uniform : std::size_t {
#define TWINARM_UNIFORM(name) name,
  TWINARM_UNIFORMS(TWINARM_UNIFORM)
#undef TWINARM_UNIFORM
      count
};

// A linked program with its uniform locations. Setting a uniform that a variant lacks (location -1)
// has no effect.
class Program {
 public:
  Program(const GlTable& gl, const ShaderSource& source);
  void use() const { gl_.UseProgram(id_); }
  void set(Uniform u, int x) const { gl_.Uniform1i(at(u), x); }
  void set(Uniform u, float x) const { gl_.Uniform1f(at(u), x); }
  void set(Uniform u, float x, float y) const { gl_.Uniform2f(at(u), x, y); }
  void set(Uniform u, const Eigen::Vector3f& v) const { gl_.Uniform3f(at(u), v.x(), v.y(), v.z()); }
  void set(Uniform u, const Eigen::Vector4f& v) const {
    gl_.Uniform4f(at(u), v.x(), v.y(), v.z(), v.w());
  }
  void set(Uniform u, const Eigen::Matrix3f& m) const {
    gl_.UniformMatrix3fv(at(u), 1, GL_FALSE, m.data());
  }
  void set(Uniform u, const Eigen::Matrix4f& m) const {
    gl_.UniformMatrix4fv(at(u), 1, GL_FALSE, m.data());
  }

 private:
  GLint at(Uniform u) const { return location_[static_cast<std::size_t>(u)]; }

  const GlTable& gl_;
  GLuint id_ = 0;
  std::array<GLint, static_cast<std::size_t>(Uniform::count)> location_{};
};

// A DrawMesh in vertex buffers: attribute 0 position, 1 normal, 2 texture coordinates.
class GpuMesh {
 public:
  GpuMesh(const GlTable& gl, const DrawMesh& mesh);
  ~GpuMesh();
  GpuMesh(const GpuMesh&) = delete;
  void draw() const;

 private:
  const GlTable& gl_;
  GLuint array_ = 0;
  std::array<GLuint, 4> buffers_{};  // positions, normals, indices, uv
  GLsizei index_count_ = 0;
};

// An image as an sRGB texture with mipmaps, repeated beyond its edges.
class GpuTexture {
 public:
  GpuTexture(const GlTable& gl, const Image& image);
  ~GpuTexture();
  GpuTexture(const GpuTexture&) = delete;
  GLuint id() const { return id_; }

 private:
  const GlTable& gl_;
  GLuint id_ = 0;
};

// Square depth texture of a light. `compares`: hardware comparison over 2 x 2 texels, else nearest
// depth. A smaller square at its origin may be used. 16 bits are a hundredth of the shadow offset.
struct ShadowMap {
  ShadowMap(const GlTable& gl, int side_px, bool compares);
  int side_px;
  GLuint texture = 0, framebuffer = 0;
};

// Colour and depth of the picture: sRGB bytes, 4 samples per pixel or one; colour is not cleared.
// Depth is float, which needs no conversion per sample.
class Canvas {
 public:
  Canvas(const GlTable& gl, int width, int height, bool multisampled);
  void begin() const;             // binds it, sets the viewport, clears the depth
  void read(std::uint8_t* rgba);  // resolves and reads 4 * width * height bytes, BOTTOM row first

 private:
  GLuint make_framebuffer(int samples, bool with_depth) const;

  const GlTable& gl_;
  int width_, height_;
  GLuint draw_ = 0, resolved_ = 0;  // equal with one sample
};

}  // namespace twinarm
