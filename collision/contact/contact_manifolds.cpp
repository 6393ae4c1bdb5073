#include "collision/contact/contact_manifolds.h"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace twinarm {
namespace {

constexpr double kMinMargin = 5e-4;  // [m]
constexpr double kSamePoint = 0.01;  // [m]

std::pair<int, int> pair_of(const ContactPoint& p) {
  return {p.contact.a, p.contact.b};
}
std::tuple<int, int, int> key_of(const ContactPoint& p) {
  return {p.contact.a, p.contact.b, p.contact.feature};
}

}  // namespace

// The factor allows for the acceleration within the step.
double ContactManifolds::speculative_margin(std::size_t geometry, const Kinematics& k,
                                            double h) const {
  const bool is_fixed = bodies_.geometry(static_cast<int>(geometry)).body == 0;
  return is_fixed ? 0 : kMinMargin + 1.25 * bodies_.max_displacement(geometry, k, h);
}

// Appends the points of contacts_ that are not among points[0, known), with what they had one step
// before. Contacts and last_ ascend by pair.
void ContactManifolds::start_points() {
  const auto known = static_cast<std::ptrdiff_t>(points.size());
  auto of_pair = std::span<const ContactPoint>(last_);
  std::pair pair(-1, -1);
  ContactSurface surface;
  for (const Contact& contact : contacts_) {
    const std::tuple key(contact.a, contact.b, contact.feature);
    const auto end = points.begin() + known;
    const auto p = std::ranges::lower_bound(points.begin(), end, key, {}, key_of);
    if ((p != end && key_of(*p) == key) || !bodies_.has_moving_body(contact)) continue;
    if (pair != std::pair(contact.a, contact.b)) {
      pair = {contact.a, contact.b};
      surface = bodies_.surface_of_pair(contact.a, contact.b);
      const auto first =
          std::ranges::find_if(of_pair, [&](const ContactPoint& x) { return pair_of(x) >= pair; });
      of_pair = {first, of_pair.end()};
    }
    points.push_back(start(contact, surface, of_pair));
  }
}

ContactPoint ContactManifolds::start(const Contact& contact, const ContactSurface& surface,
                                     std::span<const ContactPoint> last) const {
  ContactPoint point;
  point.contact = contact;
  point.friction = surface.friction;
  point.restitution = surface.restitution;
  point.compliance = {surface.stiffness, surface.dissipation};
  if (const ContactPoint* before = last_of(contact, last)) {
    point.force_W = before->force_W;
    point.couple_W = before->couple_W;
    point.anchor_W = before->anchor_W;
    point.is_held = before->is_held, point.is_separating = before->is_separating;
    point.sticks = before->sticks, point.slip_W = before->slip_W;
  }
  return point;
}

// The same point one step before: by its feature, else the nearest of the pair (for coincident
// edges, rounding decides which of them identifies a vertex).
const ContactPoint* ContactManifolds::last_of(const Contact& contact,
                                              std::span<const ContactPoint> last) {
  const ContactPoint* nearest = nullptr;
  double min_distance = kSamePoint;
  for (const ContactPoint& p : last) {
    if (pair_of(p) != std::pair(contact.a, contact.b)) break;
    if (p.contact.feature == contact.feature) return &p;
    const double distance = (p.contact.p_WC - contact.p_WC).norm();
    if (distance < min_distance) min_distance = distance, nearest = &p;
  }
  return nearest;
}

void ContactManifolds::begin_step(const Kinematics& k, double h) noexcept {
  margins_.resize(bodies_.size());
  X_WG_.resize(bodies_.size());
  for (std::size_t g = 0; g < bodies_.size(); ++g) {
    const ContactGeometry& geometry = bodies_.geometry(static_cast<int>(g));
    X_WG_[g] = k.X_WL[static_cast<std::size_t>(geometry.body)] * geometry.X_LG;
    margins_[g] = speculative_margin(g, k, h);
  }
  bodies_.world().detect(X_WG_, margins_, contacts_);
  std::swap(points, last_);
  points.clear();
  start_points();
}

bool ContactManifolds::extend_detection(const Kinematics& k, double h) noexcept {
  bool farther = false;
  for (std::size_t g = 0; g < bodies_.size(); ++g)
    if (bodies_.max_displacement(g, k, h) > margins_[g])
      farther = true, margins_[g] = speculative_margin(g, k, h);
  if (!farther) return false;
  bodies_.world().detect(X_WG_, margins_, contacts_);
  const std::size_t known = points.size();
  start_points();
  if (points.size() == known) return false;
  std::ranges::sort(points, {}, key_of);
  for (ContactPoint& point : points) point.has_closing_contact = false, point.gap_after = 0;
  return true;
}

void ContactManifolds::serialize(StateArchive& memory) {
  constexpr std::size_t kMinBytes = 28 * sizeof(double);  // of a point
  const std::size_t count = bodies_.size();
  memory.resize(points, kMinBytes);
  for (ContactPoint& p : points) {
    for (int* id : {&p.contact.a, &p.contact.b}) memory.visit_index(*id, count);
    memory.visit(p.contact.feature, p.contact.depth, p.friction, p.restitution,
                 p.compliance.stiffness, p.compliance.dissipation);
    memory.visit(p.contact.p_WC, p.contact.n_W, p.impulse_W, p.force_W, p.couple_W, p.anchor_W,
                 p.velocity_W, p.slip_W, p.is_held, p.is_separating);
  }
}

}  // namespace twinarm
