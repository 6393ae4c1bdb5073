#include "collision/contact/contact_rows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/constraints/event_source.h"

namespace twinarm {
namespace {

constexpr double kTouching = 1e-6;  // maximum gap of contacts that take part in an impact [m]
// Of the position correction: maximum speed [m/s], share of the depth per step.
constexpr double kMaxSeparationSpeed = 0.5, kSeparationShare = 0.2;
constexpr double kBristleRatio = 1;  // tangential over normal stiffness

void set_compliance(const ContactPoint& point, double h, const Matrix3& axes,
                    ImpulseConstraint& c) {
  c.h = h;
  c.k = point.compliance.stiffness;
  c.c = point.compliance.dissipation;
  c.depth = point.contact.depth;
  c.k_t = kBristleRatio * c.k;
  c.b_t = c.k_t * c.c * std::max(0.0, c.depth);
  c.anchor = {axes.col(1).dot(point.anchor_W), axes.col(2).dot(point.anchor_W)};
}

}  // namespace

ContactRows::ContactRows(const Model<double>& model, const ContactBodies& bodies,
                         ContactResponse response)
    : bodies_(bodies), response_(response) {
  for (const JointType joint : model.joint)
    has_drives_ = has_drives_ || joint == JointType::prescribed;
}

void ContactRows::add(const ConstraintFrame& frame, const std::vector<ContactPoint>& points,
                      ImpulseProblem& problem) {
  parts_.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (takes_part(frame, points[i])) add_contact(frame, points[i], i, problem);
}

bool ContactRows::takes_part(const ConstraintFrame& frame, const ContactPoint& point) const {
  switch (frame.phase) {
    case Phase::impact:
      return point.has_closing_contact || point.contact.depth > -kTouching;
    case Phase::impact_at_event:
      return point.contact.depth >= -EventSource::kClosed;
    case Phase::smooth:
      return point.is_held;
    default:
      return true;
  }
}

// The impact is computed at the start of the step, when a gap is still open. With the acceleration
// A towards the surface, the approach speed u is U at the impact: U^2 = u^2 + 2 A gap. The rebound
// speed there is e U, which at the present position is w: w^2 = e^2 U^2 - 2 A gap.
double ContactRows::bounce_speed(const ContactPoint& point, double u, const ConstraintFrame& frame,
                                 const ImpulseProblem& problem, const ImpulseConstraint& c) const {
  if (frame.phase == Phase::impact_at_event) return point.restitution * std::abs(u);
  std::array<double, 3> acceleration;
  problem.velocity(c, frame.acceleration, acceleration);
  const double e = point.restitution, gap = std::max(0.0, -point.contact.depth);
  const double square = e * e * u * u + 2 * (1 - e * e) * acceleration[0] * gap;
  return std::min(std::sqrt(std::max(0.0, square)), std::abs(u));
}

double ContactRows::allowed_closing_speed(const ConstraintFrame& frame,
                                          const ContactPoint& point) const {
  const double gap = -point.contact.depth;
  if (frame.phase == Phase::smooth) return EventSource::kGapRate * gap;
  if (response_ == ContactResponse::compliant) return 0;
  return std::max(0.0, gap - EventSource::kClosed) / frame.h;
}

void ContactRows::add_contact(const ConstraintFrame& frame, const ContactPoint& point,
                              std::size_t i, ImpulseProblem& problem) {
  const Contact& contact = point.contact;
  const int a = bodies_.geometry(contact.a).body, b = bodies_.geometry(contact.b).body;
  int tree_a = frame.trees.tree_of(a), tree_b = frame.trees.tree_of(b);
  if (tree_a == ImpulseConstraint::no_tree && tree_b == ImpulseConstraint::no_tree) return;
  const bool one_tree = tree_a == tree_b;  // two links of one robot
  if (one_tree) tree_b = ImpulseConstraint::no_tree;
  const bool separate = frame.phase == Phase::position_correction;
  const bool soft = response_ == ContactResponse::compliant;
  const bool smooth = !soft && point.friction <= 0;
  const int rows = separate || smooth ? 1 : 3;
  const Matrix3 axes = contact_axes(contact.n_W);
  parts_.push_back({i, problem.constraints().size(), 0});
  const bool sticks = frame.phase == Phase::smooth && point.sticks;
  ImpulseConstraint& c = problem.add(rows == 1 ? ConstraintType::unilateral
                                     : soft    ? ConstraintType::compliant
                                     : sticks  ? ConstraintType::bilateral
                                               : ConstraintType::coulomb_cone,
                                     rows, tree_a, tree_b);
  frame.trees.add_point_rows(frame.k, a, bodies_.application_point(contact, a), axes, rows, -1,
                             problem.J(c, 0));
  frame.trees.add_point_rows(frame.k, b, bodies_.application_point(contact, b), axes, rows, 1,
                             problem.J(c, one_tree ? 0 : 1));
  c.mu = point.friction;
  if (separate) {
    const double gap = point.gap_after, h = frame.h;
    c.b[0] = gap >= 0 ? gap
                      : std::max(std::min(0.0, kSeparationShare * (gap + kSlop)),
                                 -kMaxSeparationSpeed * h);
    return;
  }
  const Vector3 u = axes.transpose() * bodies_.relative_velocity(contact, frame.k);
  if (has_drives_) {  // prescribed motion is not in J
    problem.velocity(c, frame.v, c.b);
    for (int r = 0; r < rows; ++r) c.b[r] = u[r] - c.b[r];
  }
  if (frame.phase == Phase::impact || frame.phase == Phase::impact_at_event) {
    if (point.has_closing_contact && !frame.is_plastic(c))
      c.b[0] -= bounce_speed(point, u[0], frame, problem, c);
    return;
  }
  if (soft) set_compliance(point, frame.h, axes, c);
  c.b[0] += allowed_closing_speed(frame, point);
  const Vector3 guess = axes.transpose() * point.force_W * frame.h;
  for (int r = 0; r < rows; ++r) c.p[r] = guess[r];
  add_friction_couples(frame, point, axes, problem);
}

void ContactRows::add_friction_couples(const ConstraintFrame& frame, const ContactPoint& point,
                                       const Matrix3& axes, ImpulseProblem& problem) {
  const Contact& contact = point.contact;
  const ContactSurface &a = bodies_.geometry(contact.a).surface,
                       &b = bodies_.geometry(contact.b).surface;
  const int of = static_cast<int>(parts_.back().row);
  const int body_a = bodies_.geometry(contact.a).body, body_b = bodies_.geometry(contact.b).body;
  const auto add_couple = [&](double radius, const Matrix3& about, int rows) {
    if (radius <= 0) return;
    const auto tree = problem.constraints()[parts_.back().row].tree;
    const bool one_tree = frame.trees.tree_of(body_a) == frame.trees.tree_of(body_b);
    ImpulseConstraint& c = problem.add(ConstraintType::friction_disc, rows, tree[0], tree[1]);
    c.radius = radius;
    c.of = of;
    frame.trees.add_rotation_rows(frame.k, body_a, about, rows, -1, problem.J(c, 0));
    frame.trees.add_rotation_rows(frame.k, body_b, about, rows, 1, problem.J(c, one_tree ? 0 : 1));
    if (has_drives_) {
      const Vector3 w = about.transpose() * (frame.k.w_WL[static_cast<std::size_t>(body_b)] -
                                             frame.k.w_WL[static_cast<std::size_t>(body_a)]);
      problem.velocity(c, frame.v, c.b);
      for (int r = 0; r < rows; ++r) c.b[r] = w[r] - c.b[r];
    }
    const Vector3 guess = about.transpose() * point.couple_W * frame.h;
    for (int r = 0; r < rows; ++r) c.p[r] = guess[r];
    ++parts_.back().extra;
  };
  Matrix3 across;
  across << axes.col(1), axes.col(2), axes.col(0);
  add_couple(std::max(a.torsional_friction, b.torsional_friction), axes, 1);
  add_couple(std::max(a.rolling_friction, b.rolling_friction), across, 2);
}

}  // namespace twinarm
