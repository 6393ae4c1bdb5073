#include "collision/contact_constraints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/fault.h"

namespace twinarm {
namespace {

constexpr double kSlowestBounce = 1e-3;  // [m/s]
constexpr double kTouching = 1e-6;       // takes part in an impact of others [m]
constexpr double kClosed = 1e-9;      // a gap that counts as closed: rest does not chase rounding
constexpr double kSlop = 1e-6;        // penetration that is let be [m]
constexpr double kLeastReach = 5e-4;  // [m]
constexpr double kFastestSeparation = 0.5, kSeparationPart = 0.2;  // [m/s], of the depth per step
constexpr double kSamePoint = 0.01;                                // [m]
constexpr double kBristleRatio = 1;  // tangential over normal stiffness

Matrix3 axes_of(const Vector3& n) {
  Matrix3 axes;
  axes.col(0) = n;
  axes.col(1) = n.unitOrthogonal();
  axes.col(2) = n.cross(axes.col(1));
  return axes;
}

// The gap that may close within a step, as a velocity.
double closing_speed(const Contact& contact, double h) {
  return std::max(0.0, -contact.depth - kClosed) / h;
}

double half_diagonal(const Shape& shape) {
  Vector3 extent;
  for (int axis = 0; axis < 3; ++axis)
    extent[axis] = std::max(support(shape, Vector3::Unit(axis))[axis],
                            -support(shape, -Vector3::Unit(axis))[axis]);
  return extent.norm();
}

}  // namespace

ContactConstraints::ContactConstraints(const Model<double>& model, ContactResponse response)
    : model_(&model), response_(response) {
  for (const JointType type : model.joint)
    has_drives_ = has_drives_ || type == JointType::prescribed;
}

int ContactConstraints::add(const ContactGeometry& geometry) {
  const Surface& s = geometry.surface;
  FaultList faults;
  const std::string where = "geometry '" + geometry.name + "'";
  const auto check = [&](bool good, const char* what, const char* remedy) {
    if (!good) faults.add({"", 0, where, what, remedy});
  };
  check(geometry.body >= 0 && geometry.body < model_->body_count(), "it hangs on no body",
        "name a body of the model, or the world");
  check(s.friction >= 0 && std::isfinite(s.friction), "friction is negative or not a number",
        "give 0 or more");
  check(s.restitution >= 0 && s.restitution <= 1, "restitution is not within 0 and 1",
        "give 0 (no bounce) to 1 (all of the speed)");
  check(s.torsional >= 0 && s.rolling >= 0, "torsional or rolling friction is negative",
        "give a length of 0 m or more");
  check(s.stiffness > 0 && s.dissipation >= 0, "stiffness or dissipation is not positive",
        "give a positive stiffness, and a dissipation of 0 or more");
  faults.check();
  const int id = world_.add({geometry.name, geometry.shape, geometry.group, geometry.body == 0});
  geometries_.push_back(geometry);
  const bool bounded = !std::holds_alternative<HalfSpace>(geometry.shape);
  radius_.push_back(bounded ? geometry.X_LG.p.norm() + half_diagonal(geometry.shape) : 0);
  X_WG_.push_back(geometry.X_LG);
  for (int other = 0; other < id; ++other)
    if (geometries_[static_cast<std::size_t>(other)].body == geometry.body)
      world_.disable_pair(other, id);
  return id;
}

void ContactConstraints::set_pair(int a, int b, double friction, double restitution) {
  rules_.push_back({std::min(a, b), std::max(a, b), friction, restitution});
}

// How far the geometry gets in a step, forces within it included by the factor, wherever it turns.
double ContactConstraints::reach(std::size_t geometry, const Kinematics& k, double h) const {
  const auto body = static_cast<std::size_t>(geometries_[geometry].body);
  if (body == 0) return 0;
  const double speed = k.v_WLo[body].norm() + k.w_WL[body].norm() * radius_[geometry];
  return kLeastReach + 1.25 * h * speed;
}

ContactPoint ContactConstraints::start(const Contact& contact) const {
  ContactPoint point;
  point.contact = contact;
  const Surface &a = geometry(contact.a).surface, &b = geometry(contact.b).surface;
  point.friction = std::sqrt(a.friction * b.friction);
  point.restitution = a.restitution * b.restitution;
  for (const PairRule& rule : rules_)
    if (rule.a == contact.a && rule.b == contact.b)
      point.friction = rule.friction, point.restitution = rule.restitution;
  if (const ContactPoint* before = last_of(contact)) {
    point.force_W = before->force_W;
    point.couple_W = before->couple_W;
    point.anchor_W = before->anchor_W;
  }
  return point;
}

// The same point one step before: by its name, else the nearest of the pair (where edges lie on one
// another rounding decides which of them names a corner).
const ContactPoint* ContactConstraints::last_of(const Contact& contact) const {
  const auto pair = std::pair(contact.a, contact.b);
  auto p = std::lower_bound(last_.begin(), last_.end(), pair, [](const ContactPoint& q, auto ab) {
    return std::pair(q.contact.a, q.contact.b) < ab;
  });
  const ContactPoint* nearest = nullptr;
  double least = kSamePoint;
  for (; p != last_.end() && std::pair(p->contact.a, p->contact.b) == pair; ++p) {
    if (p->contact.feature == contact.feature) return &*p;
    const double distance = (p->contact.p_WC - contact.p_WC).norm();
    if (distance < least) least = distance, nearest = &*p;
  }
  return nearest;
}

void ContactConstraints::begin_step(const Kinematics& k, const State<double>&, double h) noexcept {
  reach_.resize(geometries_.size());
  for (std::size_t g = 0; g < geometries_.size(); ++g) {
    X_WG_[g] = k.X_WL[static_cast<std::size_t>(geometries_[g].body)] * geometries_[g].X_LG;
    reach_[g] = reach(g, k, h);
  }
  world_.detect(X_WG_, reach_, contacts_);
  std::swap(points_, last_);
  points_.clear();
  work_ = {};
  for (const Contact& contact : contacts_)
    if (geometry(contact.a).body != 0 || geometry(contact.b).body != 0)
      points_.push_back(start(contact));
  gap_after_.assign(points_.size(), 0);
  closing_.assign(points_.size(), 0);
}

// Velocity of b's point against a's.
Vector3 ContactConstraints::approach(const Contact& c, const Kinematics& k) const {
  return k.velocity(geometry(c.b).body, c.p_WC) - k.velocity(geometry(c.a).body, c.p_WC);
}

bool ContactConstraints::closes(const ConstraintFrame& frame) noexcept {
  if (response_ == ContactResponse::compliant) return false;
  bool any = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint& p = points_[i];
    closing_[i] = 0;
    if (p.restitution <= 0) continue;
    const double u = p.contact.n_W.dot(approach(p.contact, frame.k));
    closing_[i] = u < -kSlowestBounce && frame.h * u < p.contact.depth;
    any = any || closing_[i];
  }
  return any;
}

bool ContactConstraints::wants_separation() const noexcept {
  if (response_ == ContactResponse::compliant) return false;
  return std::any_of(gap_after_.begin(), gap_after_.end(), [](double g) { return g < -kSlop; });
}

void ContactConstraints::add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept {
  parts_.clear();
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (frame.phase != Phase::impact || closing_[i] || points_[i].contact.depth > -kTouching)
      add_contact(frame, i, problem);
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
  const Matrix3 axes = axes_of(contact.n_W);
  parts_.push_back({i, problem.constraints().size(), 0});
  ImpulseConstraint& c = problem.add(rows == 1 ? ImpulseLaw::at_least
                                     : soft    ? ImpulseLaw::compliant
                                               : ImpulseLaw::coulomb,
                                     rows, tree_a, tree_b);
  frame.trees.add_point_rows(frame.k, a, contact.p_WC, axes, rows, -1, problem.J(c, 0));
  frame.trees.add_point_rows(frame.k, b, contact.p_WC, axes, rows, 1,
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
    problem.velocity(c, problem.v0(0), c.b);
    for (int r = 0; r < rows; ++r) c.b[r] = u[r] - c.b[r];
  }
  if (frame.phase == Phase::impact) {
    if (closing_[i] && !frame.plastic) c.b[0] += point.restitution * u[0];
    return;
  }
  if (soft)
    set_compliance(i, frame.h, axes, c);
  else
    c.b[0] += closing_speed(contact, frame.h);
  const Vector3 guess = axes.transpose() * point.force_W * frame.h;
  for (int r = 0; r < rows; ++r) c.p[r] = guess[r];
  add_friction_couples(frame, i, axes, problem);
}

// Two surfaces in series.
void ContactConstraints::set_compliance(std::size_t i, double h, const Matrix3& axes,
                                        ImpulseConstraint& c) const {
  const ContactPoint& point = points_[i];
  const Surface &a = geometry(point.contact.a).surface, &b = geometry(point.contact.b).surface;
  c.h = h;
  c.k = a.stiffness * b.stiffness / (a.stiffness + b.stiffness);
  c.c = 0.5 * (a.dissipation + b.dissipation);
  c.depth = point.contact.depth;
  c.k_t = kBristleRatio * c.k;
  c.b_t = c.k_t * c.c * std::max(0.0, c.depth);
  c.anchor = {axes.col(1).dot(point.anchor_W), axes.col(2).dot(point.anchor_W)};
}

void ContactConstraints::add_friction_couples(const ConstraintFrame& frame, std::size_t i,
                                              const Matrix3& axes, ImpulseProblem& problem) {
  const Contact& contact = points_[i].contact;
  const Surface &a = geometry(contact.a).surface, &b = geometry(contact.b).surface;
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
      problem.velocity(c, problem.v0(0), c.b);
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

void ContactConstraints::take(const ConstraintFrame& frame, const ImpulseProblem& problem,
                              std::size_t) noexcept {
  if (frame.phase == Phase::separate) return;
  if (frame.phase == Phase::step)
    for (ContactPoint& point : points_) point.force_W = point.couple_W = Vector3::Zero();
  for (const Part& part : parts_) {
    const ImpulseConstraint& c = problem.constraints()[part.row];
    ContactPoint& point = points_[part.point];
    const Matrix3 axes = axes_of(point.contact.n_W);
    const Vector3 p(c.p[0], c.p[1], c.p[2]);
    point.impulse_W += axes * p;
    if (frame.phase == Phase::impact) {
      const Vector3 before = axes.transpose() * approach(point.contact, frame.k);
      std::array<double, 3> after;
      problem.velocity(c, problem.v(0), after);
      for (int r = 0; r < 3; ++r) work_.impact += 0.5 * p[r] * (before[r] + after[r]);
      continue;
    }
    point.force_W = axes * p / frame.h;
    const double u_n =
        c.u[0] - (c.law == ImpulseLaw::compliant ? 0 : closing_speed(point.contact, frame.h));
    point.normal_velocity = u_n;
    gap_after_[part.point] = -point.contact.depth + frame.h * u_n;
    work_.normal += p[0] * u_n;
    work_.friction += p[1] * c.u[1] + p[2] * c.u[2];
    if (c.law == ImpulseLaw::compliant) {  // what the force says of the bristles; slipping sets it
      const double stiff = c.h * c.k_t, damp = c.h * c.b_t;
      Vector3 anchor = Vector3::Zero();
      for (int r = 1; r < 3; ++r) anchor += axes.col(r) * (-(p[r] + damp * c.u[r]) / stiff);
      point.anchor_W = anchor;
    }
    for (int e = 1; e <= part.extra; ++e) {
      const ImpulseConstraint& couple =
          problem.constraints()[part.row + static_cast<std::size_t>(e)];
      for (int r = 0; r < couple.rows; ++r) {
        point.couple_W += axes.col(couple.rows == 1 ? 0 : r + 1) * couple.p[r] / frame.h;
        work_.friction += couple.p[r] * couple.u[r];
      }
    }
  }
}

}  // namespace twinarm
