// The mechanisms of loop_cases.h, run with rk4 at their step, as cases of the list.
#include "benchmarks/analytic/loop_runs.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/loop_cases.h"
#include "solver/dense_algebra.h"
#include "solver/energy.h"
#include "solver/loop_assembly.h"
#include "solver/simulation.h"

namespace twinarm {
namespace {

double error_of(const std::vector<double>& found, const std::vector<double>& reference) {
  double error = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    error = std::max(error, std::abs(found[i] - reference[i]));
  return error;
}

// The largest error of all readings at all times.
CaseResult run(const LoopCase& c) {
  Simulation simulation(c.model, c.start);
  simulation.set_integrator(Integrator::rk4);
  if (c.source) simulation.add(*c.source);
  simulation.set_loops(c.loops);
  const auto kinetic = [&] { return kinetic_energy(c.model, simulation.state()); };
  const auto energy = [&] { return kinetic() + potential_energy(c.model, simulation.state()); };
  const double start = energy();
  double strayed = 0, most_kinetic = kinetic();
  CaseResult result;
  long n = 0;
  for (const LoopCase::Sample& sample : c.reference) {
    for (; n < std::lround(sample.t / c.step); ++n) {
      if (!simulation.step(c.step).ok()) return {NAN};
      most_kinetic = std::max(most_kinetic, kinetic());
      strayed = std::max(strayed, std::abs(energy() - start));
    }
    result.error = std::max(
        result.error, error_of(c.read(simulation.state(), simulation.kinematics()), sample.values));
  }
  if (!c.source) result.energy_drift = strayed / most_kinetic;
  return result;
}

// Assembled from nearby; rates from J qd = 0 with the crank's given.
CaseResult assembled_four_bar() {
  const LoopCase c = four_bar();
  State<double> x = close_loops(c.model, c.loops, c.start);
  Kinematics k(c.model);
  forward_kinematics(c.model, x, k);
  LoopClosures loops(c.model, {c.loops[0]});
  loops.evaluate(x, k);
  const Eigen::VectorXd rates = shortest_solution(loops.J().rightCols(2), -10 * loops.J().col(0));
  x.qd = {10, rates[0], rates[1]};
  return {error_of(c.read(x, k), c.reference[0].values)};
}

}  // namespace

std::vector<AnalyticCase> loop_runs() {
  const char* group = "loops";
  return {
      {"D1-hinge", group, "pendulum, a free body on a hinge: place, rate; elliptic functions",
       pendulum_on_hinge().tolerance, [] { return run(pendulum_on_hinge()); }},
      {"D1-circle", group, "pendulum, a particle at a distance: the same",
       pendulum_on_circle().tolerance, [] { return run(pendulum_on_circle()); }},
      {"D2-2", group, "two four-bars through a singular place: 10 s [m, m/s]", windows(2).tolerance,
       [] { return run(windows(2)); }},
      {"D3", group, "Andrews' squeezer: angles at 0.01 to 0.05 s [rad]", squeezer().tolerance,
       [] { return run(squeezer()); }},
      {"D4", group, "Bricard's over-constrained 6R: place of a corner, 10 s [m]",
       bricard().tolerance, [] { return run(bricard()); }},
      {"D5-springs", group, "governor with stiff couplers: slider, 10 s [m]",
       governor(Couplers::springs).tolerance, [] { return run(governor(Couplers::springs)); }},
      {"D5-rods", group, "governor with rigid couplers: slider at 10 s [m]",
       governor(Couplers::rods).tolerance, [] { return run(governor(Couplers::rods)); }},
      {"D6", group, "slider-crank: crank and piston, 10 s [rad, rad/s, m]",
       slider_crank().tolerance, [] { return run(slider_crank()); }},
      {"D7", group, "four-bar at one place: angles and rates [rad, rad/s]", four_bar().tolerance,
       assembled_four_bar},
  };
}

}  // namespace twinarm
