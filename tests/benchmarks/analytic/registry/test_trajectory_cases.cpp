// All known motions of the list (benchmarks/analytic/support/trajectory_case.h).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/support/trajectory_case.h"

using namespace twinarm;

namespace {

template <class F>
void for_each_trajectory(F&& f) {
  for (const AnalyticCase& c : analytic_cases()) {
    if (!c.trajectory) continue;
    CAPTURE(std::string(c.name));
    CAPTURE(std::string(c.reference));
    f(c, *c.trajectory);
  }
}

const AnalyticCase& case_named(const std::string& name) {
  for (const AnalyticCase& c : analytic_cases())
    if (name == c.name) return c;
  FAIL("there is no case " << name);
  throw 0;
}

}  // namespace

TEST_CASE("known motions: every case meets its tolerance") {
  for_each_trajectory([](const AnalyticCase& c, const TrajectoryCase& motion) {
    const TrajectoryResult result = run_trajectory(motion, motion.integration);
    CAPTURE(result.seconds);
    CHECK(result.error <= c.tolerance);
  });
}

TEST_CASE("known motions: every case fails with 0.1 % more gravity or inertia") {
  for_each_trajectory([](const AnalyticCase& c, const TrajectoryCase& motion) {
    const double error = mutant_error(motion);
    CHECK(std::isfinite(error));
    CHECK(error > c.tolerance);
  });
}

TEST_CASE("known motions: a name for each reading, ascending times") {
  for_each_trajectory([](const AnalyticCase&, const TrajectoryCase& motion) {
    const CaseScene scene = motion.scene();
    const std::size_t seen = motion.observe(scene.model, scene.start).size();
    CHECK(seen == motion.readings.size());
    const bool has_events = motion.events.count > 0;
    CHECK(motion.times.empty() == has_events);
    const double first = has_events ? 1 : motion.times[0];
    CHECK(motion.reference(first).size() == seen + (has_events ? 1 : 0));
    for (std::size_t i = 1; i < motion.times.size(); ++i)
      CHECK(motion.times[i] > motion.times[i - 1]);
  });
}

TEST_CASE("known motions: times between two steps are reached to the order of the scheme") {
  for (const auto& [integrator, factor] :
       {std::pair{Integrator::rk4, 16.0}, {Integrator::verlet, 4.0}}) {
    const TrajectoryCase& swing = *case_named("B2").trajectory;  // times of whole seconds
    const double coarse = run_trajectory(swing, {integrator, 0.0124}).error;
    const double fine = run_trajectory(swing, {integrator, 0.0062}).error;
    CHECK(std::abs(coarse / fine / factor - 1) < 0.1);
    const double order = observed_order(swing, {integrator, 0.0031}).value_or(0);
    CHECK(std::abs(order - std::log2(factor)) < 0.1);
  }
}

TEST_CASE("known motions: a missing event, a missing reading or NAN fails") {
  TrajectoryCase swing = *case_named("B1-90").trajectory;
  swing.events.until = 1;
  CHECK(std::isnan(run_trajectory(swing, swing.integration).error));
  TrajectoryCase fewer = *case_named("B2").trajectory;
  fewer.observe = [](const Model<double>&, const State<double>& x) { return x.q; };
  CHECK(std::isnan(run_trajectory(fewer, fewer.integration).error));
  fewer.observe = [](const Model<double>&, const State<double>& x) {
    return CaseReadings{std::nan(""), x.qd[0]};
  };
  CHECK(std::isnan(run_trajectory(fewer, fewer.integration).error));
}

TEST_CASE("known motions: a recording has the start, every step and the energy") {
  const TrajectoryCase& swing = *case_named("B2").trajectory;
  std::vector<TrajectoryPoint> points;
  const TrajectoryResult result = run_trajectory(swing, {Integrator::euler, 0.01}, &points);
  REQUIRE(points.size() == 1001);
  CHECK(points.back().t == 10);
  double strayed = 0;
  for (const TrajectoryPoint& p : points)
    strayed = std::max(strayed, std::abs(p.energy - points[0].energy));
  // Euler's method adds energy: more than the initial kinetic energy.
  CHECK(result.energy_drift.value_or(0) > 0.1);
  CHECK(strayed > 1);
}

TEST_CASE("known motions: skipped cases have unique names and a reason") {
  for (const SkippedCase& skipped : skipped_cases()) {
    CAPTURE(std::string(skipped.name));
    CHECK(std::string(skipped.why).size() > 10);
    for (const AnalyticCase& c : analytic_cases()) CHECK(std::string(c.name) != skipped.name);
  }
}
