// Interface of sources of velocity constraints that act by impulses: contacts, joint limits, locks.
//
// A step calls, in this order (constrained_step.h):
//   begin_step           once, with the kinematics at its start: contact detection, gaps
//   has_closing_contact  before each impact, with the current velocities
//   extend_detection     after a velocity jump
//   add_constraints,     Phase::impact, while contacts close; Phase::step once;
//   read_impulses        Phase::position_correction if any source needs_position_correction()
// Event-driven steps also use events(): event_source.h.
// None of them may throw, or allocate when warm (simulation.h): out of memory ends the program.
#pragma once

#include "solver/constraints/kinematic_trees.h"
#include "solver/dynamics/kinematics.h"
#include "solver/impulses/impulse_problem.h"

namespace twinarm {

enum class Phase {
  impact,               // velocity jump; v0: velocities before
  step,                 // v0: velocities at the end of the step without impulses
  position_correction,  // v0 = 0, v is a small displacement [m, rad]
  // event_driven_step.h only:
  impact_at_event,  // as impact, for closed gaps only
  smooth            // as step, for the active set only
};

struct ConstraintFrame {
  const Kinematics& k;  // at the start of the step
  const KinematicTrees& trees;
  const State<double>& x;  // q at the start of the step, qd before this phase
  Phase phase;
  double h;  // [s]
  // impact, by tree: restitution 0 for all contacts of the tree
  const std::vector<char>* plastic = nullptr;
  const double* v = nullptr;  // velocities of x, in the order of the trees
  // impact: accelerations until the gap is closed, in the order of the trees
  const double* acceleration = nullptr;

  bool is_plastic(const ImpulseConstraint& c) const {
    for (const int t : c.tree)
      if (plastic && t != ImpulseConstraint::no_tree && (*plastic)[static_cast<std::size_t>(t)])
        return true;
    return false;
  }
};

class EventSource;

class ConstraintSource {
 public:
  virtual ~ConstraintSource() = default;
  virtual void begin_step(const Kinematics&, const State<double>&, double /*h*/) noexcept {}
  virtual bool has_closing_contact(const ConstraintFrame&) noexcept { return false; }
  // Adds contacts that can be reached after a velocity jump to that of k; true if there are any.
  virtual bool extend_detection(const Kinematics&, double /*h*/) noexcept { return false; }
  virtual bool needs_position_correction() const noexcept { return false; }
  // Adds constraints, with the last impulses as initial guess.
  virtual void add_constraints(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept = 0;
  // Reads the solution of the same constraints, from index `first` on.
  virtual void read_impulses(const ConstraintFrame& frame, const ImpulseProblem& problem,
                             std::size_t first) noexcept = 0;
  virtual EventSource* events() { return nullptr; }  // null: no event location
};

}  // namespace twinarm
