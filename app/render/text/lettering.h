// Text and flat shapes onto an Image (FreeType and the DejaVu fonts of Debian end here).
//
// Positions and sizes in pixels from the top left, y down. A thin halo in the opposite tone keeps
// the letters legible on any ground.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

enum class Weight { regular, bold };

class Lettering {
 public:
  Lettering();  // throws InputError where the fonts are missing
  ~Lettering();

  // `text` is UTF-8, one line; a malformed byte becomes the replacement character.
  double width(const std::string& text, double size_px, Weight weight = Weight::regular);
  // `start_px` is the left end of the base line.
  void draw(Image& image, const std::string& text, const Eigen::Vector2d& start_px, double size_px,
            const Color& color, Weight weight = Weight::regular);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Flat shapes; edges are smooth by their cover. A box with corners of the given radius:
void draw_box(Image& image, const Eigen::Vector2d& low, const Eigen::Vector2d& high, double radius,
              const Color& color);
// With round ends:
void draw_line(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
               const Color& color);
void draw_dot(Image& image, const Eigen::Vector2d& center, double radius, const Color& color);

}  // namespace twinarm
