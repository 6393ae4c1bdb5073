// Errors of the fixed-step integrators against an independent code (G1 of
// docs/reference/verification_cases.md), and the order of all integrators on mechanisms whose
// forces depend on velocity (C2) and whose coordinates are rotations (A2, A4).
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "benchmarks/analytic/support/analytic_case.h"

using namespace twinarm;

namespace {

struct GoldenErrors {
  Integrator integrator;
  std::array<double, 3> error;  // of the angle, h = 10, 5, 2.5 ms
};
constexpr GoldenErrors kGoldenErrors[] = {
    {Integrator::euler, {0.04923, 0.02463, 0.01232}},
    {Integrator::semi_implicit, {0.008997, 0.004498, 0.002249}},
    {Integrator::semi_implicit_xv, {0.008997, 0.004498, 0.002249}},
    {Integrator::verlet, {5.856e-05, 1.464e-05, 3.66e-06}},
    {Integrator::midpoint, {0.0001851, 4.511e-05, 1.113e-05}},
    {Integrator::heun, {0.0001288, 3.074e-05, 7.503e-06}},
    {Integrator::rk4, {8.384e-09, 5.033e-10, 3.081e-11}},
    {Integrator::implicit_midpoint, {5.857e-05, 1.464e-05, 3.66e-06}},
    {Integrator::trapezoid, {0.0001171, 2.928e-05, 7.32e-06}},
    {Integrator::implicit_euler, {0.04925, 0.02464, 0.01232}},
};

// A case of the list, checked at one time only.
TrajectoryCase case_at(const std::string& name, double time) {
  for (const CaseFamily& family : joint_cases())
    for (const AnalyticCase& known : family.cases) {
      if (name != known.name) continue;
      TrajectoryCase c = *known.trajectory;
      c.times = {time};
      c.scene = [scene = c.scene] {
        CaseScene plain = scene();
        plain.conserves = false;
        return plain;
      };
      return c;
    }
  FAIL("no case " << name);
  throw 0;
}

struct OrderCase {
  const char* name;
  double time, h;  // h of a method of order 1; n times as long for order n
};
constexpr OrderCase kOrderCases[] = {{"C2", 1, 0.001}, {"A2", 1, 0.01}, {"A4", 0.1, 2.5e-4}};

}  // namespace

TEST_CASE("pendulum from 90 degrees: errors at 1 s with three steps match the reference values") {
  CHECK(std::size(kGoldenErrors) == all_integrators.size() - 1);  // dopri5 has no fixed step
  TrajectoryCase pendulum = case_at("B2", 1);
  pendulum.measure = [](const CaseReadings& seen, const CaseReadings& exact) {
    return std::abs(seen[0] - exact[0]);
  };
  for (const GoldenErrors& row : kGoldenErrors) {
    CAPTURE(std::string(integrator_name(row.integrator)));
    double h = 0.01;
    for (const double error : row.error) {
      CHECK(run_trajectory(pendulum, {row.integrator, h}).error ==
            doctest::Approx(error).epsilon(1e-3));
      h /= 2;
    }
  }
}

TEST_CASE("error proportional to h^order over four halvings, all integrators") {
  for (const auto& [name, time, first_order_h] : kOrderCases) {
    const TrajectoryCase c = case_at(name, time);
    for (const IntegratorFacts& facts : all_integrators) {
      if (facts.integrator == Integrator::dopri5) continue;
      const std::string case_name(name);  // clang 14 captures no structured binding
      CAPTURE(case_name);
      CAPTURE(std::string(facts.name));
      const double h = time / std::round(time / (first_order_h * facts.order));
      const double coarse = run_trajectory(c, {facts.integrator, h}).error;
      const double fine = run_trajectory(c, {facts.integrator, h / 16}).error;
      CHECK(std::abs(std::log2(coarse / fine) / 4 - facts.order) < 0.1);
    }
  }
}

TEST_CASE("dopri5: the error is proportional to the tolerance over four decades") {
  for (const OrderCase& order : kOrderCases) {
    CAPTURE(std::string(order.name));
    const TrajectoryCase c = case_at(order.name, order.time);
    double low = 1e300, high = 0;
    for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
      const double error = run_trajectory(c, {Integrator::dopri5, order.time, tolerance}).error;
      low = std::min(low, error / tolerance);
      high = std::max(high, error / tolerance);
    }
    CHECK(high < 2 * low);
    CHECK(high < 50);
  }
}
