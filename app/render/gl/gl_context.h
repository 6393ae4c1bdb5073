// OffscreenContext: an OpenGL 3.3 core context without display, window or GPU.
//
// Two back ends give the same bits on one Mesa version. OSMesa is the default; Mesa 25.1 (2025)
// removed it, and EGL without surfaces is what stays. Both libraries are opened by dlopen: linking
// OSMesa beside a libGL (SDL, GLFW) makes each swallow the other's calls.
#pragma once

#include <memory>

namespace twinarm {

enum class Backend { osmesa, egl };

class OffscreenContext {
 public:
  virtual ~OffscreenContext() = default;
  virtual void make_current() = 0;  // in the calling thread
  virtual void release() = 0;       // from the calling thread; another may take it then
  // Address of a gl* function. Not a feature test: OSMesa gives one for names that do not exist.
  virtual void* proc(const char* name) = 0;

 protected:
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
};

// Throws InputError where the library is missing or cannot give such a context.
std::unique_ptr<OffscreenContext> make_offscreen_context(Backend backend);

}  // namespace twinarm
