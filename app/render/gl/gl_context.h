// OffscreenContext: an OpenGL 3.3 core context without display, window or GPU.
//
// Both back ends give the same bits on one Mesa version. OSMesa is the default; Mesa 25.1 (2025)
// removed it. Opened by dlopen: OSMesa and a linked libGL (SDL, GLFW) would share symbols.
#pragma once

#include <memory>

namespace twinarm {

enum class Backend { osmesa, egl };

class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  virtual void make_current() = 0;  // in the calling thread
  virtual void release() = 0;       // in the calling thread
  // Address of a gl* function. OSMesa returns one for unknown names too.
  virtual void* proc(const char* name) = 0;

 protected:
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
};

// Throws InputError if the library is missing or has no such context.
std::unique_ptr<OffscreenContext> make_offscreen_context(Backend backend);

}  // namespace twinarm
