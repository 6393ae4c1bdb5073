// PlotStrip: curves over time below a picture, with a cursor at its instant. Axes and curves are
// drawn once, the cursor for each frame of a film.
#pragma once

#include <string>
#include <vector>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

struct PlotCurve {
  std::string name;
  Color color;
  std::vector<double> y;     // one for each time; not finite: a gap
  bool from_lowest = false;  // as in CurveSample
};

struct PlotRange {
  double t_low = 0, t_high = 0;  // [s]
  double y_low = 0, y_high = 0;  // contains 0
};

struct Plot {
  std::string title;      // quantity and unit
  std::vector<double> t;  // ascending [s]
  std::vector<PlotCurve> curves;
  PlotRange range;
};

// Smallest common range of the plots.
PlotRange range_of(const std::vector<const Plot*>& plots);

// At most `max_count` round numbers in [low, high], 1, 2 or 5 times a power of ten apart.
std::vector<double> round_ticks(double low, double high, int max_count);

class PlotStrip {
 public:
  // The plots side by side.
  PlotStrip(std::vector<Plot> plots, int width, int height);
  Image at(double t) const;  // [s]

 private:
  struct Frame {  // of the axes, in pixels, y down
    Eigen::Vector2d low, high;
    PlotRange range;
    Eigen::Vector2d pixel(double t, double y) const;
  };
  std::vector<Plot> plots_;
  std::vector<Frame> frames_;
  double size_px_;  // of letters
  Image ground_;
};

}  // namespace twinarm
