// Painter: a DrawList to an Image, on the CPU by Mesa, without display or GPU.
//
// Bodies are lit and cast shadows; ghosts (alpha < 1) come after them, each showing only its
// nearest surface; labels, legend and title are set on the finished picture. The same list gives
// the same bits with both back ends and any number of threads, on one version of Mesa.
//
// A painter belongs to one thread at a time, any thread. Drawing errors are mistakes of ours and
// throw std::logic_error; what the user can mend (library, font, size) throws InputError.
#pragma once

#include <memory>

#include "app/render/gl/gl_context.h"
#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

// Times: see README.md.
enum class Quality {
  draft,   // no antialiasing, hard shadow: while the view moves
  normal,  // 4 samples a pixel, shadow with a soft edge
  studio,  // the mean of many pictures, each with the light, the sky and the pixel grid a little
           // elsewhere: true penumbras, ambient occlusion, fine edges. For stills
};

class Painter {
 public:
  Painter(Backend backend, int width, int height, Quality quality = Quality::normal);
  ~Painter();

  Image paint(const DrawList& list);
  // The same, as the next picture of a film: labels move on from where they stood.
  Image paint_next(const DrawList& list);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace twinarm
