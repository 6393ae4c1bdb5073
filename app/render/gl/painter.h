// Painter: a DrawList to an Image, on the CPU by Mesa, without display or GPU.
//
// Bodies are lit and cast shadows; translucent ones (alpha < 1) follow, each with its nearest
// surface only; then labels, legend and title. The same list gives the same bits with both back
// ends and any number of threads, on one version of Mesa.
//
// For one thread at a time. Throws std::logic_error on drawing errors, InputError for library,
// font and size.
#pragma once

#include <memory>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

// OffscreenContext: an OpenGL 3.3 core context without display, window or GPU.
//
// Both back ends give the same bits on one Mesa version. OSMesa is the default; Mesa 25.1 (2025)
// removed it. Opened by dlopen: OSMesa and a linked libGL (SDL, GLFW) would share symbols.

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

// Times: see README.md.
enum class Quality {
  draft,   // no antialiasing, hard shadow
  normal,  // 4 samples per pixel, soft shadow edge
  studio,  // mean of 64 samples of light, sky and pixel: penumbras, ambient occlusion; for stills
};

class Painter {
 public:
  Painter(Backend backend, int width, int height, Quality quality = Quality::normal);
  ~Painter();

  // is_next: as the next picture of a film, labels move smoothly.
  Image paint(const DrawList& list, bool is_next = false);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
