// Momentum balance by source, and the work of constraints.
//
// P and L: linear and angular momentum about the world's origin of all bodies that forces can move,
// without rotors. Over a run
//   P(t) - P(0) = sum of rows,      L(t) - L(0) = sum of rows.
// Rows are external impulses: gravity, wrenches, couplings (from the target robot), contacts and
// loops with fixed or prescribed bodies, joints to a fixed parent; then position corrections of
// constraints and contacts; and the residual `numerical`. Forces between two moving bodies cancel.
//
// Rows of a semi-implicit step are h times the forces at its start. For other integrators they are
// integrals over each step by the quadrature of the energy balance. The impulse through a joint to
// the ground is
//   d(momentum of its tree)/dt - all other forces on that tree
// from ABA's accelerations: sum of I a + v x* I v (RBDA 5.3), a_0 = -g, so without gravity; in
// event-driven steps from the change of the tree's momentum.
#pragma once

#include "app/accounting/energy_balance.h"
#include "app/scene/forces/add_contacts.h"

namespace twinarm {

struct MomentumRow {
  EnergyRowKind kind = EnergyRowKind::earlier;
  std::string name;
  Vector3 linear = Vector3::Zero();   // [N s]
  Vector3 angular = Vector3::Zero();  // [N m s]
};

class MomentumBalance {
 public:
  // All must outlive it; `couplings` may be null. `simulation` accounts for constraint work.
  MomentumBalance(const RobotInput& input, GivenForces& given, SceneCouplings* couplings,
                  Integrator integrator, bool locates_events, const Simulation& simulation,
                  PosedStates& poses);

  bool wants_inner() const { return rule_ == Rule::integral; }  // states at inner nodes
  // The step of h from the state of the last call (or the start) to `after`; weights of all nodes.
  // `by_limits`: SceneContacts::only_limits_were_passed().
  void add_step(double h, std::span<const double> weights, const std::vector<State<double>>& inner,
                const Simulation& after, bool by_limits);
  void serialize(StateArchive& memory);

  // Rows of the energy balance: `constraint/NAME`, `constraint/NAME/stabilisation`,
  // `joint/NAME/mimic`, `contact/stabilisation`, `joint/NAME/limit/stabilisation` (with several
  // limits `joint/limits/stabilisation`). `contacts` may be null.
  std::vector<EnergyRow> energy_rows(const Simulation& simulation,
                                     const SceneContacts* contacts) const;
  // `numerical` last. `contacts` and `outside` may be null.
  std::vector<MomentumRow> rows(const Simulation& simulation, const SceneContacts* contacts,
                                const OutsideForce* outside) const;

 private:
  // Evaluation at the start of the step; at quadrature nodes; sums of an event-driven step.
  enum class Rule { at_start, integral, located };
  struct Tree {  // connected to the ground by a joint
    std::string joint;
    std::vector<char> bodies;
  };
  // Indices into sums_: gravity, wrenches, springs, couplings, loops, trees.
  std::size_t wrench(std::size_t i) const { return 1 + i; }
  std::size_t spring(std::size_t i) const { return wrench(given_.wrenches().size()) + i; }
  std::size_t coupling(std::size_t c) const { return spring(input_.springs.size()) + c; }
  std::size_t loop(std::size_t l) const { return coupling(coupling_count_) + l; }
  std::size_t tree(std::size_t t) const { return loop(loop_count_) + t; }

  void find_trees();
  void add_given(double part, const State<double>& x);
  void add_couplings(double part, const State<double>& x, SceneCouplings::Side side);
  void add_coupling_impulses(double h, const State<double>& at, const State<double>& end);
  void add_loops(double part, const IntegrationState& at, const std::vector<double>& qd, double h);
  void add_trees(double part, const IntegrationState& at, const Kinematics& k);
  void add_impacts(const Simulation& after);
  EnergyMomentum contents(const std::vector<char>& of, const State<double>& x) const;
  void subtract_from_trees(const EnergyMomentum& e, int body, double sign,
                           std::vector<EnergyMomentum>& of_trees) const;

  const RobotInput& input_;
  GivenForces& given_;
  SceneCouplings* couplings_;
  Integrator integrator_;
  Rule rule_;
  std::size_t coupling_count_, loop_count_;
  std::vector<char> moved_;
  std::vector<Tree> trees_;
  std::vector<EnergyMomentum> sums_;
  std::vector<EnergyMomentum> stabilisation_;
  std::vector<double> mimics_;
  EnergyMomentum separation_, limit_separation_;  // of contacts; of steps with limits only
  bool sleeps_;
  EnergyMomentum sleep_;
  State<double> start_, now_;
  EnergyMomentum at_start_;
  PosedStates& poses_;
  std::optional<IntegrationState> copy_;
  mutable Workspace<double> w_;
};

}  // namespace twinarm
