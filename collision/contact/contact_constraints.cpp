#include "collision/contact/contact_constraints.h"

#include <algorithm>
#include <array>

namespace twinarm {
namespace {

constexpr double kMinBounceSpeed = 1e-3;  // [m/s]

}  // namespace

ContactConstraints::ContactConstraints(const Model<double>& model, ContactResponse response)
    : response_(response),
      bodies_(model),
      found_(bodies_),
      rows_(model, bodies_, response),
      active_(bodies_, found_.points, works_) {}

bool ContactConstraints::has_closing_contact(const ConstraintFrame& frame) noexcept {
  if (response_ == ContactResponse::compliant) return false;
  const bool located = frame.phase == Phase::impact_at_event;
  bool any = false;
  for (ContactPoint& p : found_.points) {
    p.has_closing_contact = false;
    if (p.restitution <= 0 && !located) continue;  // handled in the second phase
    const double u = p.contact.n_W.dot(bodies_.relative_velocity(p.contact, frame.k));
    p.has_closing_contact =
        located ? u < -EventSource::kRest && p.contact.depth >= -EventSource::kClosed
                : u < -kMinBounceSpeed && frame.h * u < p.contact.depth;
    any = any || p.has_closing_contact;
  }
  return any;
}

bool ContactConstraints::needs_position_correction() const noexcept {
  if (response_ == ContactResponse::compliant) return false;
  return std::ranges::any_of(found_.points, [](const auto& p) { return p.gap_after < -kSlop; });
}

void ContactConstraints::read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                                       std::size_t) noexcept {
  if (frame.phase == Phase::position_correction) return;
  const bool jumps = frame.phase == Phase::impact || frame.phase == Phase::impact_at_event;
  if (!jumps)
    for (ContactPoint& point : found_.points) point.force_W = point.couple_W = Vector3::Zero();
  if (frame.phase == Phase::smooth) active_.clear_modes();
  for (const ContactRows::Part& part : rows_.parts()) {
    const ImpulseConstraint& c = problem.constraints()[part.row];
    ContactPoint& point = found_.points[part.point];
    const Matrix3 axes = contact_axes(point.contact.n_W);
    const Vector3 impulse_W = axes * Vector3(c.p[0], c.p[1], c.p[2]);
    point.impulse_W += impulse_W;
    if (frame.phase != Phase::smooth) {
      ContactWork& work = works_.of(point.contact.a, point.contact.b);
      work.impulse_W += impulse_W;
      work.moment_W += bodies_.impulse_moment(point.contact, impulse_W);
    }
    if (jumps) {
      // Work on the free degrees of freedom: J v without prescribed motion.
      std::array<double, 3> before, after;
      problem.velocity(c, problem.v(0), after);
      problem.velocity(c, problem.v0(0), before);
      for (std::size_t r = 0; r < 3; ++r)
        works_.of(point.contact.a, point.contact.b).impact += 0.5 * c.p[r] * (before[r] + after[r]);
    } else {
      read_step(frame, problem, part, axes);
    }
  }
}

// Second phase: forces, gap at the end of the step, and work p . (u_before + u_after)/2.
void ContactConstraints::read_step(const ConstraintFrame& frame, const ImpulseProblem& problem,
                                   const ContactRows::Part& part, const Matrix3& axes) {
  const ImpulseConstraint& c = problem.constraints()[part.row];
  ContactPoint& point = found_.points[part.point];
  const Vector3 p(c.p[0], c.p[1], c.p[2]);
  const double closing = rows_.allowed_closing_speed(frame, point);
  const Vector3 start = axes.transpose() * bodies_.relative_velocity(point.contact, frame.k);
  std::array<double, 3> before, after;
  problem.velocity(c, problem.v(0), after);
  for (std::size_t r = 0; r < 3; ++r)
    before[r] = start[static_cast<int>(r)] - c.b[r] + (r == 0 ? closing : 0);
  point.force_W = axes * p / frame.h;
  const double u_n = c.u[0] - closing;
  point.velocity_W = axes * Vector3(u_n, c.u[1], c.u[2]);
  point.gap_after = -point.contact.depth + frame.h * u_n;
  const double normal = 0.5 * c.p[0] * (before[0] + after[0]);
  double friction = 0;
  for (const std::size_t r : {1, 2}) friction += 0.5 * c.p[r] * (before[r] + after[r]);
  if (c.law == ConstraintType::compliant) {  // bristle deflection, also while sliding
    const double stiff = c.h * c.k_t, damp = c.h * c.b_t;
    Vector3 anchor = Vector3::Zero();
    for (int r = 1; r < 3; ++r) anchor += axes.col(r) * (-(p[r] + damp * c.u[r]) / stiff);
    point.anchor_W = anchor;
  }
  for (int e = 1; e <= part.extra; ++e) {
    const ImpulseConstraint& couple = problem.constraints()[part.row + static_cast<std::size_t>(e)];
    for (int r = 0; r < couple.rows; ++r) {
      point.couple_W += axes.col(couple.rows == 1 ? 0 : r + 1) * couple.p[r] / frame.h;
      friction += couple.p[r] * (couple.u[r] - couple.b[r]);
    }
  }
  if (frame.phase == Phase::smooth) return active_.read_smooth(point, c, frame.h, normal, friction);
  ContactWork& work = works_.of(point.contact.a, point.contact.b);
  work.moment_W += frame.h * point.couple_W;
  const bool is_impact = c.p[0] > 0 && start[0] < -kMinBounceSpeed && u_n > start[0];
  (is_impact ? work.impact : work.normal) += normal;
  work.friction += friction;
}

void ContactConstraints::serialize(StateArchive& memory) {
  memory.visit(bodies_.locates_events);
  found_.serialize(memory);
  works_.serialize(memory, bodies_.size());
}

}  // namespace twinarm
