// The worked example of docs/develop/adding_a_case.md: 2 kg hang on a spring of 50 N/m, are
// held where it is slack, and let go. With w^2 = k / m,
//   z = -(g / w^2) (1 - cos w t).
// A case of the list would stand in benchmarks/analytic/ as it stands here, down to its last line.
#include <cmath>

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

using namespace smooth_parts;

constexpr double kHangingMass = 2, kSpringRate = 50;

CaseScene hanging_scene() {
  const BodyInertia mass{kHangingMass, Vector3::Zero(), Matrix3::Identity()};
  CaseScene s = at_rest(one_body(JointType::prismatic, Vector3::UnitZ(), mass));
  s.sources = {std::make_shared<JointEffort>([](double, double z) { return -kSpringRate * z; })};
  // Without this line the energy would be that of motion and gravity alone, and seem to drift.
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

// In benchmarks/ the file ends here; the tests that loop over the list do the rest.
#include <doctest/doctest.h>

#include "benchmarks/analytic/registry/analytic_cases.h"
#include "benchmarks/analytic/support/trajectory_case.h"

TEST_CASE("the example of a case: it keeps its tolerance and energy, its mistake does not") {
  using namespace twinarm;
  const AnalyticCase example = hanging_mass_cases().cases[0];
  const CaseResult result = run_case(example);
  CHECK(passes(example, result));
  CHECK(result.energy_drift.value_or(1) < 1e-9);
  CHECK(std::abs(result.order.value_or(0) - 4) < 0.1);
  CHECK(mutant_error(*example.trajectory) > example.tolerance);
}
