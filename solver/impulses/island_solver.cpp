#include "solver/impulses/island_solver.h"

#include <limits>

namespace twinarm {
namespace {

constexpr double kFirstRho = NewtonPhase::kFirstRho, kLargeRho = 1e4;
// Newton steps: before interior_point.cpp is tried, also of a small island; after it.
constexpr int kQuickNewton = 12, kQuickNewtonSmall = NewtonPhase::kFewSteps, kLargeNewton = 60;
constexpr int kRestartFactor = 4;  // times kMaxNewton
// Sweeps at first: of a small island without a guess; of a larger one, exactly; else so many, or
// the work of so many Newton steps.
constexpr double kColdSweeps = 20, kExactSweeps = 100;
constexpr double kFirstSweeps = 200, kSweepsPerNewton = 20;
// Newton steps that the budget must allow: to begin with them; for interior_point.cpp after sweeps.
constexpr double kAmple = 100, kInterior = 40;
// At coarse accuracy the residual is looked at after each kLook sweeps with changes below so many
// times the accuracy.
constexpr int kLook = 10;
constexpr double kLookFactor = 10;
// Residual of a guess of an island that is almost at rest, relative to the accuracy.
constexpr double kAlmostAtRest = 10;
constexpr double kSweepsToNewton = 1e-6;  // change in a sweep before Newton steps are tried [m/s]

}  // namespace

double IslandSolver::solve(ImpulseProblem& problem, const ImpulseIsland::Members& members,
                           Request& request, ImpulseReport& report) {
  const ImpulseAccuracy& wanted = request.accuracy;
  report.converged = island_.set(problem, members, wanted) && report.converged;
  double residual = island_.apply_impulses();
  const bool fails = !(residual <= wanted.good_guess);
  bool open = fails || (request.again && residual > 0.1 * wanted.tolerance);
  request.again = fails;
  if (!open && residual > wanted.tolerance) {
    residual = island_.projected_gradient_step();
    open = !(residual <= wanted.good_guess);  // can increase the residual of shared contacts
  }
  if (!open) return residual;
  ++report.solved;
  matrix_.set(island_);
  if (!(residual <= wanted.accepted)) island_.keep_best(residual);
  guess_residual_ = residual;
  residual = run_phases(request.full, report);
  if (!island_.has_budget() && !(residual <= wanted.accepted)) residual = island_.scale_impulses();
  const double required = wanted.is_to_rounding() ? wanted.tolerance : wanted.accepted;
  const bool affords_newton = residual > wanted.tolerance && island_.has_budget(3 * matrix_.work());
  if (island_.is_small() || (affords_newton && (is_exact() || !(residual <= required))))
    residual = newton_.refine(residual);
  // An error of this solution is a velocity, which the next impulses remove, but not those after
  // the next.
  request.again = request.again || residual > 10 * wanted.tolerance;
  request.work = island_.work;
  return residual;
}

bool IslandSolver::is_exact() const {
  return island_.wanted.accepted < kSweepsToNewton;
}

// Whether any contact has an impulse in the guess, or sticks in an event-driven step.
bool IslandSolver::has_warm_start() const {
  return std::ranges::any_of(island_.constraints(), [&](int i) {
    const ImpulseConstraint& c = island_.constraint(i);
    return (c.law == ConstraintType::coulomb_cone && c.p[0] > 0) ||
           (c.law == ConstraintType::bilateral && island_.wanted.is_to_rounding());
  });
}

// Not with loops and mimics, which sweeps hardly solve, nor where a face rests on another, whose
// impulses they would distribute in the order of its contacts: more than three contacts between two
// trees, and clearly more rows than velocities.
bool IslandSolver::suits_sweeps() const {
  std::size_t rows = 0, velocities = 0;
  int contacts = 0, most = 0;  // in sequence between two trees
  std::array<int, 2> last{};
  for (const int i : island_.constraints()) {
    const ImpulseConstraint& c = island_.constraint(i);
    if (c.law == ConstraintType::bilateral) return false;
    rows += static_cast<std::size_t>(c.rows);
    if (c.law != ConstraintType::coulomb_cone) continue;
    contacts = contacts > 0 && last == c.tree ? contacts + 1 : 1;
    most = std::max(most, contacts);
    last = c.tree;
  }
  island_.for_each_velocity([&](std::size_t) { ++velocities; });
  return most <= 3 || 5 * rows <= 6 * velocities;
}

// Phases until the residual is accepted. Sets the best p and returns its residual.
double IslandSolver::run_phases(bool full, ImpulseReport& report) {
  guess_p_.resize(island_.p.size()), swept_p_.resize(island_.p.size());
  for (const int i : island_.constraints()) guess_p_[i] = island_.constraint(i).p;
  const bool small = island_.is_small();
  const bool interior_follows = small || island_.has_budget(kInterior * matrix_.work());
  small ? start_small(report) : start_large(interior_follows, report);
  if (!interior_follows) return island_.apply_impulses(island_.best_p);
  if (is_solved()) return island_.best;
  report.interior = std::max(report.interior, interior_.solve());
  island_.keep_best(island_.apply_impulses());
  if (!is_solved()) newton_.solve(small ? kMaxNewton : kLargeNewton, kFirstRho, report);
  if (full && !is_solved()) try_other_starts(report);
  if (!is_solved()) {  // no solution found, or none there (Painleve): a small residual
    island_.apply_impulses(island_.best_p);
    run_sweeps(kFirstSweeps, report);
  }
  return island_.apply_impulses(island_.best_p);
}

void IslandSolver::start_small(ImpulseReport& report) {
  const bool warm = has_warm_start();
  if (const bool sweeps = !warm && suits_sweeps(); sweeps || warm) {
    if (sweeps) run_sweeps(kColdSweeps, report);
    if (!is_solved()) island_.keep_best(newton_.solve_near(report));
  }
  if (is_solved()) return;
  island_.apply_impulses(guess_p_);
  newton_.solve(kQuickNewtonSmall, kFirstRho, report);
}

void IslandSolver::start_large(bool interior_follows, ImpulseReport& report) {
  const bool exact = is_exact() && island_.has_budget(kAmple * matrix_.work());
  if (exact) {
    if (suits_sweeps()) run_sweeps(kExactSweeps, report);
    if (!is_solved()) newton_.solve(kQuickNewton, kFirstRho, report);
  } else {
    // An island that hardly changes: after a good solution its next guesses are accepted.
    if (!suits_sweeps() && guess_residual_ <= kAlmostAtRest * island_.wanted.accepted &&
        island_.has_budget(kQuickNewton * matrix_.work())) {
      newton_.solve(kLargeNewton, kFirstRho, report);
      if (is_solved()) return;
      island_.apply_impulses(guess_p_);
    }
    const double as_newton = kSweepsPerNewton * matrix_.work() / island_.sweep_work;
    run_sweeps(interior_follows ? std::max(kFirstSweeps, as_newton)
                                : std::numeric_limits<double>::infinity(),
               report);
  }
}

void IslandSolver::try_other_starts(ImpulseReport& report) {
  const auto goes_on = [&] { return !is_solved() && island_.has_budget(); };
  const bool small = island_.is_small();
  const auto from_path = [&](int start, int max_steps) {
    report.path = std::max(report.path, interior_.follow_path(start));
    island_.keep_best(island_.apply_impulses());
    if (!is_solved()) newton_.solve(max_steps, kFirstRho, report);
  };
  if (!small) from_path(0, kLargeNewton);
  // A body between two surfaces may slide, or jam with unbounded impulses. The interior-point start
  // leads to jamming even if a small gap excludes it: also iterate from the guess.
  for (const double rho : {kFirstRho, kLargeRho}) {
    if (!goes_on()) break;
    island_.apply_impulses(guess_p_);
    newton_.solve(kMaxNewton, rho, report);
  }
  for (int start = small ? 0 : 1; start < InteriorPhase::kStarts && goes_on(); ++start)
    from_path(start, kMaxNewton);
  // Restarts from the best p while the residual decreases.
  for (double before = 0; goes_on() && (before == 0 || island_.best < 0.5 * before);) {
    before = island_.best;
    island_.apply_impulses(island_.best_p);
    newton_.solve(kRestartFactor * kMaxNewton, kFirstRho, report);
  }
}

// From p of the constraints.
void IslandSolver::run_sweeps(double max_sweeps, ImpulseReport& report) {
  sweeps_.start(island_);
  bool try_newton = is_exact();
  int sweeps = 0;
  for (; sweeps < max_sweeps && island_.has_budget() && !is_solved(); ++sweeps) {
    const double change = sweeps_.sweep();
    island_.work += island_.sweep_work;
    const bool ends =
        try_newton && change <= kSweepsToNewton && island_.has_budget(2 * matrix_.work());
    const double accepted = island_.wanted.accepted;
    const bool looks =
        !is_exact() && sweeps % kLook == kLook - 1 && change <= kLookFactor * accepted;
    if (!ends && !looks && change > accepted) continue;
    sweeps_.write_impulses();
    island_.keep_best(island_.apply_impulses());
    if (!ends || is_solved()) continue;
    try_newton = false;
    for (const int i : island_.constraints()) swept_p_[i] = island_.constraint(i).p;
    island_.keep_best(newton_.solve_near(report));
    if (!is_solved()) island_.apply_impulses(swept_p_);
  }
  report.sweeps = std::max(report.sweeps, sweeps);
  if (is_solved()) return;
  sweeps_.write_impulses();
  island_.keep_best(island_.apply_impulses());
}

}  // namespace twinarm
