// Contacts in steps that locate their events in time (solver/impulses/event_source.h).
#include <algorithm>
#include <cmath>
#include <utility>

#include "collision/contact/contact_constraints.h"

namespace twinarm {
void ContactConstraints::hold(const ConstraintFrame& frame, bool struck) noexcept {
  locates_ = true;
  held_pairs_.clear();
  for (ContactPoint& p : points_) {
    const Vector3 velocity = approach(p.contact, frame.k);
    const double u = p.contact.n_W.dot(velocity);
    const bool goes_on = p.is_held && !p.opens && !struck;
    p.is_held = goes_on || (p.contact.depth >= -kClosed && u <= kRest);
    p.opens = false;
    p.slip_W = velocity - u * p.contact.n_W;
    const std::pair pair(p.contact.a, p.contact.b);
    if (p.is_held && (held_pairs_.empty() || held_pairs_.back() != pair))
      held_pairs_.push_back(pair);
  }
  held_ = points_;
  flow_works_.assign(kFlowNumbers * held_pairs_.size(), 0);
}

void ContactConstraints::hold_again() noexcept {
  points_ = held_;
  std::fill(flow_works_.begin(), flow_works_.end(), 0);
}

void ContactConstraints::look(const ConstraintFrame& frame, Nearest& nearest) const noexcept {
  for (const ContactPoint& p : points_) {
    if (p.is_held) continue;
    const double gap = -p.contact.depth;
    const double u = p.contact.n_W.dot(approach(p.contact, frame.k));
    const bool closes = u < -kRest;
    if (closes) nearest.time = std::min(nearest.time, std::max(0.0, gap) / -u);
    const bool passed = gap < -10 * kClosed;
    if ((closes || passed) && gap < nearest.gap) nearest.gap = gap, nearest.closes = closes;
  }
}

void ContactConstraints::take_flow(ContactPoint& point, const ImpulseConstraint& c, double h,
                                   double normal, double friction) {
  const bool moves = std::hypot(c.u[1], c.u[2]) > kMoves;
  const bool slid = c.law == ImpulseLaw::coulomb && point.slip_W.norm() > kMoves;
  const bool goes_on = moves && point.slip_W.dot(point.velocity_W) > 0;
  Mode mode = moves ? Mode::slides : Mode::rests;
  if (slid && !goes_on) mode = Mode::turns;
  point.opens = c.u[0] > kMoves;
  if (point.opens) mode = Mode::opens;
  modes_.push_back(mode);
  const auto pair = std::lower_bound(held_pairs_.begin(), held_pairs_.end(),
                                     std::pair(point.contact.a, point.contact.b));
  double* sums = &flow_works_[kFlowNumbers * static_cast<std::size_t>(pair - held_pairs_.begin())];
  sums[0] += normal, sums[1] += friction;
  const Vector3 impulse_W = h * point.force_W;
  const Vector3 moment_W = moment_of(point.contact, impulse_W) + h * point.couple_W;
  for (int i = 0; i < 3; ++i) sums[2 + i] += impulse_W[i], sums[5 + i] += moment_W[i];
}

void ContactConstraints::modes(std::vector<char>& modes) const noexcept {
  modes.insert(modes.end(), modes_.begin(), modes_.end());
}

void ContactConstraints::count_works() noexcept {
  for (std::size_t i = 0; i < held_pairs_.size(); ++i) {
    Contact contact{};
    contact.a = held_pairs_[i].first, contact.b = held_pairs_[i].second;
    ContactWork& work = work_of(contact);
    const double* sums = &flow_works_[kFlowNumbers * i];
    work.normal += sums[0], work.friction += sums[1];
    work.impulse_W += Vector3(sums[2], sums[3], sums[4]);
    work.moment_W += Vector3(sums[5], sums[6], sums[7]);
  }
}

void ContactConstraints::go_back() noexcept {
  std::swap(points_, kept_.points);
  std::swap(work_, kept_.work);
}

}  // namespace twinarm
