// Forward dynamics of all that a Model says, and of closed loops: ABA, the joints' friction, mimic
// joints, loop closures.
//
//   M qdd = tau - h - b qd + f + A^T lambda,   A qdd = -gamma,
// f the Coulomb friction (joint_friction.h), lambda what keeps followers to their leaders and loops
// closed (loop_forces.h). One run of ABA with all friction that is known beforehand, minv_times
// once for every row of A and every dof whose friction is to be found, and once for the correction;
// a model with neither friction nor constraints costs ABA alone. No allocation after the
// constructor and ConstraintForceSolver::set_loops.
//
// Where velocity and time come in, there are three rules for f:
//   now          by qd; a dof at rest sticks, or slips from rest by a qdd != 0
//   end of step  of a semi-implicit step, v' = v + h qdd: f goes with v', and so does -b v'. A dof
//                that friction can stop within the step has v' = 0 to rounding: it comes to rest,
//                and stays. Damping is stable at every h (h b is added to D).
//   as chosen    each dof slides in the direction, or is held, as `now` found before: f is smooth
//                along a step, as Runge-Kutta and Newton need it. Held without limit; slack() tells
//                when the limit is passed (solver/integration/friction_events.h ends the step
//                there).
#pragma once

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
  // Off: as if no joint had damping or Coulomb friction.
  void set_friction(bool on);

  enum class Rule { now, end_of_step, as_chosen };  // of f, see above
  // Where there are loops: bilateral().loops().evaluate() at x comes first.
  // Afterwards w.qdd and w.a are the true accelerations; w.u and w.pA are those of ABA with the
  // friction that is known beforehand. `forces` is lent, and given back as it was. h [s] goes
  // with end_of_step, and is 0 otherwise.
  void operator()(const State<double>& x, Forces<double>& forces, Workspace<double>& w,
                  Rule problem = Rule::now, double h = 0) noexcept;

  // Of the last call, by velocity [N m, N]; zero where there is none.
  struct Torques {
    std::vector<double> damping, coulomb, mimic, loop;
  };
  const Torques& torques() const { return torques_; }
  const ConstraintForceSolver& bilateral() const { return bilateral_; }
  ConstraintForceSolver& bilateral() { return bilateral_; }

  // What the last call by another rule than as_chosen found.
  enum class Mode : signed char { slides_minus = -1, held = 0, slides_plus = 1 };
  bool has_coulomb() const { return friction_on_ && !friction_.families().empty(); }
  const std::vector<CoulombFriction::MimicGroup>& families() const { return friction_.families(); }
  Mode mode(std::size_t family) const { return mode_[family]; }
  bool holds_any() const;
  // How far the held dofs are from slipping, least of all of them, as a part of the whole width of
  // their limits; negative where one should slip. 1 where none is held.
  double slack() const;
  // The dofs that follow nobody, are at rest, and are held by the last call.
  const std::vector<std::size_t>& at_rest(const State<double>& x) noexcept;
  // Stops what the last call holds, and what slides against its mode, exactly.
  void settle(State<double>& x) const;
  void serialize(StateArchive& memory) { memory.visit_fixed(mode_); }

 private:
  void known_torques(const State<double>& x, double h, Rule problem, const Forces<double>& forces);
  void find_unknown(const State<double>& x, double h, Rule problem, Workspace<double>& w);
  void add_unknown(std::size_t family, Rule problem, Workspace<double>& w);
  void correct(Workspace<double>& w);
  void make_exact(double h, Workspace<double>& w) const;
  double sum_of_changes(std::size_t family) const;

  const Model<double>* model_;
  bool has_damping_ = false;
  bool friction_on_ = true;
  CoulombFriction friction_;
  ConstraintForceSolver bilateral_;
  std::vector<Mode> mode_;      // by family
  std::vector<double> f_, f0_;  // by family: Coulomb friction, and what ABA was given of it
  BoxLcp box_;                  // of the families in unknown_, for f - f0
  std::vector<std::size_t> unknown_;
  std::vector<char> is_unknown_;
  std::vector<double> B_;  // by family, by unknown: qdd of the one per friction of the other
  std::vector<double> a_;  // by velocity: qdd with the friction that ABA was given
  std::vector<double> tau_, armature_;  // by velocity: what ABA gets in place of forces'
  Torques torques_;
  std::vector<double> b_;
  std::vector<std::size_t> at_rest_;
  std::vector<Force<double>> no_forces_;
};

}  // namespace twinarm
