// Rows of the energy balance.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/dynamics/energy_momentum.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

// Programs use the kind of a row; its name is for output and recordings.
enum class EnergyRowKind {
  gravity,
  actuator,
  wrench,
  joint_damping,
  joint_friction,
  joint_limit,
  joint_mimic,
  limit_stabilisation,
  coupling_spring,
  coupling_damper,
  coupling_implicit,
  spring,          // of a scene: elastic part, damper, force law
  coupling_other,  // `as_printed`, `drive`, and the impulse of a coupling
  contact,         // impulse of a pair
  contact_normal,
  contact_friction,
  contact_impact,
  contact_stabilisation,
  constraint,
  constraint_stabilisation,
  sleep,
  tree,  // impulse through the root joint of a tree
  outside,
  numerical,
  earlier  // from a recording, or from a run before a change
};

// Name of the residual in recordings and JSON; always the last row.
inline constexpr const char* kNumericalRow = "numerical";

struct EnergyRow {
  EnergyRowKind kind = EnergyRowKind::earlier;
  std::string name;
  double work = 0;  // [J]
};

// A force that is not part of the scene, such as the lab's mouse spring, with its own energy and
// momentum account, which is added to that of the run.
class OutsideForce : public ForceSource, public Checkpointable {
 public:
  virtual std::string name() const = 0;  // of its rows
  // Accounts for a step of length h: states at its start, at the inner nodes, at its end;
  // `weights`: those of the quadrature rule over the step.
  virtual void book(double h, std::span<const double> weights, const State<double>& start,
                    const std::vector<State<double>>& inner, const State<double>& end) = 0;
  // Energy and momentum transferred since the start, by body.
  struct Given {
    int body = 0;
    EnergyMomentum exchange;
  };
  virtual const std::vector<Given>& given() const = 0;
  // Serializes the account; not part of a run's state before the force has acted.
  virtual void visit_books(StateArchive& memory) = 0;

  bool has_acted() const { return !given().empty(); }
  EnergyMomentum total() const {
    EnergyMomentum sum;
    for (const Given& part : given()) sum += part.exchange;
    return sum;
  }
};

}  // namespace twinarm
