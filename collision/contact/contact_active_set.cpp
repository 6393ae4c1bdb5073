#include "collision/contact/contact_active_set.h"

#include <cmath>

namespace twinarm {
namespace {

// |f_t| / (mu f_n) up to which a contact begins to be held sticking, and is held on.
constexpr double kBeginsToStick = 1 - 1e-6, kSticks = 1 + 1e-9;

bool is_in_cone(const Vector3& force, const Vector3& n, double friction) {
  const double normal = n.dot(force);
  return (force - normal * n).norm() < friction * normal;
}

}  // namespace

ContactWork& ContactWorks::of(int a, int b) {
  const std::pair pair(a, b);
  const auto by_pair = [](const ContactWork& work) { return std::pair(work.a, work.b); };
  auto w = std::ranges::lower_bound(all, pair, {}, by_pair);
  if (w == all.end() || by_pair(*w) != pair)
    w = all.insert(w, {a, b, 0, 0, 0, Vector3::Zero(), Vector3::Zero()});
  return *w;
}

void ContactWorks::serialize(StateArchive& memory, std::size_t count) {
  constexpr std::size_t kMinBytes = 9 * sizeof(double);  // of one entry
  memory.resize(all, kMinBytes);
  for (ContactWork& work : all) {
    for (int* id : {&work.a, &work.b}) memory.visit_index(*id, count);
    memory.visit(work.normal, work.friction, work.impact, work.impulse_W, work.moment_W);
  }
}

void ContactActiveSet::set_active_set(const ConstraintFrame& frame, bool impact) noexcept {
  bodies_.locates_events = true;
  held_pairs_.clear();
  for (ContactPoint& p : points_) {
    const Vector3 velocity = bodies_.relative_velocity(p.contact, frame.k);
    const double u = p.contact.n_W.dot(velocity);
    const bool stays_held = p.is_held && !p.is_separating && !impact;
    p.is_held = stays_held || (p.contact.depth >= -kClosed && u <= kRest);
    p.is_separating = false;
    p.sticks = stays_held && is_in_cone(p.force_W, p.contact.n_W, kBeginsToStick * p.friction);
    p.slip_W = velocity - u * p.contact.n_W;
    const std::pair pair(p.contact.a, p.contact.b);
    if (p.is_held && (held_pairs_.empty() || held_pairs_.back() != pair))
      held_pairs_.push_back(pair);
  }
  held_ = points_;
  released_.assign(held_pairs_.size(), 0);
  integrals_.assign(kIntegrals * held_pairs_.size(), 0);
}

void ContactActiveSet::restore_active_set() noexcept {
  points_ = held_;
  for (ContactPoint& p : points_) p.sticks = p.sticks && !released_[pair_index(p)];
  std::fill(integrals_.begin(), integrals_.end(), 0);
}

void ContactActiveSet::find_next_event(const ConstraintFrame& frame,
                                       NextEvent& next) const noexcept {
  for (const ContactPoint& p : points_)
    if (!p.is_held)
      next.include(-p.contact.depth,
                   p.contact.n_W.dot(bodies_.relative_velocity(p.contact, frame.k)));
}

void ContactActiveSet::read_smooth(ContactPoint& point, const ImpulseConstraint& c, double h,
                                   double normal, double friction) {
  const bool moves = std::hypot(c.u[1], c.u[2]) > kMoves;
  const bool slid = c.law == ConstraintType::coulomb_cone && point.slip_W.norm() > kMoves;
  const bool same_direction = moves && point.slip_W.dot(point.velocity_W) > 0;
  char mode = moves ? sliding : sticking;
  if (slid && !same_direction) mode = reversing;
  point.is_separating = c.u[0] > kMoves;
  if (point.is_separating) mode = separating;
  const std::size_t pair = pair_index(point);
  if (point.sticks) {
    const bool holds = is_in_cone(point.force_W, point.contact.n_W, kSticks * point.friction) &&
                       std::hypot(c.u[0], c.u[1], c.u[2]) <= kMoves;  // else contradictory
    mode = holds ? sticking : released;
    released_[pair] = released_[pair] || !holds;
  }
  modes_.push_back(mode);
  double* sums = &integrals_[kIntegrals * pair];
  sums[0] += normal, sums[1] += friction;
  const Vector3 impulse_W = h * point.force_W;
  const Vector3 moment_W = bodies_.impulse_moment(point.contact, impulse_W) + h * point.couple_W;
  for (int i = 0; i < 3; ++i) sums[2 + i] += impulse_W[i], sums[5 + i] += moment_W[i];
}

void ContactActiveSet::commit_work() noexcept {
  for (std::size_t i = 0; i < held_pairs_.size(); ++i) {
    ContactWork& work = works_.of(held_pairs_[i].first, held_pairs_[i].second);
    const double* sums = &integrals_[kIntegrals * i];
    work.normal += sums[0], work.friction += sums[1];
    work.impulse_W += Vector3(sums[2], sums[3], sums[4]);
    work.moment_W += Vector3(sums[5], sums[6], sums[7]);
  }
}

}  // namespace twinarm
