// The KVR beside the DVR, and the run that was left beside the one that goes on: translucent, where
// the two do not coincide.
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

// Surfaces at the same place would flicker.
bool is_apart(const Pose& a, const Pose& b, double length) {
  return (a.p - b.p).norm() > 1e-4 * length || (a.R - b.R).norm() > 1e-4;
}

bool add_before(SceneView& stage, const std::vector<Pose>& before, const std::vector<Pose>& now,
                const Vector3& offset_W) {
  bool any = false;
  for (const ScenePart& part : stage.cast.parts) {
    if (part.body == 0 || part.body >= before.size()) continue;
    const Pose& X_WL = before[part.body];
    if (!is_apart(X_WL, now[part.body], stage.scales.length)) continue;
    const OfBody mark(stage.list, part.body);
    Pose X_WM = X_WL * part.X_LM;
    X_WM.p += offset_W;
    add_mesh_instance(stage.list, part.mesh, X_WM, palette::kBefore, part.scale);
    any = true;
  }
  return any;
}

void show_twins(SceneView& stage, const Snapshot& moment) {
  bool any = false;
  for (const ShownTargetRobot& twin : moment.twins)
    for (const ScenePart& part : stage.cast.parts) {
      if (part.robot != static_cast<int>(twin.robot)) continue;
      const Pose& X_WL = twin.X_WL[part.body];
      if (!is_apart(X_WL, moment.k.X_WL[part.body], stage.scales.length)) continue;
      const OfBody mark(stage.list, part.body);
      add_mesh_instance(stage.list, part.mesh, X_WL * part.X_LM, palette::kGhost, part.scale);
      any = true;
    }
  if (any)
    stage.list.legend.push_back(
        {palette::kGhostSwatch, "kinematic twin: moved by the hand, has no mass"});
}

void show_before(SceneView& stage, const Snapshot& moment) {
  bool any = add_before(stage, moment.before, moment.k.X_WL, Vector3::Zero());
  for (const ShownVariant& lane : moment.lanes)
    if (add_before(stage, lane.before, lane.X_WL, lane.offset_W)) any = true;
  if (any) stage.list.legend.push_back({palette::kBeforeSwatch, "the run that was left"});
}

}  // namespace

Overlays target_robots_overlay() {
  return {{.place = 10,
           .name = "ghost",
           .what = "the kinematic twin of a robot, that couplings follow",
           .add = show_twins,
           .seen_through = false,
           .shown = Overlay::Shown::everywhere},
          {.place = 230,
           .name = "before",
           .what = "the bodies of the run that was left for this one",
           .add = show_before,
           .seen_through = false,
           .is_live = true}};
}

}  // namespace twinarm
