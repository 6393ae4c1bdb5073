// G1, and the part of G2 on the energy that the schemes gain or lose.
#include "benchmarks/analytic/joints/golden_steps.h"

#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {

const std::array<GoldenSteps, 10>& golden_steps() {
  using enum Integrator;
  // clang-format off
  static const std::array<GoldenSteps, 10> all{{
      {euler, -1.4542586468839336, -1.910991855901703,
       {0.04923, 0.02463, 0.01232}, 48.11},
      {semi_implicit, -1.4140239721507901, -1.7993332855089053,
       {0.008997, 0.004498, 0.002249}, -0.03523},
      {semi_implicit_xv, -1.3960306392957011, -1.7993332855089053,
       {0.008997, 0.004498, 0.002249}, 0.04299},
      {verlet, -1.405085873500597, -1.7989637723982739,
       {5.856e-05, 1.464e-05, 3.66e-06}, -0.001947},
      {midpoint, -1.4052124376524113, -1.7983889145061638,
       {0.0001851, 4.511e-05, 1.113e-05}, 0.01116},
      {heun, -1.4051560758049801, -1.7986875338290331,
       {0.0001288, 3.074e-05, 7.503e-06}, 0.01217},
      {rk4, -1.4050273031405154, -1.7993090484649084,
       {8.384e-09, 5.033e-10, 3.081e-11}, -7.125e-07},
      {implicit_midpoint, -1.4049687399868869, -1.7996300100240135,
       {5.857e-05, 1.464e-05, 3.66e-06}, 0.0003859},
      {trapezoid, -1.4049101749531139, -1.7999266545133732,
       {0.0001171, 2.928e-05, 7.32e-06}, -0.0007679},
      {implicit_euler, -1.3557749142852238, -1.6957210499962863,
       {0.04925, 0.02464, 0.01232}, -9.809},
  }};
  // clang-format on
  return all;
}

namespace {

using namespace smooth_parts;

// ---- G1 ----

TrajectoryCase golden_motion(const GoldenSteps& row) {
  return {.scene = [] { return start_at(point_pendulum(), {std::numbers::pi / 2}, {0}); },
          .times = {1},
          .readings = {"angle [rad]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference = constantly({row.angle, row.rate}),
          .integration = {row.integrator, 0.01},
          .needs_its_integrator = true};
}
TrajectoryCase golden_energy(const GoldenSteps& row) {
  TrajectoryCase c = golden_motion(row);
  c.times = {100};
  c.readings = {"energy [J]"};
  c.observe = observe_energy;
  c.reference = constantly({row.energy});
  c.measure = relative_each;
  c.mutant = [](CaseScene& scene) { scene.model.gravity = 1.01 * scene.model.gravity; };
  return c;
}

}  // namespace

CaseFamily golden_steps_cases() {
  std::vector<AnalyticCase> all;
  for (const GoldenSteps& row : golden_steps())
    all.push_back(
        {std::string("G1-") + integrator_name(row.integrator), 1e-12, golden_motion(row)});
  // The reference energies have four digits.
  for (const GoldenSteps& row : golden_steps())
    all.push_back(
        {std::string("G2-energy-") + integrator_name(row.integrator), 5e-4, golden_energy(row)});
  return {360, all};
}

}  // namespace twinarm
