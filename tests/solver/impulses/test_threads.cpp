#include <doctest/doctest.h>

#include "solver/impulses/impulse_solver.h"
#include "tests/solver/impulses/impulse_problems.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("the number of threads changes no bit of several islands, nor of the report") {
  const ImpulseProblem pyramids = side_by_side(struck_pyramid(1, 4), 12);
  ImpulseProblem alone = pyramids;
  ImpulseSolver one;
  one.threads = 1;
  const ImpulseReport expected = one.solve(alone);
  CHECK(expected.solved == 12);
  for (const unsigned threads : {2u, 3u, 16u}) {
    CAPTURE(threads);
    ImpulseSolver several;
    several.threads = threads;
    ImpulseProblem first = pyramids, problem = pyramids;
    several.solve(first);  // measures the work of the islands: the next solution uses the threads
    several = ImpulseSolver(several);
    ImpulseReport report = several.solve(problem);
    CHECK(std::equal(alone.v(0), alone.v(0) + alone.nv(), problem.v(0)));
    for (std::size_t i = 0; i < problem.constraints().size(); ++i)
      CHECK(problem.constraints()[i].p == alone.constraints()[i].p);
    CHECK(report.residual == expected.residual);
    CHECK(report.newton == expected.newton);
    CHECK(report.solved == 12);
    CHECK(report.converged);
  }
}
