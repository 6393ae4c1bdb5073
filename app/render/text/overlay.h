// Title, legend and labels of a picture; 3-D overlays: app/draw/overlays/.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"
#include "app/render/text/lettering.h"

namespace twinarm {

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
