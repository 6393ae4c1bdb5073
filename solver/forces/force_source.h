// Interface of force sources: couplings, springs, dampers; sources that are functions; the base of
// those made of springs.
//
// A step calls, in this order:
//   begin_step   once, with the kinematics at its start: evaluate targets, detect contacts
//   add_forces   at the start, or at every stage of a Runge-Kutta step
// Neither may throw or allocate.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"
#include "solver/support/checkpointable.h"
#include "solver/support/state_archive.h"

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

// From a function of state, kinematics and forces; it has no internal state.
class ForceLaw final : public ForceSource, public Checkpointable {
 public:
  using Law = std::function<void(const State<double>&, const Kinematics&, Forces<double>&)>;
  explicit ForceLaw(Law law) : law_(std::move(law)) {}
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    law_(x, k, forces);
  }

 private:
  Law law_;
};

// Force of a spring on the robot (D) towards its target (K) at the last evaluation.
struct SpringState {
  Vector3 p_K = Vector3::Zero(), p_D = Vector3::Zero();  // ends at target and robot, world [m]
  Vector3 force_W = Vector3::Zero();                     // force [N] or couple [N m] on the robot
  double size = 0;    // |force_W|; of a joint spring the signed joint force
  double m_star = 0;  // added inertia [kg, kg m^2]
};

// Base of couplings and joint stops. Provides the forces of the last evaluation, and their
// serialization.
class SpringSource : public ForceSource, public Checkpointable {
 public:
  // By spring. In six dimensions the forces of all springs, then the couples of all.
  const std::vector<SpringState>& readings() const { return readings_; }
  // Spring forces may be held over several steps. Overridden by laws with more state.
  void serialize(StateArchive& archive) override {
    for (SpringState& reading : readings_)
      archive.visit(reading.p_K, reading.p_D, reading.force_W, reading.size, reading.m_star);
  }

 protected:
  std::vector<SpringState> readings_;
};

}  // namespace twinarm
