#include "solver/loops/constrained_dynamics.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "solver/dynamics/dynamics.h"

namespace twinarm {
namespace {

using Mode = ForwardDynamics::Mode;
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
// Where a loop couples dofs that both rub, only a sum of their frictions is determined. A part of
// the diagonal of B this large makes the problem definite, and shares it out by the least squares;
// what is held then creeps by as little, and is stopped exactly (make_exact, settle).
constexpr double kSharing = 1e-10;

Mode mode_of(double v) {
  return v > 0 ? Mode::slides_plus : v < 0 ? Mode::slides_minus : Mode::held;
}

}  // namespace

ForwardDynamics::ForwardDynamics(const Model<double>& model)
    : model_(&model),
      friction_(model),
      bilateral_(model),
      mode_(friction_.families().size(), Mode::held),
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
  at_rest_.reserve(mode_.size());
}

void ForwardDynamics::set_friction(bool on) {
  friction_on_ = on;
  std::fill(torques_.damping.begin(), torques_.damping.end(), 0);
  std::fill(torques_.coulomb.begin(), torques_.coulomb.end(), 0);
}

bool ForwardDynamics::holds_any() const {
  return has_coulomb() && std::find(mode_.begin(), mode_.end(), Mode::held) != mode_.end();
}

double ForwardDynamics::slack() const {
  double least = 1;
  for (std::size_t k = 0; k < mode_.size(); ++k) {
    const CoulombFriction::MimicGroup& of = families()[k];
    if (mode_[k] == Mode::held)
      least = std::min(least, std::min(f_[k] + of.plus, of.minus - f_[k]) / (of.plus + of.minus));
  }
  return least;
}

void ForwardDynamics::settle(State<double>& x) const {
  if (!has_coulomb()) return;
  for (std::size_t k = 0; k < mode_.size(); ++k) {
    double& v = x.qd[families()[k].dof];
    if (mode_[k] == Mode::held || v * static_cast<double>(mode_[k]) < 0) v = 0;
  }
}

const std::vector<std::size_t>& ForwardDynamics::at_rest(const State<double>& x) noexcept {
  at_rest_.clear();
  if (has_coulomb())
    for (std::size_t k = 0; k < mode_.size(); ++k)
      if (mode_[k] == Mode::held && x.qd[families()[k].dof] == 0)
        at_rest_.push_back(families()[k].dof);
  return at_rest_;
}

void ForwardDynamics::operator()(const State<double>& x, Forces<double>& forces,
                                 Workspace<double>& w, Rule problem, double h) noexcept {
  const bool any_friction = friction_on_ && (has_damping_ || has_coulomb());
  if (!any_friction && !bilateral_.any()) return aba(*model_, x, forces, w);

  known_torques(x, h, problem, forces);
  std::swap(forces.tau, tau_), std::swap(forces.armature, armature_);
  aba(*model_, x, forces, w);
  std::swap(forces.tau, tau_), std::swap(forces.armature, armature_);

  a_ = w.qdd;
  if (bilateral_.any()) {
    bilateral_.prepare(w);
    bilateral_.project_acceleration(a_);
  }
  if (has_coulomb()) find_unknown(x, h, problem, w);
  correct(w);
  make_exact(h, w);
  if (h > 0 && has_damping_ && friction_on_)
    for (std::size_t d = 0; d < model_->nv; ++d)
      torques_.damping[d] -= h * model_->damping[d] * w.qdd[d];
}

// Friction that does not depend on qdd goes into ABA: damping (at the end of a step h b qdd of it
// as armature), and Coulomb friction of all that slides.
void ForwardDynamics::known_torques(const State<double>& x, double h, Rule problem,
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
    const CoulombFriction::MimicGroup& of = families()[k];
    if (problem != Rule::as_chosen) mode_[k] = mode_of(x.qd[of.dof]);
    f_[k] = mode_[k] == Mode::slides_plus    ? -of.plus
            : mode_[k] == Mode::slides_minus ? of.minus
                                             : 0;
    friction_.distribute(k, f_[k], torques_.coulomb);
  }
  f0_ = f_;
  for (std::size_t d = 0; d < model_->nv; ++d) tau_[d] += torques_.damping[d] + torques_.coulomb[d];
}

// Unknown is the friction of what is at rest; at the end of a step also of what would pass through
// rest: with those found others may, so it is looked again, each family at most once.
void ForwardDynamics::find_unknown(const State<double>& x, double h, Rule problem,
                                   Workspace<double>& w) {
  unknown_.clear();
  box_.rows.clear();
  std::fill(is_unknown_.begin(), is_unknown_.end(), 0);
  for (;;) {
    const std::size_t before = unknown_.size();
    for (std::size_t k = 0; k < mode_.size(); ++k) {
      if (is_unknown_[k]) continue;
      const std::size_t dof = families()[k].dof;
      const double v = x.qd[dof] + h * (a_[dof] + sum_of_changes(k));
      if (mode_[k] == Mode::held ||
          (problem == Rule::end_of_step && v * static_cast<double>(mode_[k]) < 0))
        add_unknown(k, problem, w);
    }
    if (unknown_.size() == before) break;
    for (std::size_t r = before; r < unknown_.size(); ++r) {
      const std::size_t dof = families()[unknown_[r]].dof;
      box_.rows[r].a = a_[dof] + (h > 0 ? x.qd[dof] / h : 0);
    }
    box_.solve();
  }
  using At = BoxLcp::At;
  for (std::size_t r = 0; r < unknown_.size(); ++r) {
    const std::size_t k = unknown_[r];
    const BoxLcp::Row& row = box_.rows[r];
    const CoulombFriction::MimicGroup& of = families()[k];
    f_[k] = row.at == At::low ? -of.plus : row.at == At::high ? of.minus : f0_[k] + row.f;
    mode_[k] = row.at == At::low    ? Mode::slides_plus
               : row.at == At::high ? Mode::slides_minus
                                    : Mode::held;
  }
}

// qdd of the family's dof due to the friction found so far.
double ForwardDynamics::sum_of_changes(std::size_t family) const {
  double sum = 0;
  for (std::size_t r = 0; r < unknown_.size(); ++r)
    sum += B_[family * mode_.size() + r] * box_.rows[r].f;
  return sum;
}

void ForwardDynamics::add_unknown(std::size_t family, Rule problem, Workspace<double>& w) {
  const CoulombFriction::MimicGroup& of = families()[family];
  std::fill(b_.begin(), b_.end(), 0);
  b_[of.dof] = 1;
  minv_times(*model_, b_, no_forces_, w);
  const double alone = w.y[of.dof];
  if (bilateral_.any()) bilateral_.project(w.y);
  const std::size_t r = unknown_.size();
  unknown_.push_back(family);
  is_unknown_[family] = 1;
  for (std::size_t k = 0; k < mode_.size(); ++k) B_[k * mode_.size() + r] = w.y[families()[k].dof];
  BoxLcp::Row row;
  row.low = problem == Rule::as_chosen ? -kUnlimited : -of.plus - f0_[family];
  row.high = problem == Rule::as_chosen ? kUnlimited : of.minus - f0_[family];
  box_.rows.push_back(row);
  for (std::size_t s = 0; s <= r; ++s)
    box_.B(r, s) = box_.B(s, r) = B_[unknown_[s] * mode_.size() + r];
  if (bilateral_.loops().any()) box_.B(r, r) += kSharing * alone;
}

// What is zero, or a follower's, but for rounding; so that what is held does not creep.
void ForwardDynamics::make_exact(double h, Workspace<double>& w) const {
  if (h == 0 && has_coulomb())
    for (std::size_t k = 0; k < mode_.size(); ++k)
      if (mode_[k] == Mode::held) w.qdd[families()[k].dof] = 0;
  for (const Mimic& m : model_->mimics) w.qdd[m.follower] = m.ratio * w.qdd[m.leader];
}

// Adds what the friction found and the constraints' forces do to what ABA left.
void ForwardDynamics::correct(Workspace<double>& w) {
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
    for (std::size_t d = 0; d < model_->nv; ++d) b_[d] += torques_.mimic[d] + torques_.loop[d];
  }
  minv_times(*model_, b_, no_forces_, w);
  for (std::size_t d = 0; d < model_->nv; ++d) w.qdd[d] += w.y[d];
  for (std::size_t i = 1; i < model_->parent.size(); ++i) w.a[i] += w.dv[i];
}

}  // namespace twinarm
