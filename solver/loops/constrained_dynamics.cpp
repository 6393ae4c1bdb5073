#include "solver/loops/constrained_dynamics.h"

#include <limits>
#include <utility>

#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

using Mode = ForwardDynamics::Mode;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// If a loop couples dofs with friction, only a sum of their friction forces is determined. This
// fraction of the diagonal of B regularizes the problem (least-squares distribution). The resulting
// creep is removed by remove_rounding() and zero_sticking_velocities().
constexpr double kRegularization = 1e-10;

Mode mode_of(double v) {
  return v > 0 ? Mode::sliding_plus : v < 0 ? Mode::sliding_minus : Mode::sticking;
}

}  // namespace

ForwardDynamics::ForwardDynamics(const Model<double>& model)
    : model_(&model),
      friction_(model),
      bilateral_(model),
      mode_(friction_.groups().size(), Mode::sticking),
      f_(mode_.size()),
      f0_(mode_.size()),
      box_(mode_.size()),
      is_unknown_(mode_.size()),
      B_(mode_.size() * mode_.size()),
      a_(model.nv),
      tau_(model.nv),
      armature_(model.nv),
      b_(model.nv),
      no_forces_(model.parent.size()) {
  torques_.damping = torques_.coulomb = torques_.mimic = torques_.loop = b_;
  for (const double b : model.damping) has_damping_ = has_damping_ || b != 0;
  unknown_.reserve(mode_.size());
  sticking_dofs_.reserve(mode_.size());
}

void ForwardDynamics::set_friction(bool on) {
  friction_on_ = on;
  std::fill(torques_.damping.begin(), torques_.damping.end(), 0);
  std::fill(torques_.coulomb.begin(), torques_.coulomb.end(), 0);
}

void ForwardDynamics::serialize(StateArchive& archive) {
  archive.visit_fixed(mode_);
  for (const Mode mode : mode_)
    if (mode < Mode::sliding_minus || mode > Mode::sliding_plus)
      throw std::runtime_error("state data has an unknown friction mode");
}

double ForwardDynamics::friction_margin() const {
  double margin = 1;
  for (std::size_t k = 0; k < mode_.size(); ++k) {
    const CoulombFriction::MimicGroup& of = groups()[k];
    if (mode_[k] == Mode::sticking)
      margin = std::min(margin, std::min(f_[k] + of.plus, of.minus - f_[k]) / (of.plus + of.minus));
  }
  return margin;
}

void ForwardDynamics::zero_sticking_velocities(State<double>& x) const {
  if (!has_coulomb()) return;
  for (std::size_t k = 0; k < mode_.size(); ++k) {
    double& v = x.qd[groups()[k].dof];
    if (mode_[k] == Mode::sticking || v * static_cast<double>(mode_[k]) < 0) v = 0;
  }
}

const std::vector<std::size_t>& ForwardDynamics::sticking_dofs(const State<double>& x) noexcept {
  sticking_dofs_.clear();
  if (has_coulomb())
    for (std::size_t k = 0; k < mode_.size(); ++k)
      if (mode_[k] == Mode::sticking && x.qd[groups()[k].dof] == 0)
        sticking_dofs_.push_back(groups()[k].dof);
  return sticking_dofs_;
}

void ForwardDynamics::operator()(const State<double>& x, Forces<double>& forces,
                                 Workspace<double>& w, FrictionRule rule, double h) noexcept {
  const bool any_friction = friction_on_ && (has_damping_ || has_coulomb());
  if (!any_friction && !bilateral_.any()) return aba(*model_, x, forces, w);

  add_known_friction(x, h, rule, forces);
  std::swap(forces.tau, tau_), std::swap(forces.armature, armature_);
  aba(*model_, x, forces, w);
  std::swap(forces.tau, tau_), std::swap(forces.armature, armature_);

  if (bilateral_.any()) bilateral_.prepare(w);
  if (has_coulomb()) {
    a_ = w.qdd;
    if (bilateral_.any()) bilateral_.project_acceleration(a_);
    solve_unknown_friction(x, h, rule, w);
  }
  correct_accelerations(w);
  remove_rounding(h, w);
  if (h > 0 && has_damping_ && friction_on_)
    for (std::size_t d = 0; d < model_->nv; ++d)
      torques_.damping[d] -= h * model_->damping[d] * w.qdd[d];
}

// Input of ABA: damping (by end_of_step with armature h b), and Coulomb friction of sliding dofs.
void ForwardDynamics::add_known_friction(const State<double>& x, double h, FrictionRule rule,
                                         const Forces<double>& forces) {
  tau_ = forces.tau;
  armature_ = forces.armature;
  std::fill(torques_.coulomb.begin(), torques_.coulomb.end(), 0);
  if (!friction_on_) return;
  for (std::size_t d = 0; d < model_->nv; ++d) {
    torques_.damping[d] = -model_->damping[d] * x.qd[d];
    armature_[d] += h * model_->damping[d];
  }
  for (std::size_t k = 0; k < mode_.size(); ++k) {
    const CoulombFriction::MimicGroup& of = groups()[k];
    if (rule != FrictionRule::frozen_modes) mode_[k] = mode_of(x.qd[of.dof]);
    f_[k] = mode_[k] == Mode::sliding_plus    ? -of.plus
            : mode_[k] == Mode::sliding_minus ? of.minus
                                              : 0;
    friction_.distribute(k, f_[k], torques_.coulomb);
  }
  f0_ = f_;
  for (std::size_t d = 0; d < model_->nv; ++d) tau_[d] += torques_.damping[d] + torques_.coulomb[d];
}

// Friction is unknown for sticking dofs, and by end_of_step for dofs whose velocity would change
// sign. Repeated, as a solution may add such dofs; each group is added at most once.
void ForwardDynamics::solve_unknown_friction(const State<double>& x, double h, FrictionRule rule,
                                             Workspace<double>& w) {
  unknown_.clear();
  box_.rows.clear();
  std::fill(is_unknown_.begin(), is_unknown_.end(), 0);
  for (;;) {
    const std::size_t before = unknown_.size();
    for (std::size_t k = 0; k < mode_.size(); ++k) {
      if (is_unknown_[k]) continue;
      const std::size_t dof = groups()[k].dof;
      const double v = x.qd[dof] + h * (a_[dof] + qdd_of_unknown_friction(k));
      if (mode_[k] == Mode::sticking ||
          (rule == FrictionRule::end_of_step && v * static_cast<double>(mode_[k]) < 0))
        add_unknown(k, rule, w);
    }
    if (unknown_.size() == before) break;
    for (std::size_t r = before; r < unknown_.size(); ++r) {
      const std::size_t dof = groups()[unknown_[r]].dof;
      box_.rows[r].a = a_[dof] + (h > 0 ? x.qd[dof] / h : 0);
    }
    box_.solve();
  }
  using At = BoxLcp::At;
  for (std::size_t r = 0; r < unknown_.size(); ++r) {
    const std::size_t k = unknown_[r];
    const BoxLcp::Row& row = box_.rows[r];
    const CoulombFriction::MimicGroup& of = groups()[k];
    f_[k] = row.at == At::low ? -of.plus : row.at == At::high ? of.minus : f0_[k] + row.f;
    mode_[k] = row.at == At::low    ? Mode::sliding_plus
               : row.at == At::high ? Mode::sliding_minus
                                    : Mode::sticking;
  }
}

// qdd of the group's dof due to the solution for f - f0.
double ForwardDynamics::qdd_of_unknown_friction(std::size_t group) const {
  double sum = 0;
  for (std::size_t r = 0; r < unknown_.size(); ++r)
    sum += B_[group * mode_.size() + r] * box_.rows[r].f;
  return sum;
}

void ForwardDynamics::add_unknown(std::size_t group, FrictionRule rule, Workspace<double>& w) {
  const CoulombFriction::MimicGroup& of = groups()[group];
  std::fill(b_.begin(), b_.end(), 0);
  b_[of.dof] = 1;
  minv_times(*model_, b_, no_forces_, w);
  const double alone = w.y[of.dof];
  if (bilateral_.any()) bilateral_.project(w.y);
  const std::size_t r = unknown_.size();
  unknown_.push_back(group);
  is_unknown_[group] = 1;
  for (std::size_t k = 0; k < mode_.size(); ++k) B_[k * mode_.size() + r] = w.y[groups()[k].dof];
  const bool unlimited = rule == FrictionRule::frozen_modes;
  BoxLcp::Row row;
  row.low = unlimited ? -kUnlimited : -of.plus - f0_[group];
  row.high = unlimited ? kUnlimited : of.minus - f0_[group];
  box_.rows.push_back(row);
  for (std::size_t s = 0; s <= r; ++s)
    box_.B(r, s) = box_.B(s, r) = B_[unknown_[s] * mode_.size() + r];
  if (bilateral_.loops().any()) box_.B(r, r) += kRegularization * alone;
}

// Removes rounding from qdd of sticking dofs (exactly 0) and mimic joints.
void ForwardDynamics::remove_rounding(double h, Workspace<double>& w) const {
  if (h == 0 && has_coulomb())
    for (std::size_t k = 0; k < mode_.size(); ++k)
      if (mode_[k] == Mode::sticking) w.qdd[groups()[k].dof] = 0;
  for (const Mimic& m : model_->mimics) w.qdd[m.follower] = m.ratio * w.qdd[m.leader];
}

// Adds the effect of f - f0 and of the constraint forces to the accelerations of ABA.
void ForwardDynamics::correct_accelerations(Workspace<double>& w) {
  for (std::size_t d = 0; d < model_->nv; ++d) b_[d] = -torques_.coulomb[d];
  std::fill(torques_.coulomb.begin(), torques_.coulomb.end(), 0);
  bool changed = bilateral_.any();
  if (has_coulomb())
    for (std::size_t k = 0; k < mode_.size(); ++k) {
      friction_.distribute(k, f_[k], torques_.coulomb);
      changed = changed || f_[k] != f0_[k];
    }
  if (!changed) return;
  for (std::size_t d = 0; d < model_->nv; ++d) b_[d] += torques_.coulomb[d];
  if (bilateral_.any()) {
    bilateral_.solve(w.qdd, b_);
    std::fill(torques_.mimic.begin(), torques_.mimic.end(), 0);
    std::fill(torques_.loop.begin(), torques_.loop.end(), 0);
    bilateral_.add_forces(torques_.mimic, torques_.loop);
  } else {
    minv_times(*model_, b_, no_forces_, w);
  }
  const std::vector<double>& y = bilateral_.any() ? bilateral_.y() : w.y;
  const std::vector<Motion<double>>& dv = bilateral_.any() ? bilateral_.dv() : w.dv;
  for (std::size_t d = 0; d < model_->nv; ++d) w.qdd[d] += y[d];
  for (std::size_t i = 1; i < model_->parent.size(); ++i) w.a[i] += dv[i];
}

}  // namespace twinarm
