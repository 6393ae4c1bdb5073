// Where centres of mass came from: of free bodies and of the last links of robots, up to now.
#include <algorithm>

#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"

namespace twinarm {
namespace {

constexpr std::size_t kMaxPieces = 160;

bool has_child(const Model<double>& model, std::size_t body) {
  const auto is_child = [&](int parent) { return parent == static_cast<int>(body); };
  return std::any_of(model.parent.begin() + 1, model.parent.end(), is_child);
}

void show_trails(SceneView& stage, const Snapshot& moment) {
  const auto& t = stage.trace.t;
  const auto end =
      static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), moment.x.t + 1e-9) - t.begin());
  const auto begin = static_cast<std::size_t>(
      std::lower_bound(t.begin(), t.end(), moment.x.t - stage.trace.span) - t.begin());
  if (end < begin + 2) return;
  const std::size_t stride = std::max<std::size_t>(1, (end - begin) / kMaxPieces);
  std::size_t shown = 0;
  for (std::size_t body = 1; body < stage.model->parent.size(); ++body) {
    if (has_child(*stage.model, body)) continue;
    const OfBody mark(stage.list, body);
    const Color color = palette::body(shown++);
    const Color dark{0.6f * color.r, 0.6f * color.g, 0.6f * color.b, 1.0f};
    Vector3 from = stage.trace.p_Wc[begin][body];
    const auto go_to = [&](const Vector3& to) {
      if ((to - from).norm() < 2e-3 * stage.scales.length) return;
      add_rod(stage.list, from, to, 0.35 * stage.scales.radius(), dark);
      from = to;
    };
    for (std::size_t i = begin + stride; i < end; i += stride) go_to(stage.trace.p_Wc[i][body]);
    go_to(com_of(*stage.model, moment.k, body));
  }
  stage.list.legend.push_back({{0.3f, 0.3f, 0.3f, 1.0f}, "path of a centre of mass"});
}

}  // namespace

Overlays trails_overlay() {
  return {{.place = 30,
           .name = "trails",
           .what = "where bodies came from",
           .add = show_trails,
           .seen_through = false}};
}

}  // namespace twinarm
