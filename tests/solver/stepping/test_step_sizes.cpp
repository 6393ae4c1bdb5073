// Tables with a row per step are bounded before memory is taken; steps of extreme size end.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "solver/constraints/joint_limits.h"
#include "solver/forces/joint_stops.h"
#include "solver/stepping/simulation.h"
#include "solver/support/diagnostics.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("a table of steps is bounded: tiny steps and endless times are rejected") {
  CHECK(stored_steps(2, 1e-3) == 2000);
  CHECK(stored_steps(0.0025, 1e-3) == 3);
  CHECK(stored_steps(0, 1e-3) == 0);
  CHECK(stored_steps(10, 1e-6) == 10'000'000);
  CHECK(stored_steps(2, std::numeric_limits<double>::infinity()) == 0);
  for (const auto& [duration, h] :
       {std::pair{2.0, 1e-300}, {2.0, 1e-9}, {1e300, 1e-3}, {HUGE_VAL, 1e-3}, {NAN, 1e-3}})
    CHECK_THROWS_AS(stored_steps(duration, h), InputError);
}

TEST_CASE("steps of 1e-300 s and 1e300 s end, and are finite or say that they are not") {
  Random random(71);
  std::vector<TreeBody> bodies = random_bodies(random, 4, {JointType::revolute});
  for (TreeBody& body : bodies) body.properties.coulomb_plus = body.properties.coulomb_minus = 0.2;
  const Model<double> model = build(bodies);
  const State<double> start = random_state(random, model);
  for (const double h : {1e-300, 1e-200, 1e200, 1e300})
    for (const IntegratorFacts& facts : all_integrators)
      for (const int limited : {0, 1, 2}) {  // not, in steps of fixed size, event-driven
        if (limited > 0 && facts.integrator != Integrator::semi_implicit) continue;
        if (facts.integrator == Integrator::dopri5 && h > 1) continue;  // as long as its time
        CAPTURE(h);
        CAPTURE(facts.name);
        CAPTURE(limited);
        JointLimits limits(model);
        Simulation simulation(model, start);
        simulation.set_integrator(facts.integrator);
        for (int body = 1; limited > 0 && body < model.body_count(); ++body)
          limits.add(body, -10, 10);
        if (limited > 0) simulation.add(limits);
        if (limited > 1) simulation.locate_events();
        const StepReport report = simulation.step(h);
        bool finite = true;
        for (const auto* numbers : {&simulation.state().q, &simulation.state().qd})
          for (const double number : *numbers) finite = finite && std::isfinite(number);
        CHECK(report.finite == finite);
        if (h < 1) CHECK(report.ok());
      }
}
