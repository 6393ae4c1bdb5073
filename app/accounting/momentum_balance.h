// Where the momentum comes from, row by row, and what constraints did.
//
// P and L are the linear and the angular momentum, about the world's origin, of all that forces can
// move; rotors have none. Over a run
//   P(t) - P(0) = sum of rows,      L(t) - L(0) = sum of rows,
// rows being what acts from outside: gravity, wrenches, couplings (from the kinematic robot),
// contacts and loops with what does not move or moves by a law, joints whose parent stands still;
// then what projections and separations shifted; and `numerical`, the integrator's. What two
// moving bodies do to one another cancels, and has no row.
//
// A semi-implicit step is exact where the coordinates stand still, and its rows are h times what
// was found at its start. Others are integrals over each step, by the rule of the energy ledger,
// of forces at states that side steps find. What passes through a joint to the ground is
//   d(momentum of its tree)/dt - all else on that tree,
// by the accelerations of ABA: sum of I a + v x* I v (RBDA 5.3), a_0 = -g, so without gravity. In
// steps that locate events the momentum of the tree itself stands for that integral.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/accounting/energy_balance.h"
#include "app/scene/forces/add_contacts.h"
#include "app/scene/forces/reported_forces.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm {

struct MomentumRow {
  EnergyRowKind kind = EnergyRowKind::earlier;
  std::string name;
  Vector3 linear = Vector3::Zero();   // [N s]
  Vector3 angular = Vector3::Zero();  // [N m s]
};

class MomentumBalance {
 public:
  // All must outlive it; `couplings` may be null. `simulation` keeps an account.
  MomentumBalance(const RobotInput& input, const std::vector<GivenWrench>& wrenches,
                  SceneCouplings* couplings, Integrator integrator, bool locates_events,
                  const Simulation& simulation);

  // Whether forces at inner states are of use, and with which weights, the ends included.
  bool wants_inner() const { return rule_ == Rule::integral; }
  // A step of h, from the state of the last call (or the start), that `after` has just taken.
  // `by_limits`: SceneContacts::only_limits_were_passed().
  void add_step(double h, std::span<const double> weights, const std::vector<State<double>>& inner,
                const Simulation& after, bool by_limits);
  void serialize(StateArchive& memory);

  // Of the energy ledger: `constraint/NAME`, `constraint/NAME/stabilisation`, `joint/NAME/mimic`,
  // `contact/stabilisation`; of joint limits `joint/NAME/limit/stabilisation`, of several limits
  // `joint/limits/stabilisation`. `contacts` may be null.
  std::vector<EnergyRow> energy_rows(const Simulation& simulation,
                                     const SceneContacts* contacts) const;
  // `numerical` last. `contacts` and `outside` may be null.
  std::vector<MomentumRow> rows(const Simulation& simulation, const SceneContacts* contacts,
                                const OutsideForce* outside) const;

 private:
  // One evaluation at the start of the step; forces at nodes; or the sums of an event step.
  enum class Rule { at_start, integral, located };
  struct Tree {  // that stands on the ground by a joint
    std::string joint;
    std::vector<char> bodies;
  };
  // Gravity, then all wrenches, couplings, loops, trees.
  std::size_t wrench(std::size_t i) const { return 1 + i; }
  std::size_t coupling(std::size_t c) const { return wrench(wrenches_.size()) + c; }
  std::size_t loop(std::size_t l) const { return coupling(coupling_count_) + l; }
  std::size_t tree(std::size_t t) const { return loop(loop_count_) + t; }

  void find_trees();
  void add_given(double part, const State<double>& x);
  void add_couplings(double part, const State<double>& x, SceneCouplings::Side side);
  void add_pulls(double h, const State<double>& at, const State<double>& end);
  void add_loops(double part, const IntegrationState& at, const std::vector<double>& qd, double h);
  void add_trees(double part, const IntegrationState& at);
  void add_impacts(const Simulation& after);
  EnergyMomentum contents(const std::vector<char>& of, const State<double>& x) const;
  void subtract_from_trees(const EnergyMomentum& e, int body, double sign,
                           std::vector<EnergyMomentum>& of_trees) const;

  const RobotInput& input_;
  const std::vector<GivenWrench>& wrenches_;
  SceneCouplings* couplings_;
  Integrator integrator_;
  Rule rule_;
  std::size_t coupling_count_, loop_count_;
  std::vector<char> moved_;
  std::vector<Tree> trees_;
  std::vector<EnergyMomentum> sums_;  // by the places above
  std::vector<EnergyMomentum> stabilisation_;
  std::vector<double> mimics_;
  EnergyMomentum separation_,
      limit_separation_;  // of contacts; in steps where only limits were passed
  State<double> start_, now_;
  Kinematics k_, k_end_;
  mutable Workspace<double> w_;
};

}  // namespace twinarm
