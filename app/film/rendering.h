// Pictures of a run, or of two side by side at the same instants, with curves below them.
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
  double field_of_view = Camera{}.field_of_view;  // vertical [rad]
  double orbit = 0;                               // about the vertical, per picture [rad]
  std::vector<std::string> overlays;
  std::vector<const CurveKind*> curves;
};

// Two runs share camera and scales.
class Rendering {
 public:
  // The runs must outlive it and have equal numbers of pictures. Throws InputError.
  Rendering(const PictureWish& wish, const std::vector<FilmedRun*>& runs);
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
