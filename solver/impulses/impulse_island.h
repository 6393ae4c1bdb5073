// One island (trees joined by constraints) of impulse_problem.h: the momentum balance, the iterate
// (p and u of the constraints, v of the trees), the best iterate and the budget. The phases of
// island_solver.h share it.
#pragma once

#include <algorithm>

#include "solver/impulses/impulse_law.h"

namespace twinarm {

struct ImpulseAccuracy {
  double good_guess = 5e-9;  // residual of an accepted initial guess [m/s]
  double accepted = 5e-9;    // residual of an accepted solution [m/s]
  double tolerance = 1e-10;  // target residual of the iterations [m/s]
  double budget = 1e10;      // floating-point operations for one island, about
  void limit_to_default() {
    const double part = std::min(1.0, ImpulseAccuracy{}.accepted / accepted);
    good_guess *= part, accepted *= part, tolerance *= part;
  }
  bool is_to_rounding() const { return good_guess < tolerance; }  // event-driven steps
};

struct ImpulseReport {
  int solved = 0;  // islands whose initial guess was not accepted
  // Maximum over the islands:
  int sweeps = 0;       // of conjugate_sweeps.h
  int newton = 0;       // Newton steps
  int interior = 0;     // iterations of interior_point.cpp
  int path = 0;         // steps of central_path.cpp on one path
  double residual = 0;  // maximum law_residual() over the constraints [m/s, rad/s]
  bool converged = true;

  void add(const ImpulseReport& other);  // of other islands
};

class ImpulseIsland {
 public:
  struct Members {
    std::vector<int> trees, constraints;  // ascending
  };
  // Factorises the blocks of M. False: one is not positive definite.
  bool set(ImpulseProblem& in_problem, const Members& members, const ImpulseAccuracy& accuracy);

  const std::vector<int>& trees() const { return members_->trees; }
  const std::vector<int>& constraints() const { return members_->constraints; }
  ImpulseConstraint& constraint(int i) const {
    return problem->constraints()[static_cast<std::size_t>(i)];
  }
  // Small islands are solved exactly whatever the accuracy.
  static bool is_small(const Members& members) { return members.constraints.size() <= 8; }
  bool is_small() const { return is_small(*members_); }
  // f(index in v) for each velocity.
  template <class F>
  void for_each_velocity(F&& f) const {
    for (const int t : trees())
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem->size(t)); ++k)
        f(problem->first(t) + k);
  }

  // v = v0 + M^-1 J^T p and u = J v + b. Returns the residual of the laws.
  double apply_impulses();
  double apply_impulses(const std::vector<Vec>& p);  // the same with impulses p
  // Applied to accepted guesses, whose residual would otherwise accumulate over the steps of a body
  // at rest. Returns the residual.
  double projected_gradient_step();
  // Of impulses at the end of the budget: scales them so that they do not increase the energy.
  // Returns the residual.
  double scale_impulses();
  void keep_best(double residual);
  void update_multipliers();

  void zero_forces();
  void solve_tree(int tree, double* f) const;  // f := M^-1 f
  struct Imbalance {
    double largest = 0, squared = 0;  // as velocities [m/s]; squared in the norm of diag(M)^-1
  };
  Imbalance momentum_balance();  // balance = M (v - v0) - forces
  const double* change(int tree) const { return change_.data() + problem->first(tree); }
  void move(double step);  // v += step dv
  bool has_budget(double more = 0) const { return work + more <= wanted.budget; }

  ImpulseProblem* problem = nullptr;
  ImpulseAccuracy wanted;
  double work = 0;        // floating-point operations done, about
  double sweep_work = 0;  // of one sweep over the constraints
  double best = 0;        // residual of best_p
  // By constraint of the problem; only those of the island are used.
  std::vector<MultiplierState> multipliers;
  std::vector<double> rho0;    // 1 / J diag(M)^-1 J^T
  std::vector<int> next_disc;  // of a contact or disc: the next disc of this contact, or -1
  std::vector<Mat> D;          // -dp/du
  struct CouplingBlock {       // -dp of constraint `of` / du of `by`
    int of, by;
    Mat D;
  };
  std::vector<CouplingBlock> coupling;
  std::vector<Vec> best_p, p, u, du;
  // By velocity of the problem.
  std::vector<double> forces, balance, dv;
  std::vector<double> factors;  // of the blocks of M: L L^T, 1 / l_ii on the diagonal

 private:
  double inverse_inertia(const ImpulseConstraint& c) const;

  const Members* members_ = nullptr;
  std::vector<double> change_;    // v - v0 at momentum_balance()
  std::vector<double> factored_;  // the blocks of M of which `factors` are
};

}  // namespace twinarm
