// Target robots and the previous branch, translucent where they differ from the bodies; trails of
// the centres of mass of free bodies and last links.

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

// Coincident surfaces are not drawn: they would flicker.
bool is_apart(const Pose& a, const Pose& b, double length) {
  return (a.p - b.p).norm() > 1e-4 * length || (a.R - b.R).norm() > 1e-4;
}

bool add_before(SceneView& view, const std::vector<Pose>& before, const std::vector<Pose>& now,
                const Vector3& offset_W) {
  bool any = false;
  for (const ScenePart& part : view.cast.parts) {
    if (part.body == 0 || part.body >= before.size()) continue;
    const Pose& X_WL = before[part.body];
    if (!is_apart(X_WL, now[part.body], view.scales.length)) continue;
    const OfBody mark(view.list, part.body);
    Pose X_WM = X_WL * part.X_LM;
    X_WM.p += offset_W;
    add_mesh_instance(view.list, part.mesh, X_WM, palette::kBefore, part.scale);
    any = true;
  }
  return any;
}

void show_targets(SceneView& view, const Snapshot& snapshot) {
  bool any = false;
  for (const ShownTargetRobot& target : snapshot.targets)
    for (const ScenePart& part : view.cast.parts) {
      if (part.robot != static_cast<int>(target.robot)) continue;
      const Pose& X_WL = target.X_WL[part.body];
      if (!is_apart(X_WL, snapshot.k.X_WL[part.body], view.scales.length)) continue;
      const OfBody mark(view.list, part.body);
      add_mesh_instance(view.list, part.mesh, X_WL * part.X_LM, palette::kTargetRobot, part.scale);
      any = true;
    }
  if (any)
    view.list.legend.push_back(
        {palette::kTargetRobotSwatch, "target robot: moved by the input, massless"});
}

void show_before(SceneView& view, const Snapshot& snapshot) {
  bool any = add_before(view, snapshot.before, snapshot.k.X_WL, Vector3::Zero());
  for (const ShownVariant& lane : snapshot.variants)
    if (add_before(view, lane.before, lane.X_WL, lane.offset_W)) any = true;
  if (any) view.list.legend.push_back({palette::kBeforeSwatch, "previous branch"});
}

constexpr std::size_t kMaxPieces = 160;

bool has_child(const Model<double>& model, std::size_t body) {
  const auto is_child = [&](int parent) { return parent == static_cast<int>(body); };
  return std::any_of(model.parent.begin() + 1, model.parent.end(), is_child);
}

void show_trails(SceneView& view, const Snapshot& snapshot) {
  const auto& t = view.trace.t;
  const auto end =
      static_cast<std::size_t>(std::ranges::upper_bound(t, snapshot.x.t + 1e-9) - t.begin());
  const auto begin = static_cast<std::size_t>(
      std::ranges::lower_bound(t, snapshot.x.t - view.trace.span) - t.begin());
  if (end < begin + 2) return;
  const std::size_t stride = std::max<std::size_t>(1, (end - begin) / kMaxPieces);
  std::size_t shown = 0;
  for (std::size_t body = 1; body < view.model->parent.size(); ++body) {
    if (has_child(*view.model, body)) continue;
    const OfBody mark(view.list, body);
    const Color color = palette::body(shown++);
    const Color dark{0.6f * color.r, 0.6f * color.g, 0.6f * color.b, 1.0f};
    Vector3 from = view.trace.p_Wc[begin][body];
    const auto draw_to = [&](const Vector3& to) {
      if ((to - from).norm() < 2e-3 * view.scales.length) return;
      add_rod(view.list, from, to, 0.35 * view.scales.radius(), dark);
      from = to;
    };
    for (std::size_t i = begin + stride; i < end; i += stride) draw_to(view.trace.p_Wc[i][body]);
    draw_to(com_of(*view.model, snapshot.k, body));
  }
  view.list.legend.push_back({{0.3f, 0.3f, 0.3f, 1.0f}, "path of a centre of mass"});
}

}  // namespace

Overlays target_robots_overlay() {
  return {{10,
           "targets",
           "target robot that the couplings follow",
           show_targets,
           {.seen_through = false, .shown = Overlay::Shown::everywhere}},
          {230,
           "earlier-run",
           "bodies of the previous branch",
           show_before,
           {.seen_through = false, .is_live = true}},
          {30, "trails", "trails of bodies", show_trails, {.seen_through = false}}};
}

}  // namespace twinarm
