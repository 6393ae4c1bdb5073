// Axes of joints, and of links and bodies.
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

bool has_one_axis(JointType type) {
  return facts_of(type).axis == AxisUse::motion;
}
bool turns(JointType type) {
  return has_one_axis(type) && !is_translational(type);
}

const Color kTurns{0.55f, 0.20f, 0.60f, 1.0f}, kSlides{0.05f, 0.45f, 0.55f, 1.0f};

void draw_axis(SceneView& stage, const Snapshot& moment, std::size_t body) {
  const Vector3 p = moment.k.X_WL[body].p, z = moment.k.R_WB[body].col(2);
  const double reach = 0.17 * stage.scales.length, radius = 0.6 * stage.scales.radius();
  if (turns(stage.model->joint[body])) {
    add_arrow(stage.list, p - reach * z, p + reach * z, radius, kTurns);
    add_turn_arrow(stage.list, p + 0.7 * reach * z, z, 0.3 * reach, 0.7 * radius, kTurns);
  } else {
    add_arrow(stage.list, p - reach * z, p + reach * z, 1.3 * radius, kSlides);
  }
  add_label(stage.list, p + reach * z, stage.model->joint_name[body], {10, -8}, 13);
}

void draw_frame(DrawList& list, const Pose& X_W, double length, double radius) {
  for (int c = 0; c < 3; ++c)
    add_arrow(list, X_W.p, X_W.p + length * X_W.R.col(c), radius,
              palette::kAxes[static_cast<std::size_t>(c)]);
}

void show_joints(SceneView& stage, const Snapshot& moment) {
  bool any_turns = false, any_slides = false;
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i) {
    const JointType type = stage.model->joint[i];
    if (!has_one_axis(type)) continue;
    (turns(type) ? any_turns : any_slides) = true;
    const OfBody mark(stage.list, i);
    draw_axis(stage, moment, i);
  }
  if (any_turns) stage.list.legend.push_back({kTurns, "joint that turns: axis and sense"});
  if (any_slides) stage.list.legend.push_back({kSlides, "joint that slides"});
}

void show_frames(SceneView& stage, const Snapshot& moment) {
  const double length = 0.12 * stage.scales.length, radius = 0.45 * stage.scales.radius();
  for (std::size_t i = 1; i < stage.model->parent.size(); ++i) {
    const OfBody mark(stage.list, i);
    draw_frame(stage.list, moment.k.X_WL[i], length, radius);
  }
  const char* names[] = {"x", "y", "z"};
  for (std::size_t c = 0; c < 3; ++c)
    stage.list.legend.push_back(
        {palette::kAxes[c], std::string(names[c]) + " of links and bodies"});
}

}  // namespace

Overlays joints_overlay() {
  return {{.place = 80, .name = "joints", .what = "axes of joints", .add = show_joints},
          {.place = 90, .name = "frames", .what = "axes of links and bodies", .add = show_frames}};
}

}  // namespace twinarm
