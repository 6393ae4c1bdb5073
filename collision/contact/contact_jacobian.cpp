// A contact point as rows of the impulse problem, in each phase of a step.
#include <algorithm>
#include <cmath>

#include "collision/contact/contact_constraints.h"

namespace twinarm {
namespace {

constexpr double kFastestSeparation = 0.5, kSeparationPart = 0.2;  // [m/s], of the depth per step
constexpr double kBristleRatio = 1;  // tangential over normal stiffness

}  // namespace

// Where forces act on the body (a's or b's): midway between the surfaces, so that both feel them in
// one point; but against something that does not move on the body's own surface, for that is where
// it will touch. (Where events are located also below it by a hair, so that the motion is smooth.)
Vector3 ContactConstraints::point_on(const Contact& c, int body) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  const double gap = locates_ ? -c.depth : std::max(0.0, -c.depth);
  if (body == b && is_immovable_[static_cast<std::size_t>(a)]) return c.p_WC + 0.5 * gap * c.n_W;
  if (body == a && is_immovable_[static_cast<std::size_t>(b)]) return c.p_WC - 0.5 * gap * c.n_W;
  return c.p_WC;
}

// Velocity of b's point against a's.
Vector3 ContactConstraints::approach(const Contact& c, const Kinematics& k) const {
  const int a = geometry(c.a).body, b = geometry(c.b).body;
  return k.velocity(b, point_on(c, b)) - k.velocity(a, point_on(c, a));
}

// The impact is computed at the start of the step, a gap before it happens. With the acceleration A
// towards the surface the speed u becomes U, U^2 = u^2 + 2 A gap; e U is left after the impact; and
// on the way back to where the body is now it becomes w, w^2 = e^2 U^2 - 2 A gap.
double ContactConstraints::bounce_speed(std::size_t i, double u, const ConstraintFrame& frame,
                                        const ImpulseProblem& problem,
                                        const ImpulseConstraint& c) const {
  const ContactPoint& point = points_[i];
  if (frame.phase == Phase::hit) return point.restitution * std::abs(u);
  std::array<double, 3> acceleration;
  problem.velocity(c, frame.acceleration, acceleration);
  const double e = point.restitution, gap = std::max(0.0, -point.contact.depth);
  const double square = e * e * u * u + 2 * (1 - e * e) * acceleration[0] * gap;
  return std::min(std::sqrt(std::max(0.0, square)), std::abs(u));
}

// How fast the gap may close: in a step by what is left of it, in a smooth piece not at all but for
// the rest that integration leaves.
double ContactConstraints::may_close(const ConstraintFrame& frame,
                                     const ContactPoint& point) const {
  const double gap = -point.contact.depth;
  if (frame.phase == Phase::flow) return kGapRate * gap;
  if (response_ == ContactResponse::compliant) return 0;
  return std::max(0.0, gap - kClosed) / frame.h;
}

void ContactConstraints::add_contact(const ConstraintFrame& frame, std::size_t i,
                                     ImpulseProblem& problem) {
  const ContactPoint& point = points_[i];
  const Contact& contact = point.contact;
  const int a = geometry(contact.a).body, b = geometry(contact.b).body;
  int tree_a = frame.trees.tree_of(a), tree_b = frame.trees.tree_of(b);
  if (tree_a == ImpulseConstraint::no_tree && tree_b == ImpulseConstraint::no_tree) return;
  const bool one_tree = tree_a == tree_b;  // two links of one robot
  if (one_tree) tree_b = ImpulseConstraint::no_tree;
  const bool separate = frame.phase == Phase::separate;
  const bool soft = response_ == ContactResponse::compliant;
  const bool smooth = !soft && point.friction <= 0;
  const int rows = separate || smooth ? 1 : 3;
  const Matrix3 axes = contact_axes(contact.n_W);
  parts_.push_back({i, problem.constraints().size(), 0});
  ImpulseConstraint& c = problem.add(rows == 1 ? ImpulseLaw::at_least
                                     : soft    ? ImpulseLaw::compliant
                                               : ImpulseLaw::coulomb,
                                     rows, tree_a, tree_b);
  frame.trees.add_point_rows(frame.k, a, point_on(contact, a), axes, rows, -1, problem.J(c, 0));
  frame.trees.add_point_rows(frame.k, b, point_on(contact, b), axes, rows, 1,
                             problem.J(c, one_tree ? 0 : 1));
  c.mu = point.friction;
  if (separate) {
    const double gap = gap_after_[i], h = frame.h;
    c.b[0] = gap >= 0 ? gap
                      : std::max(std::min(0.0, kSeparationPart * (gap + kSlop)),
                                 -kFastestSeparation * h);
    return;
  }
  const Vector3 u = axes.transpose() * approach(contact, frame.k);
  if (has_drives_) {  // what moves by a law is not in J
    problem.velocity(c, frame.v, c.b);
    for (int r = 0; r < rows; ++r) c.b[r] = u[r] - c.b[r];
  }
  if (frame.phase == Phase::impact || frame.phase == Phase::hit) {
    if (closing_[i] && !frame.is_plastic(c)) c.b[0] -= bounce_speed(i, u[0], frame, problem, c);
    return;
  }
  if (soft) set_compliance(i, frame.h, axes, c);
  c.b[0] += may_close(frame, point);
  const Vector3 guess = axes.transpose() * point.force_W * frame.h;
  for (int r = 0; r < rows; ++r) c.p[r] = guess[r];
  add_friction_couples(frame, i, axes, problem);
}

void ContactConstraints::set_compliance(std::size_t i, double h, const Matrix3& axes,
                                        ImpulseConstraint& c) const {
  const ContactPoint& point = points_[i];
  c.h = h;
  c.k = point.compliance.stiffness;
  c.c = point.compliance.dissipation;
  c.depth = point.contact.depth;
  c.k_t = kBristleRatio * c.k;
  c.b_t = c.k_t * c.c * std::max(0.0, c.depth);
  c.anchor = {axes.col(1).dot(point.anchor_W), axes.col(2).dot(point.anchor_W)};
}

void ContactConstraints::add_friction_couples(const ConstraintFrame& frame, std::size_t i,
                                              const Matrix3& axes, ImpulseProblem& problem) {
  const Contact& contact = points_[i].contact;
  const ContactSurface &a = geometry(contact.a).surface, &b = geometry(contact.b).surface;
  const int of = static_cast<int>(parts_.back().row);
  const auto add_couple = [&](double radius, const Matrix3& about, int rows) {
    if (radius <= 0) return;
    const auto tree = problem.constraints()[parts_.back().row].tree;
    const bool one_tree = frame.trees.tree_of(geometry(contact.a).body) ==
                          frame.trees.tree_of(geometry(contact.b).body);
    ImpulseConstraint& c = problem.add(ImpulseLaw::disc, rows, tree[0], tree[1]);
    c.radius = radius;
    c.of = of;
    const int body_a = geometry(contact.a).body, body_b = geometry(contact.b).body;
    frame.trees.add_turn_rows(frame.k, body_a, about, rows, -1, problem.J(c, 0));
    frame.trees.add_turn_rows(frame.k, body_b, about, rows, 1, problem.J(c, one_tree ? 0 : 1));
    if (has_drives_) {
      const Vector3 w = about.transpose() * (frame.k.w_WL[static_cast<std::size_t>(body_b)] -
                                             frame.k.w_WL[static_cast<std::size_t>(body_a)]);
      problem.velocity(c, frame.v, c.b);
      for (int r = 0; r < rows; ++r) c.b[r] = w[r] - c.b[r];
    }
    const Vector3 guess = about.transpose() * points_[i].couple_W * frame.h;
    for (int r = 0; r < rows; ++r) c.p[r] = guess[r];
    ++parts_.back().extra;
  };
  Matrix3 across;
  across << axes.col(1), axes.col(2), axes.col(0);
  add_couple(std::max(a.torsional, b.torsional), axes, 1);
  add_couple(std::max(a.rolling, b.rolling), across, 2);
}

}  // namespace twinarm
