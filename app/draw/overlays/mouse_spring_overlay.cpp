// The mouse's spring: from a body's point to where it is pulled, with the force.
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

void show_pull(SceneView& stage, const Snapshot& moment) {
  if (!moment.grip) return;
  const ShownMouseSpring& grip = *moment.grip;
  const double radius = 2.4 * stage.scales.radius();
  const OfBody mark(stage.list, grip.body);
  add_spring(stage.list, grip.p_W, grip.goal_W, radius, palette::kMouse);
  add_sphere(stage.list, grip.p_W, 1.2 * radius, palette::kMouse);
  add_sphere(stage.list, grip.goal_W, 1.2 * radius, palette::kMouse);
  add_label(stage.list, grip.goal_W, with_unit(grip.force_W.norm(), "N"), {18, -20});
  stage.list.legend.push_back({palette::kMouse, "pulled by the mouse"});
}

}  // namespace

Overlays mouse_spring_overlay() {
  return {{.place = 220,
           .name = "pull",
           .what = "the spring by which the mouse pulls at a body",
           .add = show_pull,
           .is_live = true}};
}

}  // namespace twinarm
