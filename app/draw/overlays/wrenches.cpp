
#include "app/draw/overlays/overlays.h"
#include "app/draw/palette.h"
#include "app/inspect/force_balance.h"

namespace twinarm {
namespace {

constexpr double kMinShare = 0.01;  // of the largest force or torque

struct Kind {
  const char* label;  // in the legend
  Color color;
  bool is_shown = false;
};

// Once for equal values at one point, as of a joint and its reaction.
void add_value(SceneView& view, const Vector3& p_W, const std::string& text, double y) {
  const auto is_same = [&](const Label& other) {
    return other.text == text && (other.p_W - p_W).norm() < 1e-3 * view.scales.length;
  };
  if (std::ranges::none_of(view.list.labels, is_same)) add_label(view.list, p_W, text, {26, y});
}

}  // namespace

void add_wrenches(SceneView& view, const Inspection& in) {
  std::array<Kind, 5> kinds{{{"weight", palette::kGravity},
                             {"of the parent, through the joint", palette::kLinear},
                             {"reaction of a child", palette::kBeforeSwatch},
                             {"contact", palette::kForce},
                             {"coupling, constraint, applied", palette::kMouse}}};
  struct Part {
    Kind* kind;
    std::size_t body;
    Vector3 p_W, force, torque;
  };
  std::vector<Part> parts;
  double force = 0, torque = 0;
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    const Vector3 com = com_of(in.model, in.k, i), origin = in.k.X_WL[i].p;
    const std::vector<NamedWrench> wrenches = balance_of(in, i).wrenches;
    auto next = wrenches.begin();  // in the order of balance_of(), without inertia
    const auto add = [&](Kind& kind, const Vector3& p) {
      const Vector3 f = next->force, n = next++->torque - (p - origin).cross(f);
      if (!f.allFinite() || !n.allFinite()) return;
      parts.push_back({&kind, i, p, f, n});
      force = std::max(force, f.norm());
      torque = std::max(torque, n.norm());
    };
    add(kinds[0], com);
    add(kinds[1], origin);
    for (const std::size_t child : in.children(i)) add(kinds[2], in.k.X_WL[child].p);
    for (const AppliedForce& actor : in.actors)
      for (const AppliedForce::OnBody& on : actor.bodies)
        if (on.body == i) add(kinds[actor.normal_W ? 3 : 4], actor.point_W.value_or(com));
  }
  const double length = view.scales.length, scale = view.scales.metres_per(force);
  const double min_torque = std::max(kMinShare * torque, 1e-6 * force * length);  // rounding
  const std::size_t first = view.list.instances.size();
  for (const Part& part : parts) {
    const OfBody mark(view.list, part.body);
    const double f = part.force.norm(), n = part.torque.norm();
    if (f > kMinShare * force) {
      add_arrow(view.list, part.p_W, part.p_W + scale * part.force, view.scales.radius(),
                part.kind->color);
      add_value(view, part.p_W, with_unit(f, "N"), -6);
    }
    if (n > min_torque) {
      add_rotation_arrow(view.list, part.p_W, part.torque, 0.08 * length,
                         0.7 * view.scales.radius(), part.kind->color);
      add_value(view, part.p_W, with_unit(n, "N m"), 14);
    }
    part.kind->is_shown |= f > kMinShare * force || n > min_torque;
  }
  for (std::size_t i = first; i < view.list.instances.size(); ++i)
    view.list.instances[i].seen_through = true;
  std::string words = scale_words(scale, length, "N");
  for (const Kind& kind : kinds)
    if (kind.is_shown)
      view.list.legend.push_back({kind.color, kind.label, std::exchange(words, "")});
}

}  // namespace twinarm
