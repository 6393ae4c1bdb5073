// Text and flat shapes on an Image, by FreeType with the DejaVu fonts. Pixels from the top left, y
// down. A thin halo of opposite lightness keeps letters legible.
#pragma once

#include <Eigen/Core>
#include <map>
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

// Title, legend and labels of a picture; 3-D overlays: app/draw/overlays/.

// Label positions in the previous picture of a film: a label keeps its line while it is free, and
// moves gradually to another. A label is identified by its text without numbers and unit prefixes,
// and by the number of equal ones before it.
class LabelMemory {
 public:
  struct Place {
    double line = 0;      // lines below the preferred position
    double shift_px = 0;  // downwards, as drawn
    int picture = -1;     // last picture with it
  };
  void begin() {  // a picture
    ++picture_;
    seen_.clear();
  }
  Place* find_or_add(const std::string& words);  // of the next label with these words
  bool is_new(const Place& place) const { return place.picture != picture_ - 1; }
  int picture() const { return picture_; }

 private:
  int picture_ = 0;
  std::map<std::string, int> seen_;
  std::map<std::string, Place> places_;
};

// `clip_from_world`: projection of the picture; no memory: a still.
void draw_overlay(Image& image, const DrawList& list, const Eigen::Matrix4d& clip_from_world,
                  Lettering& lettering, LabelMemory* memory = nullptr);

}  // namespace twinarm
