// Bars at the right: kinetic energy, potential above the run's minimum, energy of springs.

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
  // Rounding errors are shown as 0.
  const double shown_value = std::abs(bar.value) > 1e-9 * largest ? bar.value : 0;
  list.labels.push_back({.text = std::string(bar.name) + ": " + with_unit(shown_value, "J"),
                         .anchor = Label::Anchor::screen,
                         .offset_px = {-kRight - kWidth, top_px},
                         .size_px = 14});
}

void show_energy(SceneView& view, const Snapshot& snapshot) {
  const Scales& s = view.scales;
  const double largest = std::max({s.kinetic, s.elastic, s.highest_potential - s.lowest_potential});
  std::array<Bar, 4> bars{
      Bar{"kinetic", snapshot.kinetic, palette::body(0)},
      Bar{"potential, above lowest", snapshot.potential - s.lowest_potential, palette::body(1)},
      Bar{"in springs", snapshot.elastic, palette::body(2)}, Bar{"sum", 0, palette::body(3)}};
  bars[3].value = bars[0].value + bars[1].value + bars[2].value;
  double top = 60;
  for (const Bar& bar : bars) {
    if (bar.name == std::string("in springs") && snapshot.coupling_forces.empty()) continue;
    draw_bar(view.list, bar, top, 1.02 * largest);
    top += 44;
  }
}

}  // namespace

Overlays energy_overlay() {
  return {{150, "energy", "energy bars", show_energy}};
}

}  // namespace twinarm
