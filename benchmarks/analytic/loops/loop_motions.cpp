// D: mechanisms with closed loops (mechanisms/loop_cases.h) as known motions. D3 to D6 have
// reference values at the times of loop_cases.h, computed independently. D6: initially the crank
// rotates about its bearing and the rod about the wrist:
//   E = (1/2) (I_crank w^2 + I_rod (w r/l)^2) = 1/8 J
#include <algorithm>
#include <limits>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_closure.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

// Reference readings at the times of the table, else NAN.
CaseReadings tabulated(const LoopCase& c, double t) {
  for (const LoopCase::Sample& sample : c.reference)
    if (std::abs(sample.t - t) < 1e-12) return sample.values;
  return CaseReadings(c.readings.size(), std::numeric_limits<double>::quiet_NaN());
}

CaseScene scene_of(const LoopCase& c) {
  CaseScene scene = c;
  scene.conserves = c.sources.empty() || c.stored;
  scene.prepare = [loops = c.loops](Simulation& simulation) { simulation.set_loops(loops); };
  return scene;
}

using MakeLoopCase = std::function<LoopCase()>;

// Each run creates its own mechanism, to which its sources refer.
TrajectoryCase loop_motion(const MakeLoopCase& make) {
  const auto c = std::make_shared<const LoopCase>(make());
  TrajectoryCase motion{};
  motion.scene = [make] { return scene_of(make()); };
  for (const LoopCase::Sample& sample : c->reference) motion.times.push_back(sample.t);
  motion.readings = c->readings;
  motion.observe = [c](ModelRef model, StateRef x) { return c->read(x, kinematics_at(model, x)); };
  motion.reference = [c](double t) { return c->exact ? c->exact(t) : tabulated(*c, t); };
  motion.at_times_only = !c->exact;
  motion.integration = rk4_with(c->step);
  return motion;
}
// The same with other readings at one time.
TrajectoryCase read_at(const MakeLoopCase& make, double t, std::vector<std::string> readings,
                       CaseObserver observer, CaseReadings known) {
  TrajectoryCase motion = loop_motion(make);
  motion.times = {t};
  motion.readings = std::move(readings);
  motion.observe = std::move(observer);
  motion.reference = constantly(std::move(known));
  return motion;
}
// One evaluation of an assembled mechanism. Mutant: a crank 0.1 % longer.
TrajectoryCase assembled(const std::shared_ptr<const LoopCase>& c,
                         std::vector<std::string> readings, CaseObserver observer,
                         CaseReadings known) {
  TrajectoryCase result = evaluation({c->model, c->start}, std::move(readings), std::move(observer),
                                     std::move(known), max_difference);
  result.mutant = [](CaseScene& changed) {
    changed.model.Xtree[2].r = 1.001 * changed.model.Xtree[2].r;
  };
  return result;
}

// ---- D3, D4 ----

TrajectoryCase squeezer_motion() {
  TrajectoryCase motion = loop_motion(squeezer);
  motion.mutant = more_inertia;  // there is no gravity
  return motion;
}
// Velocities by the reader of the coordinates.
TrajectoryCase squeezer_rates() {
  const auto c = std::make_shared<const LoopCase>(squeezer());
  TrajectoryCase motion =
      read_at(squeezer, 0.03,
              {"beta [rad/s]", "Theta [rad/s]", "gamma [rad/s]", "Phi [rad/s]", "delta [rad/s]",
               "Omega [rad/s]", "epsilon [rad/s]"},
              [c](ModelRef model, StateRef x) {
                State<double> rates = x;
                rates.q = x.qd;
                return c->read(rates, Kinematics(model));
              },
              {1139.9203022591061, -1424.3792951775401, 11.032911910618594, 19.293374105032041,
               0.57356991482950245, -19.293374105032041, 0.32317914924913088});
  motion.measure = relative_to_largest;
  motion.mutant = more_inertia;
  return motion;
}

TrajectoryCase bricard_velocity() {
  return read_at(
      bricard, 10, {"vx [m/s]", "vy [m/s]", "vz [m/s]"},
      [](ModelRef model, StateRef x) { return values(kinematics_at(model, x).v_WLo[3]); },
      {-0.03245328022227769, 8.726822183481425e-06, -0.03244454987786557});
}

// ---- D5 ----

// Dofs of the governor: shaft, slider, rods.
TrajectoryCase governor_end() {
  return read_at([] { return governor(Couplers::springs); }, 10, {"alpha [rad]", "omega [rad/s]"},
                 [](ModelRef, StateRef x) { return values(x.q[2], x.qd[0]); },
                 {22.349576814742957 * std::numbers::pi / 180, 5.548203622654942});
}

// Range of the slider in the first and the last 2 s of 10 s, in steps of 5 ms, twenty times too
// long for explicit couplers [m].
struct Swing {
  double first = NAN, last = NAN;
};
Swing swing(Couplers couplers, Integrator integrator) {
  const LoopCase c = governor(couplers);
  Simulation simulation(c.model, c.start);
  simulation.set_integrator(integrator);
  simulation.set_loops(c.loops);
  for (const auto& source : c.sources) simulation.add(*source);
  double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < 2000; ++n) {
    if (!simulation.step(5e-3).ok()) return {};
    if (n >= 400 && n < 1600) continue;
    const double s = c.read(simulation.state(), simulation.kinematics())[0];
    const int part = n < 400 ? 0 : 1;
    low[part] = std::min(low[part], s), high[part] = std::max(high[part], s);
  }
  return {high[0] - low[0], high[1] - low[1]};
}
// Change of the swing by implicit couplers: implicit struts against rods in the same scheme, whose
// first-order error increases both swings; the midpoint rule against its own first 2 s.
CaseResult governor_swings(bool is_mutant) {
  if (is_mutant) {
    const Swing damped = swing(Couplers::springs, Integrator::implicit_euler);
    return {std::abs(damped.last / damped.first - 1)};
  }
  const double rods = swing(Couplers::rods, Integrator::semi_implicit).last;
  const double struts = swing(Couplers::implicit_struts, Integrator::semi_implicit).last;
  const Swing midpoint = swing(Couplers::springs, Integrator::implicit_midpoint);
  return {nan_max(std::abs(struts / rods - 1), std::abs(midpoint.last / midpoint.first - 1))};
}

// ---- D6 ----

// The crank locked at 60 degrees.
TrajectoryCase piston_place() {
  const auto c = std::make_shared<LoopCase>(slider_crank());
  LoopClosure input{"input", LoopType::locked, 1};
  input.offset = std::numbers::pi / 3;
  c->loops.push_back(input);
  c->start.q = {1.0, -1.2, 0.34};
  return assembled(
      c, {"piston [m]"},
      [c](ModelRef model, StateRef x) { return values(close_loops(model, c->loops, x).q[2]); },
      {0.05 + std::sqrt(0.09 - 0.0075)});
}

TrajectoryCase crank_energy() {
  TrajectoryCase motion = read_at(slider_crank, 10, {"energy [J]"}, observe_energy, {0.125});
  motion.times = {1, 2, 5, 10};
  motion.at_times_only = false;
  motion.mutant = more_inertia;
  return motion;
}

// ---- D7 ----

// Assembled from an open state; rates from J qd = 0 with the crank's given.
TrajectoryCase four_bar_place() {
  const auto c = std::make_shared<const LoopCase>(four_bar());
  const auto observer = [c](ModelRef model, StateRef nearby) {
    State<double> x = close_loops(model, c->loops, nearby);
    const Kinematics k = kinematics_at(model, x);
    LoopClosures loops(model, {c->loops[0]});
    loops.evaluate(x, k);
    const Eigen::VectorXd rates = min_solution(loops.J().rightCols(2), -10 * loops.J().col(0));
    x.qd = {10, rates[0], rates[1]};
    return c->read(x, k);
  };
  return assembled(c, c->readings, observer, c->reference[0].values);
}

}  // namespace

CaseFamily loop_motions_cases() {
  const auto springs = [] { return governor(Couplers::springs); };
  const auto rods = [] { return governor(Couplers::rods); };
  return {160,
          {{"D1-hinge", pendulum_on_hinge().tolerance, loop_motion(pendulum_on_hinge)},
           {"D1-circle", pendulum_on_circle().tolerance, loop_motion(pendulum_on_circle)},
           {"D2-2", windows(2).tolerance, loop_motion([] { return windows(2); })},
           {"D2-40", windows(40).tolerance,
            integrated_by(rk4_with(8e-3), loop_motion([] { return windows(40); }))},
           {"D3", squeezer().tolerance, squeezer_motion()},
           {"D4", bricard().tolerance, loop_motion(bricard)},
           {"D5-springs", springs().tolerance, loop_motion(springs)},
           {"D5-rods", rods().tolerance, loop_motion(rods)},
           {"D6", slider_crank().tolerance, loop_motion(slider_crank)},
           {"D7", four_bar().tolerance, four_bar_place()},
           {"D3-rates", 1e-8, squeezer_rates()},
           {"D4-velocity", 1e-6, bricard_velocity()},
           {"D5-end", 1e-8, governor_end()},
           {"D5-implicit", 0.01, governor_swings},
           {"D6-place", 1e-12, piston_place()},
           {"D6-energy", 1e-8, crank_energy()}}};
}

}  // namespace twinarm
