// Centres of mass, and momentum of the whole.
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

const Color kDark{0.10f, 0.10f, 0.12f, 1.0f}, kWhole{0.95f, 0.85f, 0.20f, 1.0f};

void show_com(SceneView& stage, const Snapshot& moment) {
  const double radius = 1.6 * stage.scales.radius();
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i)
    if (stage.model->I[i].m > 0) {
      const OfBody mark(stage.list, i);
      add_sphere(stage.list, com_of(*stage.model, moment.k, i), radius, kDark);
    }
  const TotalMotion total = total_motion(*stage.model, moment.k);
  if (!(total.mass > 0)) return;
  add_sphere(stage.list, total.com_W, 1.8 * radius, kWhole);
  add_label(stage.list, total.com_W, with_unit(total.mass, "kg"), {22, -22});
  stage.list.legend.push_back({kDark, "centre of mass of a body"});
  stage.list.legend.push_back({kWhole, "centre of mass of the whole"});
}

void show_momentum(SceneView& stage, const Snapshot& moment) {
  const TotalMotion total = total_motion(*stage.model, moment.k);
  const double scale = stage.scales.metres_per(stage.scales.momentum);
  const double radius = 1.4 * stage.scales.radius();
  const double size = total.linear.norm(), spin = total.angular.norm();
  // What rounding leaves of a body that stands: a billionth of its length a second.
  const double least = 1e-9 * total.mass * stage.scales.length;
  if (size > least) {
    const Vector3 tip = total.com_W + scale * total.linear;
    add_arrow(stage.list, total.com_W, tip, radius, palette::kLinear);
    add_label(stage.list, tip, with_unit(size, "kg m/s"), {14, -6});
  }
  stage.list.legend.push_back({palette::kLinear, "momentum",
                               stage.scales.momentum > least
                                   ? scale_words(scale, stage.scales.length, "kg m/s")
                                   : ": none"});
  if (spin > least * stage.scales.length) {
    add_turn_arrow(stage.list, total.com_W, total.angular, 0.25 * stage.scales.length, radius,
                   palette::kAngular);
    add_label(stage.list, total.com_W, with_unit(spin, "kg m\u00b2/s"), {30, 36});
  }
  stage.list.legend.push_back({palette::kAngular, "angular momentum about the centre of mass"});
}

}  // namespace

Overlays momentum_overlay() {
  return {{.place = 100, .name = "com", .what = "centres of mass", .add = show_com},
          {.place = 110,
           .name = "momentum",
           .what = "of the whole, linear and angular",
           .add = show_momentum}};
}

}  // namespace twinarm
