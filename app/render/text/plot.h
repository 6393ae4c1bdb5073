// PlotStrip: curves over time that run under a picture, with a cursor at the instant that is shown.
//
// For reports there is gnuplot; here a strip is wanted for each of thousands of frames, in the
// picture's own letters. Axes and curves are drawn once, the cursor for each frame.
#pragma once

#include <string>
#include <vector>

#include "app/render/list/draw_list.h"
#include "app/render/list/image.h"

namespace twinarm {

struct PlotCurve {
  std::string name;
  Color color;
  std::vector<double> y;     // one for each time; what is not finite leaves a gap
  bool from_lowest = false;  // as in CurveSample
};

struct PlotRange {
  double t_low = 0, t_high = 0;  // [s]
  double y_low = 0, y_high = 0;  // holds 0
};

struct Plot {
  std::string title;      // what, and its unit
  std::vector<double> t;  // ascending [s]
  std::vector<PlotCurve> curves;
  PlotRange range;
};

// The smallest that holds all curves of the plots, which are to be compared.
PlotRange range_of(const std::vector<const Plot*>& plots);

// Round numbers inside of [low, high], at most `most` of them, that are 1, 2 or 5 times a power of
// ten apart.
std::vector<double> round_ticks(double low, double high, int most);

class PlotStrip {
 public:
  // The plots side by side in one picture.
  PlotStrip(std::vector<Plot> plots, int width, int height);
  Image at(double t) const;  // [s]

 private:
  struct Frame {  // of the curves, in pixels; y down
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
