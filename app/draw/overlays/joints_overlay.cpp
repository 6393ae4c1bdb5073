// Axes of joints; frames and names of links and bodies.
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

bool has_one_axis(JointType type) {
  return facts_of(type).axis == AxisUse::motion;
}
bool is_rotational(JointType type) {
  return has_one_axis(type) && !is_translational(type);
}

const Color kRotational{0.55f, 0.20f, 0.60f, 1.0f}, kTranslational{0.05f, 0.45f, 0.55f, 1.0f};

void draw_axis(SceneView& view, const Snapshot& snapshot, std::size_t body) {
  const Vector3 p = snapshot.k.X_WL[body].p, z = snapshot.k.R_WB[body].col(2);
  const double reach = 0.17 * view.scales.length, radius = 0.6 * view.scales.radius();
  if (is_rotational(view.model->joint[body])) {
    add_arrow(view.list, p - reach * z, p + reach * z, radius, kRotational);
    add_rotation_arrow(view.list, p + 0.7 * reach * z, z, 0.3 * reach, 0.7 * radius, kRotational);
  } else {
    add_arrow(view.list, p - reach * z, p + reach * z, 1.3 * radius, kTranslational);
  }
  add_label(view.list, p + reach * z, view.model->joint_name[body], {10, -8}, 13);
}

void show_joints(SceneView& view, const Snapshot& snapshot) {
  bool any_rotational = false, any_translational = false;
  for (std::size_t i = 1; i < view.model->parent.size(); ++i) {
    const JointType type = view.model->joint[i];
    if (!has_one_axis(type)) continue;
    (is_rotational(type) ? any_rotational : any_translational) = true;
    const OfBody mark(view.list, i);
    draw_axis(view, snapshot, i);
  }
  if (any_rotational) view.list.legend.push_back({kRotational, "rotational joint: axis and sense"});
  if (any_translational) view.list.legend.push_back({kTranslational, "prismatic joint"});
}

void show_frames(SceneView& view, const Snapshot& snapshot) {
  const double length = 0.12 * view.scales.length, radius = 0.45 * view.scales.radius();
  for (std::size_t i = 1; i < view.model->parent.size(); ++i) {
    const OfBody mark(view.list, i);
    const Pose& X_WL = snapshot.k.X_WL[i];
    for (int c = 0; c < 3; ++c)
      add_arrow(view.list, X_WL.p, X_WL.p + length * X_WL.R.col(c), radius,
                palette::kAxes[static_cast<std::size_t>(c)]);
  }
  const char* names[] = {"x", "y", "z"};
  for (std::size_t c = 0; c < 3; ++c)
    view.list.legend.push_back({palette::kAxes[c], std::string(names[c]) + " of links and bodies"});
}

void show_labels(SceneView& view, const Snapshot& snapshot) {
  for (std::size_t i = 1; i < view.model->parent.size(); ++i)
    add_label(view.list, com_of(*view.model, snapshot.k, i), view.model->body_name[i], {26, -22},
              14);
}

}  // namespace

Overlays joints_overlay() {
  return {{80, "joints", "joint axes", show_joints},
          {90, "frames", "frames of links and bodies", show_frames},
          {140, "labels", "names of bodies", show_labels}};
}

}  // namespace twinarm
