// Forward dynamics with joint friction, mimic joints and loop closures:
//
//   M qdd = tau - C - b qd + f + A^T lambda,   A qdd = -gamma,
// C the joint-space bias force, f Coulomb friction (joint_friction.h), lambda the multipliers of
// mimic joints and loops (loop_forces.h). Cost: one ABA with all friction that does not depend on
// qdd, one prepare() and solve() of the multipliers, one minv_times per sticking dof, one for the
// correction; ABA alone without friction and constraints. No allocation after the constructor and
// ConstraintForceSolver::set_loops.
//
// Coulomb friction follows one of three rules:
//   current       direction of qd; a dof at rest sticks, or starts to slide with qdd != 0
//   end_of_step   direction of v' = v + h qdd of a semi-implicit step; damping is -b v'. A dof that
//                 friction can stop within the step gets v' = 0 (to rounding) and stays at rest.
//                 Damping is stable at every h (h b is added to D).
//   frozen_modes  each dof keeps the mode of the last call by another rule (sliding direction, or
//                 sticking without limit): qdd is smooth along a step, as Runge-Kutta and Newton's
//                 method require. friction_margin() < 0: a limit is exceeded
//                 (solver/integration/friction_events.h ends the step there).
#pragma once

#include <algorithm>
#include <vector>

#include "solver/forces/joint_friction.h"
#include "solver/loops/loop_forces.h"
#include "solver/model/model.h"
#include "solver/model/workspace.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class ForwardDynamics {
 public:
  // The model must outlive it.
  explicit ForwardDynamics(const Model<double>& model);
  void set_friction(bool on);  // off: no damping and no Coulomb friction

  enum class FrictionRule { current, end_of_step, frozen_modes };  // see above
  // With loops: call bilateral().loops().evaluate() at x first.
  // Writes w.qdd and w.a with all forces; w.u and w.pA contain only the friction that does not
  // depend on qdd. `forces` is modified during the call and restored. h [s]: step of end_of_step,
  // else 0.
  void operator()(const State<double>& x, Forces<double>& forces, Workspace<double>& w,
                  FrictionRule rule = FrictionRule::current, double h = 0) noexcept;

  // Of the last call, by velocity [N m, N].
  struct Torques {
    std::vector<double> damping, coulomb, mimic, loop;
  };
  const Torques& torques() const { return torques_; }
  const ConstraintForceSolver& bilateral() const { return bilateral_; }
  ConstraintForceSolver& bilateral() { return bilateral_; }

  // Modes of the last call by a rule other than frozen_modes.
  enum class Mode : signed char { sliding_minus = -1, sticking = 0, sliding_plus = 1 };
  bool has_coulomb() const { return friction_on_ && !friction_.groups().empty(); }
  const std::vector<CoulombFriction::MimicGroup>& groups() const { return friction_.groups(); }
  Mode mode(std::size_t group) const { return mode_[group]; }
  bool any_sticking() const {
    return has_coulomb() && std::find(mode_.begin(), mode_.end(), Mode::sticking) != mode_.end();
  }
  // Minimum distance of the sticking dofs' friction to its limits, relative to the width of the
  // limits; negative: a limit is exceeded. 1 if none is sticking.
  double friction_margin() const;
  // Independent dofs with zero velocity that are sticking.
  const std::vector<std::size_t>& sticking_dofs(const State<double>& x) noexcept;
  // Sets velocities of sticking dofs, and of dofs that move against their sliding mode, to zero.
  void zero_sticking_velocities(State<double>& x) const;
  void serialize(StateArchive& archive);

 private:
  void add_known_friction(const State<double>& x, double h, FrictionRule rule,
                          const Forces<double>& forces);
  void solve_unknown_friction(const State<double>& x, double h, FrictionRule rule,
                              Workspace<double>& w);
  void add_unknown(std::size_t group, FrictionRule rule, Workspace<double>& w);
  void correct_accelerations(Workspace<double>& w);
  void remove_rounding(double h, Workspace<double>& w) const;
  double qdd_of_unknown_friction(std::size_t group) const;

  const Model<double>* model_;
  bool has_damping_ = false;
  bool friction_on_ = true;
  CoulombFriction friction_;
  ConstraintForceSolver bilateral_;
  std::vector<Mode> mode_;      // by group
  std::vector<double> f_, f0_;  // by group: Coulomb friction, and its part that ABA got
  BoxLcp box_;                  // of the groups in unknown_, for f - f0
  std::vector<std::size_t> unknown_;
  std::vector<char> is_unknown_;
  std::vector<double> B_;               // by group, by unknown: d qdd / d friction
  std::vector<double> a_;               // by velocity: qdd with friction f0
  std::vector<double> tau_, armature_;  // by velocity: inputs of ABA with known friction
  Torques torques_;
  std::vector<double> b_;
  std::vector<std::size_t> sticking_dofs_;
  std::vector<Force<double>> no_forces_;
};

}  // namespace twinarm
