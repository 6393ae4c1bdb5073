// GlTable: the OpenGL 3.3 functions that the painter calls, by name from an OffscreenContext.
//
// One list makes the members and loads them. The types are taken from the system's headers by
// decltype, which is not evaluated: no gl* symbol is linked. To use a further function, add its
// name (without "gl") to the list.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <stdexcept>
#include <string>

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

namespace twinarm {

struct GlTable {
#define TWINARM_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
  TWINARM_GL_FUNCTIONS(TWINARM_GL_MEMBER)
#undef TWINARM_GL_MEMBER

  // `proc` gives the address of a function by its full name; the context must be current.
  template <class Proc>
  void load(Proc&& proc) {
#define TWINARM_GL_LOAD(name)                                     \
  name = reinterpret_cast<decltype(&gl##name)>(proc("gl" #name)); \
  if (name == nullptr) throw std::runtime_error("OpenGL has no gl" #name);
    TWINARM_GL_FUNCTIONS(TWINARM_GL_LOAD)
#undef TWINARM_GL_LOAD
  }
};

}  // namespace twinarm
