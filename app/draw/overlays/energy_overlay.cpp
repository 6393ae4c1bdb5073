// Bars of energies, at the right: kinetic, potential above the lowest of the run, in springs.
#include <algorithm>
#include <array>
#include <cmath>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

struct Bar {
  const char* name;
  double value;
  Color color;
};

void draw_bar(DrawList& list, const Bar& bar, double top_px, double largest) {
  constexpr double kWidth = 210, kHeight = 12, kRight = 24;
  const double share = largest > 0 ? std::clamp(bar.value / largest, 0.0, 1.0) : 0;
  const Eigen::Vector2d low(-kRight - kWidth, top_px + 9);
  list.bars.push_back({low, {kWidth, kHeight}, {0.97f, 0.98f, 0.99f, 0.62f}});
  list.bars.push_back({low, {share * kWidth, kHeight}, bar.color});
  // What rounding has left is nothing.
  const double told = std::abs(bar.value) > 1e-9 * largest ? bar.value : 0;
  list.labels.push_back({.text = std::string(bar.name) + ": " + with_unit(told, "J"),
                         .anchor = Label::Anchor::screen,
                         .offset_px = {-kRight - kWidth, top_px},
                         .size_px = 14});
}

void show_energy(SceneView& stage, const Snapshot& moment) {
  const Scales& s = stage.scales;
  const double largest = std::max({s.kinetic, s.elastic, s.highest_potential - s.lowest_potential});
  std::array<Bar, 4> bars{
      Bar{"kinetic", moment.kinetic, palette::body(0)},
      Bar{"potential, above lowest", moment.potential - s.lowest_potential, palette::body(1)},
      Bar{"in springs", moment.elastic, palette::body(2)}, Bar{"sum", 0, palette::body(3)}};
  bars[3].value = bars[0].value + bars[1].value + bars[2].value;
  double top = 60;
  for (const Bar& bar : bars) {
    if (bar.name == std::string("in springs") && moment.pulls.empty()) continue;
    draw_bar(stage.list, bar, top, 1.02 * largest);
    top += 44;
  }
}

}  // namespace

Overlays energy_overlay() {
  return {{.place = 150, .name = "energy", .what = "bars of energies", .add = show_energy}};
}

}  // namespace twinarm
