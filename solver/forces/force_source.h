// Interface of force sources: couplings, springs, dampers.
//
// A step calls, in this order:
//   begin_step   once, with the kinematics at its start: evaluate targets, detect contacts
//   add_forces   at the start, or at every stage of a Runge-Kutta step
// Neither may throw or allocate.
#pragma once

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

// Time discretization of a spring-damper in a step of size h (docs/understand/coupling_laws.md).
enum class Discretization {
  explicit_,      // force at the start of the step
  semi_implicit,  // spring at the start, damper at the end: m* = h b
  implicit        // both at the end: m* = h b + h^2 k
};

class ForceSource {
 public:
  virtual ~ForceSource() = default;
  virtual void begin_step(const Kinematics&, double /*t*/, double /*h*/) noexcept {}
  virtual void add_forces(const State<double>&, const Kinematics&, Forces<double>&) noexcept = 0;
  virtual bool needs_semi_implicit() const { return false; }  // incompatible with other integrators
};

}  // namespace twinarm
