// Spring-dampers between two points as springs, the others as force or torque on the link, coloured
// by force over the largest force of the run; the mouse spring.

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

constexpr double kMinForceShare = 1e-3;  // of the largest
constexpr double kMinArrow = 0.005;      // of the weight; of the weight times the scene's radius

void draw_spring(SceneView& view, const ShownCouplingForce& coupling, const Color& color) {
  const double radius = 3 * view.scales.radius();
  add_spring(view.list, coupling.p_D, coupling.p_K, radius, color);
  add_sphere(view.list, coupling.p_D, 1.15 * radius, color);
  add_sphere(view.list, coupling.p_K, 1.15 * radius, palette::kTargetRobotSwatch);
  add_label(view.list, 0.5 * (coupling.p_D + coupling.p_K), with_unit(coupling.force_W.norm(), "N"),
            {24, -34});
}

void draw_coupling_force(SceneView& view, const ShownCouplingForce& coupling, const Color& color) {
  const double size = coupling.force_W.norm(), radius = view.scales.radius();
  if (coupling.kind == ShownCouplingForce::Kind::force) {
    const double scale = view.scales.metres_per(view.scales.force);
    add_arrow(view.list, coupling.p_D, coupling.p_D + scale * coupling.force_W, radius, color);
    add_label(view.list, coupling.p_D, with_unit(size, "N"), {24, -24});
  } else {
    const double share = std::max(0.3, std::sqrt(size / view.scales.couple));
    add_rotation_arrow(view.list, coupling.p_D, coupling.force_W, 0.16 * share * view.scales.length,
                       radius, color);
    add_label(view.list, coupling.p_D, with_unit(size, "N m"), {24, -24});
  }
}

void show_couplings(SceneView& view, const Snapshot& snapshot) {
  bool any_force = false, any_torque = false;
  const Model<double>& model = *view.model;
  const double weight = total_motion(model, snapshot.k).mass * to_eigen(model.gravity).norm();
  for (const ShownCouplingForce& coupling : snapshot.coupling_forces) {
    const bool is_force = coupling.kind == ShownCouplingForce::Kind::force;
    const double largest = is_force ? view.scales.force : view.scales.couple;
    const double size = coupling.force_W.norm();
    // Forces far below the weight are not drawn as arrows.
    const double smallest =
        coupling.has_ends ? 0 : kMinArrow * weight * (is_force ? 1 : view.scales.length);
    if (largest < smallest) continue;
    (is_force ? any_force : any_torque) = true;
    if (!(largest > 0) || size < std::max(smallest, kMinForceShare * largest)) continue;
    const Color color = palette::ramp(size / largest);
    const OfBody mark(view.list, coupling.body);
    if (coupling.has_ends)
      draw_spring(view, coupling, color);
    else
      draw_coupling_force(view, coupling, color);
  }
  std::vector<LegendLine>& legend = view.list.legend;
  std::vector<Color> bar;
  for (int k = 0; k <= 4; ++k) bar.push_back(palette::ramp(0.25 * k));
  if (any_force)
    legend.push_back(
        {palette::ramp(1), "coupling force: 0 to", " " + with_unit(view.scales.force, "N"), bar});
  if (any_torque)
    legend.push_back({palette::ramp(1), "coupling torque: 0 to",
                      " " + with_unit(view.scales.couple, "N m"), bar});
}

void show_mouse_spring(SceneView& view, const Snapshot& snapshot) {
  if (!snapshot.mouse_spring) return;
  const ShownMouseSpring& spring = *snapshot.mouse_spring;
  const double radius = 2.4 * view.scales.radius();
  const OfBody mark(view.list, spring.body);
  add_spring(view.list, spring.p_W, spring.goal_W, radius, palette::kMouse);
  add_sphere(view.list, spring.p_W, 1.2 * radius, palette::kMouse);
  add_sphere(view.list, spring.goal_W, 1.2 * radius, palette::kMouse);
  add_label(view.list, spring.goal_W, with_unit(spring.force_W.norm(), "N"), {18, -20});
  view.list.legend.push_back({palette::kMouse, "mouse spring"});
}

}  // namespace

Overlays couplings_overlay() {
  return {{40,
           "couplings",
           "spring-dampers, coloured by force",
           show_couplings,
           {.shown = Overlay::Shown::everywhere}},
          {220, "mouse-spring", "mouse spring on a body", show_mouse_spring, {.is_live = true}}};
}

}  // namespace twinarm
