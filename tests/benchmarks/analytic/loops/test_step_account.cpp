// Work of constraints in a step (constraint_work.h).
#include <doctest/doctest.h>

#include <string>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "solver/constraints/joint_limits.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/stepping/simulation.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

Simulation closed_mechanism(const LoopCase& c, Integrator integrator,
                            bool enable_constraint_work = true) {
  Simulation simulation(c.model, c.start, {.enable_constraint_work = enable_constraint_work});
  simulation.set_integrator(integrator);
  for (const auto& source : c.sources) simulation.add(*source);
  simulation.set_loops(c.loops);
  return simulation;
}

double energy_now(const Simulation& s) {
  return kinetic_energy(s.mechanism().model(), s.state()) +
         potential_energy(s.mechanism().model(), s.state());
}

// Difference between accounts and the mechanism's energy gain, and the accounts, over some steps.
struct Sums {
  double gained = 0, loops = 0, stabilisation = 0;
};
Sums run_with_account(Simulation& simulation, double h, int steps) {
  Sums sums;
  const double start = energy_now(simulation);
  for (int n = 0; n < steps; ++n) {
    simulation.step(h);
    for (const EnergyMomentum& e : simulation.mechanism().account->loops()) sums.loops += e.work;
    for (const EnergyMomentum& e : simulation.mechanism().account->stabilisation())
      sums.stabilisation += e.work;
  }
  sums.gained = energy_now(simulation) - start;
  return sums;
}

}  // namespace

TEST_CASE("accounts: a step with an account allocates nothing and is bit-identical") {
  for (const LoopCase& c : {bricard(), windows(2), slider_crank()})
    for (const IntegratorFacts& facts : all_integrators) {
      CAPTURE(std::string(facts.name));
      Simulation one = closed_mechanism(c, facts.integrator);
      Simulation two = closed_mechanism(c, facts.integrator, false);
      CHECK(allocations_in([&] {
              for (int n = 0; n < 20; ++n) one.step(3e-3);
            }) == 0);
      for (int n = 0; n < 20; ++n) two.step(3e-3);
      CHECK(one.state().q == two.state().q);
      CHECK(one.state().qd == two.state().qd);
    }
}

TEST_CASE("accounts: stabilisation corrects the drift of rk4, and its work is counted") {
  // The error of a step is of order 5, both in and off the closed states: over a fixed time the
  // energy drift and its stabilised part both decrease by 16 and are of the same size.
  const LoopCase c = slider_crank();
  double last = 0;
  for (const double h : {8e-3, 4e-3}) {
    Simulation simulation = closed_mechanism(c, Integrator::rk4);
    const Sums sums = run_with_account(simulation, h, static_cast<int>(0.4 / h + 0.5));
    CHECK(sums.stabilisation != 0);
    CHECK(std::abs(sums.stabilisation) < 1e-2);
    if (last != 0) CHECK(std::abs(sums.stabilisation) < 0.12 * std::abs(last));
    last = sums.stabilisation;
  }
}

TEST_CASE(
    "accounts: a loop that nothing drives does no work in steps by impulses, but of first order") {
  // Accelerations give g'' = 0, impulses g' = 0: two first-order methods for one motion. The loop
  // is not driven, so its work decreases with h.
  const LoopCase c = slider_crank();
  double last = 0;
  for (const double h : {1e-3, 5e-4}) {
    Simulation plain = closed_mechanism(c, Integrator::semi_implicit);
    Simulation limited = closed_mechanism(c, Integrator::semi_implicit);
    JointLimits limits(c.model);
    limits.add(1, -1e3, 1e3);
    limited.add(limits);
    const int steps = static_cast<int>(0.2 / h + 0.5);
    const Sums by_force = run_with_account(plain, h, steps);
    const Sums by_impulse = run_with_account(limited, h, steps);
    CHECK(std::abs(by_impulse.gained - by_force.gained) < 20 * h);
    CHECK(std::abs(by_impulse.loops + by_impulse.stabilisation) < 20 * h);
    CHECK(by_impulse.loops != 0);
    if (last != 0) CHECK(std::abs(by_impulse.loops) < 0.6 * last);
    last = std::abs(by_impulse.loops);
  }
}
