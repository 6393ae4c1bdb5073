// Rendering: the pictures of a run, or of two side by side at the same instants, with curves that
// run under them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/draw/curves.h"
#include "app/film/filmed_run.h"
#include "app/render/gl/gl_context.h"
#include "app/render/gl/painter.h"

namespace twinarm {

struct PictureWish {
  int width = 0, height = 0;  // [px]
  Quality quality = Quality::normal;
  Background background;
  Backend backend = Backend::osmesa;
  std::string camera = "auto";
  std::vector<std::string> overlays;
  std::vector<const CurveKind*> curves;
};

// Two runs have one camera, one scale of arrows and one of curves, so that they can be compared.
class Rendering {
 public:
  // The runs outlive it. Each has as many instants to be shown. Throws InputError.
  Rendering(const PictureWish& wish, const std::vector<const FilmedRun*>& runs);
  ~Rendering();
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;

  Image paint(std::size_t picture);
  std::vector<std::string> notes() const;

 private:
  class View;
  PictureWish wish_;
  std::vector<std::unique_ptr<View>> views_;
};

}  // namespace twinarm
