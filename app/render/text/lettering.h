// Text and flat shapes on an Image, by FreeType with the DejaVu fonts. Pixels from the top left, y
// down. A thin halo of opposite lightness keeps letters legible.
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
  Lettering();  // throws InputError if the fonts are missing
  ~Lettering();

  // `text`: UTF-8, one line; malformed bytes become the replacement character.
  double width(const std::string& text, double size_px, Weight weight = Weight::regular);
  // `start_px` is the left end of the base line.
  void draw(Image& image, const std::string& text, const Eigen::Vector2d& start_px, double size_px,
            const Color& color, Weight weight = Weight::regular);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// Antialiased shapes. A box with rounded corners:
void draw_box(Image& image, const Eigen::Vector2d& low, const Eigen::Vector2d& high, double radius,
              const Color& color);
// With round ends:
void draw_line(Image& image, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width,
               const Color& color);
void draw_dot(Image& image, const Eigen::Vector2d& center, double radius, const Color& color);

}  // namespace twinarm
