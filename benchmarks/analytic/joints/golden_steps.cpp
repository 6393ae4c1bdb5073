// G1, and the part of G2 on the energy that the schemes gain or lose.
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

// Results of each fixed-step integrator for a pendulum of 1 m released at 90 degrees, h = 10 ms, by
// an independent code.
struct GoldenSteps {
  Integrator integrator;
  double angle, rate;  // at 1 s
  double energy;       // after 100 s, initially 0 [J]
};
constexpr GoldenSteps golden_steps[] = {
    {Integrator::euler, -1.4542586468839336, -1.910991855901703, 48.11},
    {Integrator::semi_implicit, -1.4140239721507901, -1.7993332855089053, -0.03523},
    {Integrator::semi_implicit_xv, -1.3960306392957011, -1.7993332855089053, 0.04299},
    {Integrator::verlet, -1.405085873500597, -1.7989637723982739, -0.001947},
    {Integrator::midpoint, -1.4052124376524113, -1.7983889145061638, 0.01116},
    {Integrator::heun, -1.4051560758049801, -1.7986875338290331, 0.01217},
    {Integrator::rk4, -1.4050273031405154, -1.7993090484649084, -7.125e-07},
    {Integrator::implicit_midpoint, -1.4049687399868869, -1.7996300100240135, 0.0003859},
    {Integrator::trapezoid, -1.4049101749531139, -1.7999266545133732, -0.0007679},
    {Integrator::implicit_euler, -1.3557749142852238, -1.6957210499962863, -9.809},
};

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
  for (const GoldenSteps& row : golden_steps)
    all.push_back(
        {std::string("G1-") + integrator_name(row.integrator), 1e-12, golden_motion(row)});
  // The reference energies have four digits.
  for (const GoldenSteps& row : golden_steps)
    all.push_back(
        {std::string("G2-energy-") + integrator_name(row.integrator), 5e-4, golden_energy(row)});
  return {360, all};
}

}  // namespace twinarm
