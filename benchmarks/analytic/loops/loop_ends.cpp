// What D3 to D6 know beside the tables of loop_cases.h: rates, an energy, a place, and that the
// governor's slow motion lives on where its stiff couplers are implicit. D6: at the start the crank
// turns about its bearing and the rod about the wrist, so that E = (1/2) (I_crank w^2 + I_rod (w
// r/l)^2) = 1/8 J. References as there.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/loops/loop_runs.h"
#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/kinematics.h"
#include "solver/loops/loop_closure.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

// The motion of a mechanism, with other readings at one of its times.
TrajectoryCase read_at(LoopCase (*make)(), double t, std::vector<std::string> readings,
                       CaseObserver observe, CaseReadings known) {
  TrajectoryCase motion = loop_motion(make);
  motion.times = {t};
  motion.readings = std::move(readings);
  motion.observe = std::move(observe);
  motion.reference = [known = std::move(known)](double) { return known; };
  return motion;
}

// Its readings are coordinates: the same of the velocities.
TrajectoryCase squeezer_rates() {
  const auto c = std::make_shared<const LoopCase>(squeezer());
  TrajectoryCase motion =
      read_at(squeezer, 0.03,
              {"beta [rad/s]", "Theta [rad/s]", "gamma [rad/s]", "Phi [rad/s]", "delta [rad/s]",
               "Omega [rad/s]", "epsilon [rad/s]"},
              [c](const Model<double>& model, const State<double>& x) {
                State<double> rates = x;
                rates.q = x.qd;
                return c->read(rates, Kinematics(model));
              },
              {1139.9203022591061, -1424.3792951775401, 11.032911910618594, 19.293374105032041,
               0.57356991482950245, -19.293374105032041, 0.32317914924913088});
  motion.measure = relative_to_largest;
  motion.mutant = more_inertia;  // there is no gravity
  return motion;
}

TrajectoryCase bricard_velocity() {
  return read_at(bricard, 10, {"vx [m/s]", "vy [m/s]", "vz [m/s]"},
                 [](const Model<double>& model, const State<double>& x) {
                   Kinematics k(model);
                   forward_kinematics(model, x, k);
                   const Vector3& v = k.v_WLo[3];
                   return CaseReadings{v.x(), v.y(), v.z()};
                 },
                 {-0.03245328022227769, 8.726822183481425e-06, -0.03244454987786557});
}

// Dofs of the governor: shaft, slider, rods.
TrajectoryCase governor_end() {
  return read_at([] { return governor(Couplers::springs); }, 10, {"alpha [rad]", "omega [rad/s]"},
                 [](const Model<double>&, const State<double>& x) {
                   return CaseReadings{x.q[2], x.qd[0]};
                 },
                 {22.349576814742957 * std::numbers::pi / 180, 5.548203622654942});
}

// How far the slider swings in the first and the last 2 s of 10, in steps of 5 ms, which are twenty
// times too long for explicit couplers [m].
struct Swing {
  double first = NAN, last = NAN;
};
Swing swing(Couplers couplers, Integrator integrator) {
  const LoopCase c = governor(couplers);
  Simulation simulation(c.model, c.start);
  simulation.set_integrator(integrator);
  simulation.set_loops(c.loops);
  if (c.source) simulation.add(*c.source);
  double least[2] = {HUGE_VAL, HUGE_VAL}, most[2] = {-HUGE_VAL, -HUGE_VAL};
  for (int n = 0; n < 2000; ++n) {
    if (!simulation.step(5e-3).ok()) return {};
    if (n >= 400 && n < 1600) continue;
    const double s = c.read(simulation.state(), simulation.kinematics())[0];
    const int part = n < 400 ? 0 : 1;
    least[part] = std::min(least[part], s), most[part] = std::max(most[part], s);
  }
  return {most[0] - least[0], most[1] - least[1]};
}
// What implicit couplers change of it: as implicit struts against rods by the same scheme, whose
// first order makes both swing more; by the midpoint rule against its own start.
CaseResult governor_swings(bool mistaken) {
  if (mistaken) {
    const Swing damped = swing(Couplers::springs, Integrator::implicit_euler);
    return {std::abs(damped.last / damped.first - 1)};
  }
  const double rods = swing(Couplers::rods, Integrator::semi_implicit).last;
  const double struts = swing(Couplers::implicit_struts, Integrator::semi_implicit).last;
  const Swing midpoint = swing(Couplers::springs, Integrator::implicit_midpoint);
  return {nan_max(std::abs(struts / rods - 1), std::abs(midpoint.last / midpoint.first - 1))};
}

// The crank held at 60 degrees.
TrajectoryCase piston_place() {
  const auto c = std::make_shared<LoopCase>(slider_crank());
  LoopClosure input{"input", LoopType::locked, 1};
  input.offset = std::numbers::pi / 3;
  c->loops.push_back(input);
  c->start.q = {1.0, -1.2, 0.34};
  TrajectoryCase place = evaluation(
      [c] {
        return CaseScene{c->model, c->start};
      },
      {"piston [m]"},
      [c](const Model<double>& model, const State<double>& x) {
        return CaseReadings{close_loops(model, c->loops, x).q[2]};
      },
      {0.05 + std::sqrt(0.09 - 0.0075)}, max_difference);
  place.mutant = longer_crank;
  return place;
}

TrajectoryCase crank_energy() {
  TrajectoryCase motion =
      read_at(slider_crank, 10, {"energy [J]"}, smooth_parts::observe_energy, {0.125});
  motion.times = {1, 2, 5, 10};
  motion.at_times_only = false;
  motion.mutant = more_inertia;
  return motion;
}

}  // namespace

CaseFamily loop_ends_cases() {
  return {170,
          {{"D3-rates", 1e-8, squeezer_rates()},
           {"D4-velocity", 1e-6, bricard_velocity()},
           {"D5-end", 1e-8, governor_end()},
           {"D5-implicit", 0.01, governor_swings},
           {"D6-place", 1e-12, piston_place()},
           {"D6-energy", 1e-8, crank_energy()}}};
}

}  // namespace twinarm
