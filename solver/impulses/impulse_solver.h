// Solver of impulse_problem.h: exact friction cones and limits, any number of redundant contacts.
//
// Augmented Lagrangian (method of multipliers, Rockafellar 1976): with frozen multipliers and de
// Saxce shifts, the inner problem
//   M (v - v0) = J^T p(u(v))
// is the optimality condition of min 1/2 |v - v0|_M^2 + sum_i phi_i(u_i), phi_i' = -p, smooth and
// strictly convex: semismooth Newton with an exact line search on the matrices
//   M + J^T D J,    D = -dp/du,
// whose block pattern follows the contacts between trees (as in Castro, Permenter and Han 2022,
// with compliance instead of multipliers). M makes them positive definite for redundant contacts
// too. Each inner problem ends with Newton steps that differentiate the shift, while they converge.
//
// Per island (trees joined by constraints), in this order; the best p is kept:
//   initial guess accepted (bodies at rest), unless the previous step had to stop a motion
//   small islands: newton_warm_start.cpp from a guess
//   augmented-Lagrangian iterations; instead, in larger islands with a coarse accuracy or a small
//   budget: conjugate_sweeps.h
//   interior_point.cpp as start of further augmented-Lagrangian iterations
//   central_path.cpp, path following from several starts
// Small islands are refined to rounding by Newton steps. At the end of the budget the best p is
// used, scaled so that it does not increase the energy. Work is counted, not timed: deterministic.
#pragma once

#include <vector>

#include "solver/impulses/conjugate_sweeps.h"
#include "solver/impulses/impulse_law.h"
#include "solver/impulses/impulse_problem.h"
#include "solver/linear_algebra/envelope_lu.h"
#include "solver/linear_algebra/second_order_cone.h"
#include "solver/support/state_archive.h"

namespace twinarm {

struct ImpulseReport {
  int solved = 0;  // islands whose initial guess was not accepted
  // Maximum over the islands:
  int sweeps = 0;       // of conjugate_sweeps.h
  int newton = 0;       // Newton steps
  int interior = 0;     // iterations of interior_point.cpp
  int path = 0;         // steps of central_path.cpp on one path
  double residual = 0;  // maximum law_residual() over the constraints [m/s, rad/s]
  bool converged = true;
};

class ImpulseSolver {
 public:
  double good_guess = 5e-9;     // residual of an accepted initial guess [m/s]
  double accepted = 5e-9;       // residual of an accepted solution [m/s]
  double tolerance = 1e-10;     // target residual of the iterations [m/s]
  int quick_newton = 12;        // Newton steps before interior_point.cpp is tried,
  int quick_newton_small = 28;  // and of a small island
  int max_newton = 400;         // Newton steps of further iterations
  double budget = 1e10;         // floating-point operations for one island, about

  // Writes v of the problem, and p and u of its constraints. full: else, where one interior-point
  // start does not lead to a solution, the residual is only reduced.
  ImpulseReport solve(ImpulseProblem& problem, bool full = true);
  // Residual of the last solution in the island of this tree [m/s].
  double residual_of(int tree) const { return residual_[static_cast<std::size_t>(tree)]; }
  void serialize(StateArchive& archive) { archive.visit(solve_again_); }

 private:
  struct Island {
    std::vector<int> trees, constraints;
  };
  ImpulseConstraint& constraint(int i) const {
    return problem_->constraints()[static_cast<std::size_t>(i)];
  }
  // f(index in v, row in matrix_) for each velocity of the island.
  template <class F>
  void for_each_velocity(F&& f) const {
    for (const int t : island_->trees)
      for (std::size_t k = 0; k < static_cast<std::size_t>(problem_->size(t)); ++k)
        f(problem_->first(t) + k, row_[t] + k);
  }
  void link_discs();
  bool factorise_trees();
  void solve_tree(int tree, double* f) const;
  void find_islands();
  double projected_gradient_step();
  double apply_impulses();
  double apply_impulses(const std::vector<Vec>& p);
  double solve_island(ImpulseReport& report, bool full);
  void try_other_starts(ImpulseReport& report);
  bool has_budget(double more = 0) const { return work_ + more <= budget; }
  bool is_exact() const;
  void run_sweeps(double max_sweeps, ImpulseReport& report);
  double scale_impulses();
  void iterate(int max_steps, double rho, ImpulseReport& report);
  void keep_best(double residual);
  void run_augmented_lagrangian(int max_steps, ImpulseReport& report);
  void update_multipliers();
  void zero_forces();
  bool has_warm_start() const;
  double warm_start_newton(ImpulseReport& report);
  double semismooth_newton_step(double residual);
  bool is_exact_to_rounding() const { return good_guess < tolerance; }  // event-driven steps
  double refine_solution(double residual);
  void order();
  void count_work();
  void find_rows();
  void set_envelope();
  struct Gradient {
    double largest = 0, squared = 0;  // as velocities [m/s]; squared in the norm of diag(M)^-1
    double tolerance = 0;             // ends the Newton iteration
    double noise = 0;                 // rounding error
    double error() const { return largest <= noise ? 0 : largest; }
  };
  struct InnerResult {
    int steps = 0;
    double error = 0;  // of M (v - v0) = J^T p, as a velocity [m/s]
  };
  InnerResult solve_inner_problem(int max_steps);
  double rounding_error();
  Gradient gradient(DeSaxceShift shift);
  void project_disc(const ImpulseConstraint& c, int i);
  Gradient momentum_balance();
  void find_direction(bool symmetric);
  void assemble(bool symmetric);
  void add_products(const ImpulseConstraint& left, const ImpulseConstraint& right, const Mat& D,
                    bool symmetric);
  void add_block(const ImpulseConstraint& left, int side_s, const ImpulseConstraint& right,
                 int side_t, bool symmetric);
  void move(double step);
  int interior_point_start();
  bool has_cone(const ImpulseConstraint& c) const;
  double ipm_initialize(int start);
  double ipm_evaluate(double& residual);
  void ipm_evaluate_cone(ImpulseConstraint& c, int i);
  void ipm_couple_discs(int contact);
  double ipm_direction(double s, bool correct);
  void ipm_solve_kkt(const std::vector<ConeVec>& r, double factor);
  void ipm_back_substitute(const std::vector<ConeVec>& r);
  std::array<double, 2> tangential_dx(int i, double dp_n, const std::array<double, 2>& dz) const;
  void ipm_update(double step);
  double step_length();
  struct CentralPath;
  int follow_path(int start);

  ImpulseProblem* problem_ = nullptr;         // of the current call of solve()
  const Island* island_ = nullptr;            // whose equations are solved
  std::vector<double> factors_;               // of the blocks of M: L L^T, 1 / l_ii on the diagonal
  std::vector<MultiplierState> multipliers_;  // by constraint
  std::vector<double> rho0_;                  // by constraint: 1 / J diag(M)^-1 J^T
  std::vector<Mat> D_;                        // by constraint
  std::vector<int> next_disc_;  // by contact and disc: the next disc of this contact, or -1
  struct CouplingBlock {        // -dp of constraint `of` / du of `by`
    int of, by;
    Mat D;
  };
  std::vector<CouplingBlock> coupling_blocks_;
  std::vector<Vec> u_, du_, p_, guess_p_, swept_p_, best_p_, iterate_p_;  // by constraint
  std::vector<double> f_, dv_, delta_, convex_v_;                         // by velocity
  std::vector<Island> islands_;
  std::size_t island_count_ = 0;
  std::vector<int> root_, island_of_;  // by tree
  std::vector<double> residual_;       // by tree: of its island
  std::vector<char> solve_again_;      // by first tree of an island: do not accept the next guess
  std::vector<std::size_t> row_;       // by tree: first row in matrix_
  std::vector<int> neighbour_begin_, neighbours_, order_, lowest_;
  std::vector<double> rhs_, DJ_;
  // Floating-point operations, about: done in the current island, of a Newton step, of a sweep.
  double work_ = 0, newton_work_ = 0, sweep_work_ = 0;
  double rho_ratio_ = 0;       // rho / rho0 of the current island
  double best_ = 0;            // residual of best_p_ in this island
  double rounding_error_ = 0;  // for rho = rho0 [m/s]
  EnvelopeLu matrix_;
  bool has_envelope_ = false;  // matrix_ has that of the current island
  ConjugateSweeps sweeps_;
  // interior_point.cpp, by constraint
  std::vector<int> cones_;
  double shift_factor_ = 1;  // homotopy: factor of the de Saxce shift mu |u_t|
  double smoothing_ = 0;     // homotopy: smoothing of the kink of |u_t| at 0, relative to `kink`
  std::vector<ConeVec> x_, z_, dx_, dz_, d_, r_z_, right_, kept_;
  struct ConeTerms {  // ipm_equations.h
    double arm = 0, kink = 0, slip = 0, A = 0, C = 0, n = 0;
    std::array<double, 2> h{}, l{};
    std::array<double, 3> S{};  // entries aa, ab, bb
  };
  std::vector<ConeTerms> terms_;
  std::vector<ConeScaling> scaling_;
  std::vector<double> step_rhs_;
  // central_path.cpp: direction or point in v, x, z and s (directions: relative to s)
  struct Direction {
    std::vector<double> v;
    std::vector<ConeVec> x, z;
    double s = 0;
  };
  Direction correction_, tangent_, last_, saved_;
  std::vector<ConeVec> d_z_;
};

}  // namespace twinarm
