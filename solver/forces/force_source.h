// The plug for everything that pushes: couplings, springs, contact laws.
//
// A step asks each source, in this order:
//   begin_step   once, with the kinematics at its start: look at targets, find contacts, remember
//   add_forces   at the start, or at every stage of a Runge-Kutta step
//   refine       after the accelerations are known: true asks for another round of add_forces and
//                ABA (a law that is nonlinear at the end of the step); at most kMaxRounds rounds
// None of them may throw or allocate.
#pragma once

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// How a spring-damper enters a step of size h (docs/understand/coupling_laws.md).
enum class Discretization {
  explicit_,      // force at the start of the step
  semi_implicit,  // spring at the start, damper at the end: m* = h b
  implicit        // both at the end: m* = h b + h^2 k
};

class ForceSource {
 public:
  static constexpr int kMaxRounds = 12;

  virtual ~ForceSource() = default;
  virtual void begin_step(const Kinematics&, double /*t*/, double /*h*/) noexcept {}
  virtual void add_forces(const State<double>&, const Kinematics&, Forces<double>&) noexcept = 0;
  virtual bool refine(const Kinematics&, const Workspace<double>&) noexcept { return false; }
  virtual bool needs_semi_implicit() const { return false; }  // refuses Runge-Kutta stages
  // Whether refine() may say true. A step with constraints has one round, and refuses it.
  virtual bool needs_rounds() const { return false; }
};

}  // namespace twinarm
