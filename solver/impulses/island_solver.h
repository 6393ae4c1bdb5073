// Solver of one island of impulse_problem.h, in phases; the best p is kept:
//   initial guess accepted (bodies at rest), unless the previous step had to stop a motion
//   start        of small islands from a guess Newton steps (newton_phase.h); else sweeps
//                (conjugate_sweeps.h), unless there are loops or a face rests on another, then
//                Newton steps. At coarse accuracy sweeps, after Newton steps where faces rest on
//                each other and the guess is nearly accepted
//   interior     interior_point.cpp as start of further Newton steps; then central_path.cpp, path
//                following from several starts
//   end          small islands are refined to rounding by Newton steps
// At the end of the budget the best p is used, scaled so that it does not increase the energy. Work
// is counted, not timed: deterministic.
#pragma once

#include "solver/impulses/conjugate_sweeps.h"
#include "solver/impulses/interior_phase.h"
#include "solver/impulses/newton_phase.h"

namespace twinarm {

class IslandSolver {
 public:
  static constexpr int kMaxNewton = 400;  // Newton steps of one start

  IslandSolver() = default;
  IslandSolver(const IslandSolver&) = delete;
  IslandSolver& operator=(const IslandSolver&) = delete;

  struct Request {
    ImpulseAccuracy accuracy;
    bool full = true;    // else: one start of the interior phase, then only a smaller residual
    bool again = false;  // in: the guess is not accepted; out: nor is the next one
    double work = 0;     // out: operations, about
  };
  // Sets v of the trees, and p and u of the constraints. Returns the residual.
  double solve(ImpulseProblem& problem, const ImpulseIsland::Members& members, Request& request,
               ImpulseReport& report);

 private:
  double run_phases(bool full, ImpulseReport& report);
  void try_other_starts(ImpulseReport& report);
  void run_sweeps(double max_sweeps, ImpulseReport& report);
  void start_small(ImpulseReport& report);
  void start_large(bool interior_follows, ImpulseReport& report);
  bool has_warm_start() const;
  bool suits_sweeps() const;
  bool is_solved() const { return island_.best <= island_.wanted.accepted; }
  bool is_exact() const;

  ImpulseIsland island_;
  NewtonMatrix matrix_;
  NewtonPhase newton_{island_, matrix_};
  InteriorPhase interior_{island_, matrix_};
  ConjugateSweeps sweeps_;
  double guess_residual_ = 0;
  std::vector<Vec> guess_p_, swept_p_;  // by constraint
};

}  // namespace twinarm
