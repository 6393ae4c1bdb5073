// What bodies do to one another: of each pair that touches the resultant of all its points, at
// their centre of pressure, with its value; couples of torsional and rolling friction as turns.
#include <algorithm>
#include <functional>
#include <vector>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxLabels = 14;
constexpr double kMinForce = 0.004;  // of the largest

// The smallest force of the `most` largest.
double min_of_largest(const std::vector<PairForce>& pairs, std::size_t most) {
  std::vector<double> sizes;
  for (const PairForce& pair : pairs) sizes.push_back(pair.force.norm());
  std::ranges::sort(sizes, std::greater<>());
  return sizes.empty() ? 0 : sizes[std::min(most, sizes.size()) - 1];
}

void show_forces(SceneView& stage, const Snapshot& moment) {
  const std::vector<PairForce> pairs = pair_forces(moment);
  if (pairs.empty()) return;
  const double scale = stage.scales.metres_per(stage.scales.contact_force);
  const double radius = stage.scales.radius();
  const double min_told = min_of_largest(pairs, kMaxLabels);
  for (const PairForce& pair : pairs) {
    const double size = pair.force.norm();
    if (!(size > kMinForce * stage.scales.contact_force)) continue;
    const Vector3 tip = pair.point + scale * pair.force;
    const OfBody mark(stage.list, pair.body_b);
    add_arrow(stage.list, pair.point, tip, radius, palette::kForce);
    if (size >= min_told) add_label(stage.list, pair.point, with_unit(size, "N"), {30, -6});
    if (pair.couple.norm() > 0)
      add_turn_arrow(stage.list, pair.point, pair.couple, 0.1 * stage.scales.length, 0.7 * radius,
                     palette::kForce);
  }
  stage.list.legend.push_back(
      {palette::kForce, "contact force", scale_words(scale, stage.scales.length, "N")});
}

void show_gravity(SceneView& stage, const Snapshot& moment) {
  const Vector3 g = to_eigen(stage.model->gravity);
  double heaviest = 0;
  for (const auto& I : stage.model->I) heaviest = std::max(heaviest, I.m * g.norm());
  const double scale = stage.scales.metres_per(std::max(heaviest, stage.scales.contact_force));
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i) {
    const double m = stage.model->I[i].m;
    if (!(m * g.norm() > 0)) continue;
    const Vector3 c = com_of(*stage.model, moment.k, i);
    const OfBody mark(stage.list, i);
    add_arrow(stage.list, c, c + scale * m * g, stage.scales.radius(), palette::kGravity);
  }
  stage.list.legend.push_back(
      {palette::kGravity, "weight", scale_words(scale, stage.scales.length, "N")});
}

}  // namespace

Overlays forces_overlay() {
  return {{.place = 60,
           .name = "forces",
           .what = "of contacts, by pair of bodies, with values",
           .add = show_forces},
          {.place = 70, .name = "gravity", .what = "weights", .add = show_gravity}};
}

}  // namespace twinarm
