// The known motions of the list (benchmarks/analytic/trajectory_case.h): all at once.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "benchmarks/analytic/analytic_case.h"
#include "benchmarks/analytic/run_trajectory.h"

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

}  // namespace

TEST_CASE("known motions: every case keeps its tolerance") {
  for_each_trajectory([](const AnalyticCase& c, const TrajectoryCase& motion) {
    const LaneResult result = run_lane(motion, motion.lane);
    CAPTURE(result.seconds);
    CHECK(result.error <= c.tolerance);
  });
}

TEST_CASE("known motions: a mistake of 0.1 % in gravity or inertia fails every case") {
  for_each_trajectory([](const AnalyticCase& c, const TrajectoryCase& motion) {
    const double error = mutant_error(motion);
    CHECK(std::isfinite(error));
    CHECK(error > c.tolerance);
  });
}

TEST_CASE("known motions: what is seen has a name each, and the times ascend") {
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
    CHECK(std::string(motion.statement).size() > 20);
  });
}

TEST_CASE("known motions: what is not run is listed by a name that no case has, and says why") {
  for (const SkippedCase& skipped : skipped_cases()) {
    CAPTURE(std::string(skipped.name));
    CHECK(std::string(skipped.why).size() > 10);
    for (const AnalyticCase& c : analytic_cases()) CHECK(std::string(c.name) != skipped.name);
  }
}
