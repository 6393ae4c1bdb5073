#include "app/run/impact_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace twinarm {
namespace {

constexpr double kReported = 0.01;  // [rad]
constexpr double kMinGap = 1e-6;    // of a flight to the impact [m]

}  // namespace

void ImpactNormals::look(const ContactConstraints& contacts, double h) {
  const ContactBodies& bodies = contacts.bodies();
  // Both lists are sorted by this.
  const auto key = [](const auto& at) { return std::tuple(at.a, at.b, at.feature); };
  for (const ContactPoint& p : contacts.points()) {
    const auto i = std::ranges::lower_bound(impacts_, key(p.contact), {}, key);
    if (i == impacts_.end() || key(*i) != key(p.contact)) continue;
    const double turn = (p.contact.n_W - i->n_W).norm();
    if (turn <= turn_) continue;
    turn_ = turn;
    pair_ = bodies.geometry(i->a).name + "-" + bodies.geometry(i->b).name;
  }
  impacts_.clear();
  for (const ContactPoint& p : contacts.points()) {
    const Vector3 impact = p.impulse_W - h * p.force_W;
    if (p.contact.depth < -kMinGap && impact.norm() > 1e-9 * p.impulse_W.norm())
      impacts_.push_back({p.contact.a, p.contact.b, p.contact.feature, p.contact.n_W});
  }
}

std::string ImpactNormals::warning() const {
  if (turn_ <= kReported) return "";
  return fmt::format(
      "impacts at an angle are first-order accurate: the contact normal of {} turned by up to "
      "{:.2g} rad within a step, and the direction of the impulse is in error by up to that; give "
      "--contact event, or a shorter --step",
      pair_, turn_);
}

}  // namespace twinarm
