// First phase of island_solver.h: block Gauss-Seidel sweeps, each constraint
// solved exactly with the others held, accelerated as a nonlinear conjugate-gradient method
// (Silcowitz-Hansen, Niebe and Erleben 2010). A sweep costs a hundredth of a Newton step. Sweeps
// identify sticking and sliding in tens to hundreds of sweeps; towers of redundant contacts, whose
// errors decay slowly, are left to the phases that follow.
#pragma once

#include <array>
#include <vector>

#include "solver/impulses/impulse_island.h"

namespace twinarm {

class ConjugateSweeps {
 public:
  // Constants of the island for sweep().
  void start(ImpulseIsland& island);
  // One sweep: changes p of the constraints and v of the trees, which must satisfy the momentum
  // balance. Returns the maximum change of an impulse, as a velocity [m/s, rad/s].
  double sweep();

 private:
  // W: J M^-1 J^T of the constraint; inverse: of W. Of a cone, with p_n eliminated by u_n = 0:
  //   p_n = a - w . p_t,    S p_t + g = u_t.
  struct Local {
    Mat W{}, inverse{};
    std::array<double, 3> S{};  // aa, ab, bb
    std::array<double, 2> w{};
    double lambda = 0;  // of the last sliding solution: u_t = -lambda p_t
  };
  struct Sliding {  // |p_t| = mu (a - w . p_t), (S + lambda) p_t = -g
    double mu, a;
    std::array<double, 2> g;
  };
  void set_local(ImpulseConstraint& c, int i);
  Vec solve_constraint(const ImpulseConstraint& c, int i);
  Vec solve_cone(const ImpulseConstraint& c, Local& local, const Vec& q);
  Vec solve_disc(const ImpulseConstraint& c, Local& local, const Vec& q);
  static std::array<double, 2> slide(const Sliding& problem, Local& local);
  void extrapolate();

  ImpulseIsland* island_ = nullptr;
  ImpulseProblem* problem_ = nullptr;
  std::vector<double> Y_;                  // M^-1 J^T, laid out as J
  std::vector<Local> local_;               // by constraint
  std::vector<Vec> change_, direction_;    // by constraint
  std::vector<double> v_, v_direction_;    // by velocity: before the sweep; of direction_
  double squared_ = 0, last_squared_ = 0;  // changes of the last two sweeps
};

}  // namespace twinarm
