// Overlay: title, legend and labels onto a finished picture.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"
#include "app/render/text/lettering.h"

namespace twinarm {

// Where labels stood in the picture before, for films: there they keep their line while it is free,
// and glide to another instead of jumping. A label is known by its words without numbers and
// prefixes of units, and by how many of the same stand before it in the list.
class LabelMemory {
 public:
  struct Place {
    double line = 0;      // lines below the wanted place
    double shift_px = 0;  // down, as drawn
    int picture = -1;     // in which it was drawn last
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

// `clip_from_world` is the projection with which the picture was made; no memory: a still.
void draw_overlay(Image& image, const DrawList& list, const Eigen::Matrix4d& clip_from_world,
                  Lettering& lettering, LabelMemory* memory = nullptr);

}  // namespace twinarm
