// Solves impulse_problem.h: exact laws, whatever the number of redundant contacts.
//
// Outer rounds: the method of multipliers (Rockafellar 1976) with de Saxce's shift, which makes
// every inner problem convex. Inner: with multipliers and shifts held,
//   M (v - v0) = J^T p(u(v))
// are the conditions of min 1/2 |v - v0|_M^2 + sum_i phi_i(u_i), phi_i' = -p, which is smooth and
// strictly convex: Newton's method with an exact line search, on matrices
//   M + J^T D J,    D = -dp/du,
// whose blocks follow the contacts between trees (as in Castro, Permenter and Han 2022, where a
// compliance stands in place of the rounds). Redundant contacts do no harm, since M alone makes the
// matrix positive. A round ends with Newton steps whose shift follows u, as long as they come
// nearer. First of all the guess is tried: what has come to rest costs one check. A solution that
// had to stop a motion is no good guess for the step after, so that one is solved too. A small
// island that has one is first tried by newton_warm_start.cpp, and gets one more Newton step or two
// at the end, down to rounding. Where the rounds do not end soon, interior_point.cpp finds a start
// for them, and where that fails too, central_path.cpp; the best p of all that is tried counts.
// Islands (trees joined by constraints) are solved one by one. Deterministic.
#pragma once

#include <vector>

#include "solver/impulses/impulse_law.h"
#include "solver/impulses/impulse_problem.h"
#include "solver/linear_algebra/envelope_lu.h"
#include "solver/linear_algebra/second_order_cone.h"
#include "solver/support/state_archive.h"

namespace twinarm {

struct ImpulseReport {
  int islands = 0, solved = 0;  // solved: those whose guess did not do
  int rounds = 0, newton = 0;   // the most of any island
  int interior = 0;             // iterations of interior_point.cpp, the most of any island
  int path = 0;                 // steps of central_path.cpp on one path, the most of any island
  double residual = 0;          // largest of any constraint, law_residual() [m/s, rad/s]
  bool converged = true;
};

class ImpulseSolver {
 public:
  double good_guess = 5e-9;   // residual of a guess that will do [m/s]
  double accepted = 5e-9;     // residual of a solution that will do [m/s]
  double tolerance = 1e-10;   // residual that a solution aims at [m/s]
  int quick_newton = 12;      // steps before the start of interior_point.cpp is asked for,
  int quick_newton_few = 28;  // and of a small island, where a start costs as much as these
  int max_newton = 400;       // steps in all

  // Writes v of the problem, and p and u of its constraints.
  ImpulseReport solve(ImpulseProblem& problem);
  // Of the last solution: what is left of the laws that this tree is under [m/s].
  double residual_of(int tree) const { return residual_[static_cast<std::size_t>(tree)]; }
  // Which guesses are not to be trusted.
  void serialize(StateArchive& memory) { memory.visit(solve_again_); }

 private:
  struct Island {
    std::vector<int> trees, constraints;
  };
  void link_discs(const ImpulseProblem& problem);
  void factorise_trees(const ImpulseProblem& problem);
  void solve_tree(const ImpulseProblem& problem, int tree, double* f) const;
  void find_islands(const ImpulseProblem& problem);
  double relax(ImpulseProblem& problem, const Island& island);
  double settle(ImpulseProblem& problem, const Island& island);
  double solve_island(ImpulseProblem& problem, const Island& island, ImpulseReport& report);
  void run_rounds(ImpulseProblem& problem, const Island& island, int most, bool yields,
                  ImpulseReport& report);
  static bool is_warm(const ImpulseProblem& problem, const Island& island);
  double warm_start_newton(ImpulseProblem& problem, const Island& island, ImpulseReport& report);
  double semismooth_newton_step(ImpulseProblem& problem, const Island& island, double residual);
  double polish(ImpulseProblem& problem, const Island& island, double residual);
  void order(const ImpulseProblem& problem, const Island& island);
  void lay_out(const ImpulseProblem& problem, const Island& island);
  struct Gradient {
    double largest = 0, squared = 0;  // as velocities [m/s]; squared in the norm of diag(M)^-1
    double rounding = 0, noise = 0;   // what Newton's steps end at; of this what is no error
    double left() const { return largest <= noise ? 0 : largest; }
  };
  struct Round {
    int steps = 0;
    double left = 0;       // of M (v - v0) = J^T p, as a velocity [m/s]
    bool strayed = false;  // shifts that followed did not come nearer
  };
  Round solve_round(ImpulseProblem& problem, const Island& island, int most);
  double noise(const ImpulseProblem& problem, const Island& island);
  Gradient gradient(ImpulseProblem& problem, const Island& island, DeSaxceShift shift);
  void respond_disc(const ImpulseConstraint& c, int i);
  Gradient balance(const ImpulseProblem& problem, const Island& island);
  void find_direction(const ImpulseProblem& problem, const Island& island, bool symmetric);
  void assemble(const ImpulseProblem& problem, const Island& island, bool symmetric);
  void add_products(const ImpulseProblem& problem, const ImpulseConstraint& left,
                    const ImpulseConstraint& right, const Mat& D, bool symmetric);
  void add_block(const ImpulseProblem& problem, const ImpulseConstraint& left, int side_s,
                 const ImpulseConstraint& right, int side_t, bool symmetric);
  void move(ImpulseProblem& problem, const Island& island, double step);
  int interior_point_start(ImpulseProblem& problem, const Island& island);
  bool has_cone(const ImpulseProblem& problem, const ImpulseConstraint& c) const;
  double begin_centrally(ImpulseProblem& problem, const Island& island, int which);
  double measure_centrally(ImpulseProblem& problem, const Island& island, double& residual);
  void measure_cone(ImpulseConstraint& c, int i);
  void join_discs(const ImpulseProblem& problem, int contact);
  double direct_centrally(ImpulseProblem& problem, const Island& island, double s, bool correct);
  void solve_centrally(const ImpulseProblem& problem, const Island& island,
                       const std::vector<ConeVec>& r, double part);
  void hand_out_centrally(const ImpulseProblem& problem, const std::vector<ConeVec>& r);
  std::array<double, 2> change_across(int i, double dp_n, const std::array<double, 2>& dz) const;
  void move_centrally(ImpulseProblem& problem, const Island& island, double step);
  double step_length(const ImpulseProblem& problem, const Island& island);
  struct Path;
  int follow_path(ImpulseProblem& problem, const Island& island, int which);

  std::vector<double> factors_;          // of the blocks of M: L L^T, 1 / l_ii on the diagonal
  std::vector<MultiplierState> memory_;  // by constraint
  std::vector<double> rho0_;             // by constraint: 1 / J diag(M)^-1 J^T
  std::vector<Mat> D_;                   // by constraint
  std::vector<int> next_disc_;  // by contact and disc: the next disc of this contact, or -1
  struct Cross {                // -dp of constraint `of` / du of `by`
    int of, by;
    Mat D;
  };
  std::vector<Cross> crosses_;
  std::vector<Vec> u_, du_, p_, guess_p_, best_p_, round_p_;  // by constraint
  std::vector<double> f_, dv_, delta_, held_v_;               // by velocity
  std::vector<Island> islands_;
  std::size_t island_count_ = 0;
  std::vector<int> root_, island_of_;  // by tree
  std::vector<double> residual_;       // by tree, that of its island
  std::vector<char> solve_again_;      // by tree, that of its island's first tree
  std::vector<std::size_t> row_;       // by tree: its first row in matrix_
  std::vector<int> neighbour_begin_, neighbours_, order_, lowest_;
  std::vector<double> rhs_, DJ_;
  double rho_ratio_ = 0;  // rho / rho0 of the island that is being solved
  double noise_ = 0;      // for rho = rho0 [m/s]
  EnvelopeLu matrix_;
  // of interior_point.cpp, by constraint
  std::vector<int> cones_;
  double shift_part_ = 1;  // of mu |u_t| that counts
  double rounded_ = 0;     // the corner of |u_t| at rest, which the path rounds: a part of `corner`
  std::vector<ConeVec> x_, z_, dx_, dz_, d_, r_z_, right_, kept_;
  struct ConeTerms {    // ipm_equations.h
    double weight = 1;  // x o z = s weight e
    double arm = 0, corner = 0, slip = 0, A = 0, C = 0, n = 0;
    std::array<double, 2> h{}, l{};
    std::array<double, 3> S{};  // its entries aa, ab, bb
  };
  std::vector<ConeTerms> terms_;
  std::vector<ConeScaling> scaling_;
  std::vector<double> step_rhs_;
  // of central_path.cpp: directions, or a place, in v, x, z and s (of which it is a part)
  struct Turn {
    std::vector<double> v;
    std::vector<ConeVec> x, z;
    double s = 0;
  };
  Turn correction_, tangent_, last_, saved_;
  std::vector<ConeVec> d_z_;
};

}  // namespace twinarm
