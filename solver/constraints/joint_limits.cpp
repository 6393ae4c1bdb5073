#include "solver/constraints/joint_limits.h"

#include <cmath>
#include <stdexcept>

namespace twinarm {
namespace {

constexpr double kTolerance = 1e-9, kMinMargin = 1e-3;  // [rad, m]
constexpr double kCorrectionFactor = 0.2;               // of the position error, per step

}  // namespace

void JointLimits::add(int body, double lower, double upper) {
  if (body <= 0 || body >= model_->body_count() ||
      model_->dofs(static_cast<std::size_t>(body)) != 1)
    throw std::invalid_argument("a position limit requires a joint with one degree of freedom");
  if (!(lower <= upper)) throw std::invalid_argument("the lower limit is above the upper limit");
  limits_.push_back({body, lower, upper});
  rows_.reserve(2 * limits_.size());
}

// Limits within reach at twice the current speed plus an acceleration of 1e4 rad/s^2 or m/s^2.
void JointLimits::begin_step(const Kinematics&, const State<double>& x, double h) noexcept {
  rows_.clear();
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    const Limit& limit = limits_[i];
    const auto body = static_cast<std::size_t>(limit.body);
    const double q = x.q[model_->iq[body]],
                 margin = 2 * h * std::abs(x.qd[model_->iv[body]]) + 1e4 * h * h + kMinMargin;
    if (q - limit.lower < margin) rows_.push_back({i, 1, q - limit.lower});
    if (limit.upper - q < margin) rows_.push_back({i, -1, limit.upper - q});
  }
}

bool JointLimits::needs_position_correction() const noexcept {
  return std::ranges::any_of(rows_, [](const Row& row) { return row.after < -kTolerance; });
}

void JointLimits::add_constraints(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept {
  for (const Row& row : rows_) {
    if (!is_included(frame, row)) continue;
    const std::size_t dof = model_->iv[static_cast<std::size_t>(limits_[row.limit].body)];
    ImpulseConstraint& c = problem.add(ConstraintType::unilateral, 1, frame.trees.tree_of_dof(dof),
                                       ImpulseConstraint::no_tree);
    problem.J(c, 0)[frame.trees.index_in_tree(dof)] = row.sign;
    switch (frame.phase) {
      case Phase::impact:  // inactive unless closed
        c.b[0] = row.gap > kClosed ? 1e9 : 0;
        break;
      case Phase::step:
        c.b[0] = std::max(0.0, row.gap - kClosed) / frame.h;
        c.p[0] = std::max(0.0, row.sign * limits_[row.limit].force * frame.h);
        break;
      case Phase::impact_at_event:
        break;
      case Phase::smooth:
        c.b[0] = kGapRate * row.gap;
        c.p[0] = std::max(0.0, row.sign * limits_[row.limit].force * frame.h);
        break;
      case Phase::position_correction:
        c.b[0] = row.after >= 0 ? row.after
                                : std::min(0.0, kCorrectionFactor * (row.after + kTolerance));
        break;
    }
  }
}

void JointLimits::read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                                std::size_t first) noexcept {
  if (frame.phase == Phase::position_correction) return;
  const bool jumps = frame.phase == Phase::impact || frame.phase == Phase::impact_at_event;
  if (!jumps)
    for (Limit& limit : limits_) limit.force = 0;
  for (Row& row : rows_) {
    if (!is_included(frame, row)) continue;
    const ImpulseConstraint& c = problem.constraints()[first++];
    Limit& limit = limits_[row.limit];
    const double u = c.u[0] - c.b[0];  // at the end of the step
    const double work = 0.5 * c.p[0] * (u + speed(row, frame.x));
    if (jumps) {
      limit.work += work;
      continue;
    }
    limit.force += row.sign * c.p[0] / frame.h;
    row.after = row.gap + frame.h * u;
    if (frame.phase == Phase::step)
      limit.work += work;
    else
      for (std::size_t i = 0; i < held_.size(); ++i)
        if (held_[i].limit == row.limit && held_[i].sign == row.sign) {
          held_[i].is_separating = c.u[0] > kMoves;
          integrals_[i] += work;
        }
  }
}

const JointLimits::Active* JointLimits::find_active(const Row& row) const {
  for (const Active& active : held_)
    if (active.limit == row.limit && active.sign == row.sign) return &active;
  return nullptr;
}

// Limits are inelastic: in a step of fixed size the velocity phase enforces them.
bool JointLimits::has_closing_contact(const ConstraintFrame& frame) noexcept {
  if (frame.phase != Phase::impact_at_event) return false;
  return std::ranges::any_of(
      rows_, [&](const Row& row) { return row.gap <= kClosed && speed(row, frame.x) < -kRest; });
}

void JointLimits::set_active_set(const ConstraintFrame& frame, bool impact) noexcept {
  held_before_.clear();
  for (const Row& row : rows_) {
    const Active* before = find_active(row);
    const bool remains = before && !before->is_separating && !impact;
    if (remains || (row.gap <= kClosed && speed(row, frame.x) <= kRest))
      held_before_.push_back({row.limit, row.sign});
  }
  std::swap(held_, held_before_);
  integrals_.assign(held_.size(), 0);
}

}  // namespace twinarm
