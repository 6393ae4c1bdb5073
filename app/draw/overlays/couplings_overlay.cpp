// Spring-dampers: those between two points as springs that stretch, the others as the couple or
// force that they put on the link. Coloured by the size of the pull, in share of the run's largest.
#include <algorithm>
#include <cmath>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

constexpr double kMinPull = 1e-3;    // of the largest
constexpr double kMinArrow = 0.005;  // of the weight, and of that at half the scene's extent

struct DrawnPulls {
  bool force = false, couple = false;
};

void draw_spring(SceneView& stage, const ShownCouplingForce& pull, const Color& color) {
  const double radius = 3 * stage.scales.radius();
  add_spring(stage.list, pull.p_D, pull.p_K, radius, color);
  add_sphere(stage.list, pull.p_D, 1.15 * radius, color);
  add_sphere(stage.list, pull.p_K, 1.15 * radius, palette::kGhostSwatch);
  add_label(stage.list, 0.5 * (pull.p_D + pull.p_K), with_unit(pull.pull_W.norm(), "N"), {24, -34});
}

void draw_pull(SceneView& stage, const ShownCouplingForce& pull, const Color& color) {
  const double size = pull.pull_W.norm(), radius = stage.scales.radius();
  if (pull.kind == ShownCouplingForce::Kind::force) {
    const double scale = stage.scales.metres_per(stage.scales.force);
    add_arrow(stage.list, pull.p_D, pull.p_D + scale * pull.pull_W, radius, color);
    add_label(stage.list, pull.p_D, with_unit(size, "N"), {24, -24});
  } else {
    const double share = std::max(0.3, std::sqrt(size / stage.scales.couple));
    add_turn_arrow(stage.list, pull.p_D, pull.pull_W, 0.16 * share * stage.scales.length, radius,
                   color);
    add_label(stage.list, pull.p_D, with_unit(size, "N m"), {24, -24});
  }
}

void add_ramp_legend(SceneView& stage, const DrawnPulls& drawn) {
  if (drawn.force) {
    stage.list.legend.push_back({palette::ramp(0), "spring-damper that pulls little"});
    stage.list.legend.push_back(
        {palette::ramp(1), "most in this run", ": " + with_unit(stage.scales.force, "N")});
  }
  if (drawn.couple)
    stage.list.legend.push_back({palette::ramp(1), "most couple of a spring-damper",
                                 ": " + with_unit(stage.scales.couple, "N m")});
}

void show_couplings(SceneView& stage, const Snapshot& moment) {
  DrawnPulls drawn;
  const Model<double>& model = *stage.model;
  const double weight = total_motion(model, moment.k).mass * to_eigen(model.gravity).norm();
  for (const ShownCouplingForce& pull : moment.pulls) {
    const bool is_force = pull.kind == ShownCouplingForce::Kind::force;
    const double largest = is_force ? stage.scales.force : stage.scales.couple;
    const double size = pull.pull_W.norm();
    // What holds a joint against next to nothing must not look like what moves the robot.
    const double least =
        pull.has_ends ? 0 : kMinArrow * weight * (is_force ? 1 : stage.scales.length);
    if (largest < least) continue;
    (is_force ? drawn.force : drawn.couple) = true;
    if (!(largest > 0) || size < std::max(least, kMinPull * largest)) continue;
    const Color color = palette::ramp(size / largest);
    const OfBody mark(stage.list, pull.body);
    if (pull.has_ends)
      draw_spring(stage, pull, color);
    else
      draw_pull(stage, pull, color);
  }
  add_ramp_legend(stage, drawn);
}

}  // namespace

Overlays couplings_overlay() {
  return {{.place = 40,
           .name = "couplings",
           .what = "spring-dampers, coloured by their force",
           .add = show_couplings,
           .shown = Overlay::Shown::everywhere}};
}

}  // namespace twinarm
