// The worked example of docs/develop/adding_a_case.md: 2 kg on a spring of 50 N/m are
// released with the spring unstretched. With w^2 = k / m,
//   z = -(g / w^2) (1 - cos w t).
// The same text in a file of benchmarks/analytic/ is a case of the list.
#include <cmath>

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

constexpr double kHangingMass = 2, kSpringRate = 50;

CaseScene hanging_scene() {
  const BodyInertia mass{kHangingMass, Vector3::Zero(), Matrix3::Identity()};
  CaseScene s = at_rest(one_body(JointType::prismatic, Vector3::UnitZ(), mass));
  s.sources = {joint_effort([](double, double z) { return -kSpringRate * z; })};
  // Potential energy of the spring; without it the energy appears to drift.
  s.stored = [](const State<double>& x) { return kSpringRate / 2 * x.q[0] * x.q[0]; };
  return s;
}

CaseReadings hanging_reference(double t) {
  const double w = std::sqrt(kSpringRate / kHangingMass), sag = kGravity / (w * w);
  return {-sag * (1 - std::cos(w * t)), -sag * w * std::sin(w * t)};
}

TrajectoryCase hanging_motion() {
  return {.scene = hanging_scene,
          .times = {1, 2, 10},
          .readings = {"z [m]", "speed [m/s]"},
          .observe = joint_state(),
          .reference = hanging_reference};
}

}  // namespace

CaseFamily hanging_mass_cases() {
  return {155, {{"X1", 1e-8, hanging_motion()}}};
}

}  // namespace twinarm

// In benchmarks/ the file ends here; the tests of the list cover it.
#include <doctest/doctest.h>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/support/trajectory_case.h"

TEST_CASE("example case: tolerance and energy are met, the mutant fails") {
  using namespace twinarm;
  const AnalyticCase example = hanging_mass_cases().cases[0];
  const CaseResult result = run_case(example);
  CHECK(passes(example, result));
  CHECK(result.energy_drift.value_or(1) < 1e-9);
  CHECK(std::abs(result.order.value_or(0) - 4) < 0.1);
  CHECK(mutant_error(*example.trajectory) > example.tolerance);
}
