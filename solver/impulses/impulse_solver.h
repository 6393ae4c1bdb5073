// Solver of impulse_problem.h: exact friction cones and limits, any number of redundant contacts.
// Each island (trees joined by constraints) is solved alone, by island_solver.h; several at a time
// on several processors. The result does not depend on their number.
#pragma once

#include <memory>
#include <span>

#include "solver/impulses/impulse_island.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class IslandSolver;

class ImpulseSolver {
 public:
  ImpulseAccuracy accuracy;
  unsigned threads = 0;  // at most; 0: as many as processors

  ImpulseSolver();
  ImpulseSolver(const ImpulseSolver& other);  // without working memory
  ImpulseSolver& operator=(const ImpulseSolver& other);
  ~ImpulseSolver();

  // Writes v of the problem, and p and u of its constraints. full: else, where one interior-point
  // start does not lead to a solution, the residual is only reduced.
  ImpulseReport solve(ImpulseProblem& problem, bool full = true);
  // Of the last solution.
  std::span<const ImpulseIsland::Members> islands() const {
    return {islands_.data(), island_count_};
  }
  // Residual of the last solution in the island of this tree [m/s].
  double residual_of(int tree) const { return trees_[static_cast<std::size_t>(tree)].residual; }
  void serialize(StateArchive& archive) { archive.visit(solve_again_); }

 private:
  void find_islands(const ImpulseProblem& problem);
  std::size_t useful_threads() const;
  void solve_island(ImpulseProblem& problem, std::size_t island, bool full, IslandSolver& solver,
                    ImpulseReport& report);

  std::vector<ImpulseIsland::Members> islands_;
  std::size_t island_count_ = 0;
  std::vector<int> root_, island_of_;  // by tree
  struct TreeResult {
    double residual = 0, work = 0;  // of its island
  };
  std::vector<TreeResult> trees_;
  std::vector<char> solve_again_;  // by first tree of an island: do not accept the next guess
  // By thread.
  std::vector<std::unique_ptr<IslandSolver>> solvers_;
  std::vector<ImpulseReport> reports_;
};

}  // namespace twinarm
