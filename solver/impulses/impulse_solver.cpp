#include "solver/impulses/impulse_solver.h"

#include <atomic>
#include <future>
#include <numeric>
#include <system_error>
#include <thread>

#include "solver/impulses/island_solver.h"

namespace twinarm {
namespace {

// Operations of islands that are worth the start of a thread (0.2 ms).
constexpr double kThreadWork = 5e5;

}  // namespace

ImpulseSolver::ImpulseSolver() = default;
ImpulseSolver::~ImpulseSolver() = default;
ImpulseSolver::ImpulseSolver(const ImpulseSolver& other) {
  *this = other;
}
ImpulseSolver& ImpulseSolver::operator=(const ImpulseSolver& other) {
  accuracy = other.accuracy, threads = other.threads;
  trees_ = other.trees_, solve_again_ = other.solve_again_;
  return *this;
}

ImpulseReport ImpulseSolver::solve(ImpulseProblem& problem, bool full) {
  find_islands(problem);
  if (problem.tree_count() > 0) std::copy_n(problem.v0(0), problem.nv(), problem.v(0));
  solve_again_.resize(static_cast<std::size_t>(problem.tree_count()));
  const std::size_t count = useful_threads();
  trees_.assign(solve_again_.size(), {});
  while (solvers_.size() < count) solvers_.push_back(std::make_unique<IslandSolver>());
  reports_.assign(count, {});
  std::atomic<std::size_t> next{0};
  const auto work = [&](std::size_t thread) {
    for (std::size_t i; (i = next++) < island_count_;)
      solve_island(problem, i, full, *solvers_[thread], reports_[thread]);
  };
  std::vector<std::future<void>> others;
  try {
    for (std::size_t k = 1; k < count; ++k)
      others.push_back(std::async(std::launch::async, work, k));
  } catch (const std::system_error&) {  // no more threads: those that run do the work
  }
  work(0);
  for (std::future<void>& other : others) other.get();
  for (std::size_t k = 1; k < count; ++k) reports_[0].add(reports_[k]);
  return reports_[0];
}

// One, unless the islands beside the largest took long in the last step.
std::size_t ImpulseSolver::useful_threads() const {
  double sum = 0, largest = 0;
  if (threads != 1 && trees_.size() == solve_again_.size())
    for (std::size_t i = 0; i < island_count_; ++i) {
      const double work = trees_[static_cast<std::size_t>(islands_[i].trees.front())].work;
      sum += work, largest = std::max(largest, work);
    }
  if (sum - largest < kThreadWork) return 1;
  const std::size_t most = threads > 0 ? threads : std::thread::hardware_concurrency();
  return std::clamp<std::size_t>(most, 1, island_count_);
}

void ImpulseSolver::solve_island(ImpulseProblem& problem, std::size_t island, bool full,
                                 IslandSolver& solver, ImpulseReport& report) {
  const ImpulseIsland::Members& members = islands_[island];
  char& again = solve_again_[static_cast<std::size_t>(members.trees.front())];
  IslandSolver::Request request{accuracy, full, full && again != 0};
  if (ImpulseIsland::is_small(members)) request.accuracy.limit_to_default();
  const double residual = solver.solve(problem, members, request, report);
  if (full) again = request.again;
  for (const int t : members.trees) trees_[static_cast<std::size_t>(t)] = {residual, request.work};
  report.residual = nan_max(report.residual, residual);
  report.converged = report.converged && residual <= accuracy.accepted;
}

// Union-find over the constraints; members of an island are ascending.
void ImpulseSolver::find_islands(const ImpulseProblem& problem) {
  constexpr int world = ImpulseConstraint::no_tree;
  const auto trees = static_cast<std::size_t>(problem.tree_count());
  root_.resize(trees);
  std::iota(root_.begin(), root_.end(), 0);
  const auto find = [&](int t) {
    while (root_[t] != t) t = root_[t] = root_[root_[t]];
    return t;
  };
  for (const ImpulseConstraint& c : problem.constraints())
    if (c.tree[0] != world && c.tree[1] != world) {
      const int a = find(c.tree[0]), b = find(c.tree[1]);
      root_[std::max(a, b)] = std::min(a, b);
    }
  island_of_.assign(trees, -1);
  island_count_ = 0;
  const auto island_at = [&](int tree) -> ImpulseIsland::Members& {
    int& island = island_of_[find(tree)];
    if (island < 0) {
      island = static_cast<int>(island_count_++);
      if (islands_.size() < island_count_) islands_.emplace_back();
      islands_[island].trees.clear(), islands_[island].constraints.clear();
    }
    return islands_[island];
  };
  for (std::size_t i = 0; i < problem.constraints().size(); ++i) {
    const ImpulseConstraint& c = problem.constraints()[i];
    if (const int t = c.tree[0] != world ? c.tree[0] : c.tree[1]; t != world)
      island_at(t).constraints.push_back(static_cast<int>(i));
  }
  for (std::size_t t = 0; t < trees; ++t)  // trees without constraints keep v0
    if (const int island = island_of_[find(static_cast<int>(t))]; island >= 0)
      islands_[island].trees.push_back(static_cast<int>(t));
}

}  // namespace twinarm
