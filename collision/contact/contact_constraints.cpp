#include "collision/contact/contact_constraints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

constexpr double kSlowestBounce = 1e-3;  // [m/s]
constexpr double kTouching = 1e-6;       // takes part in an impact of others [m]
constexpr double kLeastReach = 5e-4;     // [m]
constexpr double kSamePoint = 0.01;      // [m]

std::tuple<int, int, int> name_of(const Contact& c) {
  return {c.a, c.b, c.feature};
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
  constexpr std::size_t kRoom = 256;  // so that a pair that touches for the first time takes none
  points_.reserve(kRoom);
  work_.reserve(kRoom);
  is_immovable_.assign(model.parent.size(), 1);
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    has_drives_ = has_drives_ || model.joint[i] == JointType::prescribed;
    is_immovable_[i] =
        is_immovable_[static_cast<std::size_t>(model.parent[i])] && model.dofs(i) == 0;
  }
}

int ContactConstraints::add(const ContactGeometry& geometry) {
  const ContactSurface& s = geometry.surface;
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
  check(s.stiffness > 0 && std::isfinite(s.stiffness), "stiffness is not a positive number",
        "give it in N/m, above 0");
  check(s.dissipation >= 0 && std::isfinite(s.dissipation),
        "dissipation is negative or not a number", "give it in s/m, 0 or more");
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

void ContactConstraints::set_pair(int a, int b, const ContactPairLaw& law) {
  rules_.push_back({std::min(a, b), std::max(a, b), law});
}

// How far the geometry gets in a step, wherever it turns.
double ContactConstraints::way(std::size_t geometry, const Kinematics& k, double h) const {
  const auto body = static_cast<std::size_t>(geometries_[geometry].body);
  return h * (k.v_WLo[body].norm() + k.w_WL[body].norm() * radius_[geometry]);
}

// As far as it is looked for others, forces within the step included.
double ContactConstraints::reach(std::size_t geometry, const Kinematics& k, double h) const {
  return geometries_[geometry].body == 0 ? 0 : kLeastReach + 1.25 * way(geometry, k, h);
}

ContactPoint ContactConstraints::start(const Contact& contact) const {
  ContactPoint point;
  point.contact = contact;
  const ContactSurface &a = geometry(contact.a).surface, &b = geometry(contact.b).surface;
  point.friction = std::sqrt(a.friction * b.friction);
  point.restitution = a.restitution * b.restitution;
  point.compliance = in_series({a.stiffness, a.dissipation}, {b.stiffness, b.dissipation});
  for (const PairRule& rule : rules_)
    if (rule.a == contact.a && rule.b == contact.b) {
      point.friction = rule.law.friction;
      point.restitution = rule.law.restitution;
      point.compliance = rule.law.compliance;
    }
  if (const ContactPoint* before = last_of(contact)) {
    point.force_W = before->force_W;
    point.couple_W = before->couple_W;
    point.anchor_W = before->anchor_W;
    point.is_held = before->is_held, point.opens = before->opens;
    point.slip_W = before->slip_W;
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
  for (const Contact& contact : contacts_)
    if (geometry(contact.a).body != 0 || geometry(contact.b).body != 0)
      points_.push_back(start(contact));
  gap_after_.assign(points_.size(), 0);
  closing_.assign(points_.size(), 0);
}

// Of points that were there already, names and what they have carried so far stay.
bool ContactConstraints::look_farther(const Kinematics& k, double h) noexcept {
  bool farther = false;
  for (std::size_t g = 0; g < geometries_.size(); ++g)
    if (way(g, k, h) > reach_[g]) farther = true, reach_[g] = reach(g, k, h);
  if (!farther) return false;
  world_.detect(X_WG_, reach_, contacts_);
  const auto before = [](const ContactPoint& p, const ContactPoint& q) {
    return name_of(p.contact) < name_of(q.contact);
  };
  const std::size_t known = points_.size();
  for (const Contact& contact : contacts_) {
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(known);
    const auto p = std::lower_bound(
        points_.begin(), end, contact,
        [](const ContactPoint& q, const Contact& c) { return name_of(q.contact) < name_of(c); });
    if (p != end && name_of(p->contact) == name_of(contact)) continue;
    if (geometry(contact.a).body != 0 || geometry(contact.b).body != 0)
      points_.push_back(start(contact));
  }
  if (points_.size() == known) return false;
  std::sort(points_.begin(), points_.end(), before);
  gap_after_.assign(points_.size(), 0);
  closing_.assign(points_.size(), 0);
  return true;
}

bool ContactConstraints::closes(const ConstraintFrame& frame) noexcept {
  if (response_ == ContactResponse::compliant) return false;
  const bool located = frame.phase == Phase::hit;
  bool any = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint& p = points_[i];
    closing_[i] = 0;
    if (p.restitution <= 0 && !located) continue;  // those are for the second phase
    const double u = p.contact.n_W.dot(approach(p.contact, frame.k));
    closing_[i] = located ? u < -kRest && p.contact.depth >= -kClosed
                          : u < -kSlowestBounce && frame.h * u < p.contact.depth;
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
    if (takes_part(frame, i)) add_contact(frame, i, problem);
}

bool ContactConstraints::takes_part(const ConstraintFrame& frame, std::size_t i) const {
  switch (frame.phase) {
    case Phase::impact:
      return closing_[i] || points_[i].contact.depth > -kTouching;
    case Phase::hit:
      return points_[i].contact.depth >= -kClosed;
    case Phase::flow:
      return points_[i].is_held;
    default:
      return true;
  }
}

// Those of pairs that have worked before are found, others come in.
ContactWork& ContactConstraints::work_of(const Contact& contact) {
  const std::pair pair(contact.a, contact.b);
  auto w = std::lower_bound(work_.begin(), work_.end(), pair, [](const ContactWork& work, auto ab) {
    return std::pair(work.a, work.b) < ab;
  });
  if (w == work_.end() || std::pair(w->a, w->b) != pair)
    w = work_.insert(w, {contact.a, contact.b, 0, 0, 0, Vector3::Zero(), Vector3::Zero()});
  return *w;
}

// Where the constraint's rows have it act: on what moves, where the other does not.
Vector3 ContactConstraints::moment_of(const Contact& contact, const Vector3& impulse_W) const {
  const int a = geometry(contact.a).body, b = geometry(contact.b).body;
  const bool b_stands = is_immovable_[static_cast<std::size_t>(b)];
  return point_on(contact, b_stands ? a : b).cross(impulse_W);
}

void ContactConstraints::take(const ConstraintFrame& frame, const ImpulseProblem& problem,
                              std::size_t) noexcept {
  if (frame.phase == Phase::separate) return;
  const bool jumps = frame.phase == Phase::impact || frame.phase == Phase::hit;
  if (!jumps)
    for (ContactPoint& point : points_) point.force_W = point.couple_W = Vector3::Zero();
  if (frame.phase == Phase::flow) modes_.clear();
  for (const Part& part : parts_) {
    const ImpulseConstraint& c = problem.constraints()[part.row];
    ContactPoint& point = points_[part.point];
    const Matrix3 axes = contact_axes(point.contact.n_W);
    const Vector3 impulse_W = axes * Vector3(c.p[0], c.p[1], c.p[2]);
    point.impulse_W += impulse_W;
    if (frame.phase != Phase::flow) {
      ContactWork& work = work_of(point.contact);
      work.impulse_W += impulse_W;
      work.moment_W += moment_of(point.contact, impulse_W);
    }
    if (jumps) {
      // Work on what moves freely: over J v alone, without what moves by a law.
      std::array<double, 3> before, after;
      problem.velocity(c, problem.v(0), after);
      problem.velocity(c, problem.v0(0), before);
      for (std::size_t r = 0; r < 3; ++r)
        work_of(point.contact).impact += 0.5 * c.p[r] * (before[r] + after[r]);
    } else {
      take_step(frame, problem, part, axes);
    }
  }
}

// Of the second phase: forces, what the gap becomes, and work, over the mean of the velocities
// before and after; of what rests that is nothing.
void ContactConstraints::take_step(const ConstraintFrame& frame, const ImpulseProblem& problem,
                                   const Part& part, const Matrix3& axes) {
  const ImpulseConstraint& c = problem.constraints()[part.row];
  ContactPoint& point = points_[part.point];
  const Vector3 p(c.p[0], c.p[1], c.p[2]);
  const double closing = may_close(frame, point);
  const Vector3 start = axes.transpose() * approach(point.contact, frame.k);
  std::array<double, 3> before, after;
  problem.velocity(c, problem.v(0), after);
  for (std::size_t r = 0; r < 3; ++r)
    before[r] = start[static_cast<int>(r)] - c.b[r] + (r == 0 ? closing : 0);
  point.force_W = axes * p / frame.h;
  const double u_n = c.u[0] - closing;
  point.velocity_W = axes * Vector3(u_n, c.u[1], c.u[2]);
  gap_after_[part.point] = -point.contact.depth + frame.h * u_n;
  const double normal = 0.5 * c.p[0] * (before[0] + after[0]);
  double friction = 0;
  for (const std::size_t r : {1, 2}) friction += 0.5 * c.p[r] * (before[r] + after[r]);
  if (c.law == ImpulseLaw::compliant) {  // what the force says of the bristles; slipping sets it
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
  if (frame.phase == Phase::flow) return take_flow(point, c, frame.h, normal, friction);
  ContactWork& work = work_of(point.contact);
  work.moment_W += frame.h * point.couple_W;
  const bool hits = c.p[0] > 0 && start[0] < -kSlowestBounce && u_n > start[0];
  (hits ? work.impact : work.normal) += normal;
  work.friction += friction;
}

}  // namespace twinarm
