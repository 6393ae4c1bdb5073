// One row of the energy balance.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/dynamics/energy_momentum.h"
#include "solver/forces/force_source.h"
#include "solver/support/checkpointable.h"

namespace twinarm {

// What a row is of. Programs ask for this: the name of a row is for people, JSON and recordings.
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
  coupling_other,  // `as_printed`, `drive`, and the impulse of a coupling
  contact,         // impulse of a pair
  contact_normal,
  contact_friction,
  contact_impact,
  contact_stabilisation,
  constraint,
  constraint_stabilisation,
  tree,  // impulse through the joint that carries a tree
  outside,
  numerical,
  earlier  // read from a recording, or of what ran before a change
};

// In recordings and JSON; always the last row.
inline constexpr const char* kNumericalRow = "numerical";

struct EnergyRow {
  EnergyRowKind kind = EnergyRowKind::earlier;
  std::string name;
  double work = 0;  // [J]
};

// A force that no scene knows, such as a mouse's, with books of its own: they are added to those of
// the run, so that both ledgers close.
class OutsideForce : public ForceSource, public Checkpointable {
 public:
  virtual std::string name() const = 0;  // of its rows
  // A step of h that went from `start` by way of `inner` to `end`: the states that the ledger looks
  // at, with the weights of its rule for integrals over the step.
  virtual void book(double h, std::span<const double> weights, const State<double>& start,
                    const std::vector<State<double>>& inner, const State<double>& end) = 0;
  // What it did since the start, by bodies that it acted on.
  struct Given {
    int body = 0;
    EnergyMomentum exchange;
  };
  virtual const std::vector<Given>& given() const = 0;
  // Those, both ways. Until it has acted they have no part in what a run remembers.
  virtual void visit_books(StateArchive& memory) = 0;

  bool has_acted() const { return !given().empty(); }
  EnergyMomentum total() const {
    EnergyMomentum sum;
    for (const Given& part : given()) sum += part.exchange;
    return sum;
  }
};

}  // namespace twinarm
