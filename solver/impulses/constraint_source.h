// The plug for everything that constrains velocities by impulses: contacts, joint limits, locks.
//
// A step of h asks each source, in this order (constrained_step.h):
//   begin_step      once, with the kinematics at its start: find contacts, measure gaps
//   closes          before impacts: does anything hit within this step, at these velocities?
//   extend_detection    when velocities have jumped
//   add, take       Phase::impact, as often as something closes; Phase::step once;
//                   Phase::separate if one of them needs_position_correction
// A step that locates its events in time asks its events() for more: event_source.h.
// None of them may throw or allocate once warm.
#pragma once

#include "solver/dynamics/kinematics.h"
#include "solver/impulses/impulse_problem.h"
#include "solver/impulses/kinematic_trees.h"

namespace twinarm {

enum class Phase {
  impact,    // velocities jump: v0 are those before
  step,      // v0 are those at the end of the step without the impulses
  separate,  // v0 = 0, and v is a small motion [m, rad]: what penetrates is pushed apart
  // of event_driven_step.h alone:
  hit,  // as impact, of what touches now
  flow  // as step, of what is held; no gap may close
};

struct ConstraintFrame {
  const Kinematics& k;  // at the start of the step
  const KinematicTrees& trees;
  const State<double>& x;  // q at the start, qd before this phase
  Phase phase;
  double h;  // [s]
  // impact, by tree: as if every restitution of what touches it were 0
  const std::vector<char>* plastic = nullptr;
  const double* v = nullptr;  // velocities of x, in the order of the trees
  // impact: accelerations that go on until the gap is closed, in the order of the trees
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
  // Velocities have jumped to those of k: what is met now and was not before comes in, with a gap.
  // True where there is something new.
  virtual bool extend_detection(const Kinematics&, double /*h*/) noexcept { return false; }
  virtual bool needs_position_correction() const noexcept { return false; }
  // Adds its constraints, with the last impulses as a guess.
  virtual void add(const ConstraintFrame& frame, ImpulseProblem& problem) noexcept = 0;
  // The solution for them: the same constraints, from index `first` on.
  virtual void take(const ConstraintFrame& frame, const ImpulseProblem& problem,
                    std::size_t first) noexcept = 0;
  virtual EventSource* events() { return nullptr; }  // null: they cannot be located in time
};

}  // namespace twinarm
