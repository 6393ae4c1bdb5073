// The mechanisms of loop_cases.h as known motions. D1, D2 and D7 have closed forms:
//   D1  th = 2 asin(k sn(K - w0 t)), th' = -2 k w0 cn(K - w0 t); x = -sin th, z = -cos th
//   D2  q'' = a sin q, a = c g / l, from upright at 1 rad/s: with W^2 = 1 + 4 a, m = 4 a / W^2 and
//       u = W t / 2 - K(m), q = pi + 2 am(u, m), q' = W dn u
//   D7  a e^(i th2) + b e^(i th3) = d + c e^(i th4), and its derivative
// D3 to D6 have references that were computed elsewhere, at the times of loop_cases.h alone.
#include "benchmarks/analytic/loops/loop_runs.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "benchmarks/analytic/mechanisms/loop_cases.h"
#include "benchmarks/analytic/support/analytic_case.h"
#include "benchmarks/analytic/support/reference_math.h"
#include "solver/dynamics/kinematics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/loop_closure.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

using LongReal = long double;

// Its readings at the times of its table; not numbers between them.
CaseReadings tabulated(const LoopCase& c, double t) {
  for (const LoopCase::Sample& sample : c.reference)
    if (std::abs(sample.t - t) < 1e-12) return sample.values;
  return CaseReadings(c.readings.size(), std::numeric_limits<double>::quiet_NaN());
}

CaseScene scene_of(const LoopCase& c) {
  CaseScene scene{c.model, c.start};
  if (c.source) scene.sources = {c.source};
  scene.conserves = !c.source || c.stored;
  scene.stored = c.stored;
  scene.prepare = [loops = c.loops](Simulation& simulation) { simulation.set_loops(loops); };
  return scene;
}

// ---- D1 ----

CaseReadings swinging(double t) {  // from 90 degrees at rest
  const LongReal w0 = std::sqrt(9.81L), m = 0.5L, k = std::sqrt(m);
  const special::Jacobi j = special::jacobi(special::quarter_period(m) - w0 * LongReal(t), m);
  const LongReal angle = 2 * std::asin(k * j.sn);
  return rounded({-std::sin(angle), -std::cos(angle), -2 * k * w0 * j.cn});
}
TrajectoryCase swing_of(LoopCase (*make)()) {
  TrajectoryCase motion = loop_motion(make);
  motion.reference = swinging;
  motion.at_times_only = false;
  return motion;
}

// ---- D2 ----

CaseReadings turning_windows(int count, double t) {
  const LongReal n = count, c = ((n + 1) / 2 + n) / ((n + 1) / 3 + n), a = c * 9.81L;
  const LongReal W = std::sqrt(1 + 4 * a), m = 4 * a / (W * W);
  const special::Jacobi j = special::jacobi(W * LongReal(t) / 2 - special::quarter_period(m), m);
  const LongReal sine = -2 * j.sn * j.cn, cosine = 2 * j.sn * j.sn - 1, rate = W * j.dn;
  return rounded({sine, cosine, cosine * rate, -sine * rate});
}
template <int count>
TrajectoryCase windows_motion(double step) {
  TrajectoryCase motion = loop_motion([] { return windows(count); });
  motion.times = {1, 10};
  motion.reference = [](double t) { return turning_windows(count, t); };
  motion.at_times_only = false;
  motion.lane = rk4_lane(step);
  return motion;
}

// ---- D7 ----

// Put together from nearby; rates from J qd = 0 with the crank's given.
CaseReadings assembled(const LoopCase& c, const Model<double>& model, const State<double>& nearby) {
  State<double> x = close_loops(model, c.loops, nearby);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  LoopClosures loops(model, {c.loops[0]});
  loops.evaluate(x, k);
  const Eigen::VectorXd rates = min_solution(loops.J().rightCols(2), -10 * loops.J().col(0));
  x.qd = {10, rates[0], rates[1]};
  return c.read(x, k);
}
CaseReadings four_bar_closed_form() {
  constexpr LongReal a = 0.1L, b = 0.35L, c = 0.3L, d = 0.4L, w2 = 10;
  const LongReal th2 = std::numbers::pi_v<LongReal> / 3;
  // From the crank's end B to the rocker's foot D; C stands b from B, c from D, above the line.
  const LongReal x = d - a * std::cos(th2), y = -a * std::sin(th2), BD = std::hypot(x, y);
  const LongReal at_B = std::acos((b * b + BD * BD - c * c) / (2 * b * BD));
  const LongReal th3 = std::atan2(y, x) + at_B;
  const LongReal th4 =
      std::atan2(a * std::sin(th2) + b * std::sin(th3), a * std::cos(th2) + b * std::cos(th3) - d);
  const LongReal w3 = -a * w2 * std::sin(th2 - th4) / (b * std::sin(th3 - th4));
  const LongReal w4 = a * w2 * std::sin(th2 - th3) / (c * std::sin(th4 - th3));
  return rounded({th3, th4, w3, w4});
}
TrajectoryCase four_bar_place() {
  const auto c = std::make_shared<const LoopCase>(four_bar());
  TrajectoryCase place = evaluation(
      [c] {
        return CaseScene{c->model, c->start};
      },
      c->readings,
      [c](const Model<double>& model, const State<double>& x) { return assembled(*c, model, x); },
      four_bar_closed_form(), max_difference);
  place.mutant = longer_crank;
  return place;
}

// ---- the others ----

TrajectoryCase squeezer_motion() {
  TrajectoryCase motion = loop_motion(squeezer);
  motion.mutant = more_inertia;  // there is no gravity
  return motion;
}

}  // namespace

void longer_crank(CaseScene& scene) {
  scene.model.Xtree[2].r = 1.001 * scene.model.Xtree[2].r;
}

// Each run has a mechanism of its own: sources keep what they point at.
TrajectoryCase loop_motion(LoopCase (*make)()) {
  const auto c = std::make_shared<const LoopCase>(make());
  TrajectoryCase motion{};
  motion.scene = [make] { return scene_of(make()); };
  for (const LoopCase::Sample& sample : c->reference) motion.times.push_back(sample.t);
  motion.readings = c->readings;
  motion.observe = [c](const Model<double>& model, const State<double>& x) {
    Kinematics k(model);
    forward_kinematics(model, x, k);
    return c->read(x, k);
  };
  motion.reference = [c](double t) { return tabulated(*c, t); };
  motion.at_times_only = true;
  motion.lane = rk4_lane(c->step);
  return motion;
}

CaseFamily loop_runs_cases() {
  return {160,
          {{"D1-hinge", pendulum_on_hinge().tolerance, swing_of(pendulum_on_hinge)},
           {"D1-circle", pendulum_on_circle().tolerance, swing_of(pendulum_on_circle)},
           {"D2-2", windows(2).tolerance, windows_motion<2>(1e-3)},
           {"D2-40", windows(40).tolerance, windows_motion<40>(8e-3)},
           {"D3", squeezer().tolerance, squeezer_motion()},
           {"D4", bricard().tolerance, loop_motion(bricard)},
           {"D5-springs", governor(Couplers::springs).tolerance,
            loop_motion([] { return governor(Couplers::springs); })},
           {"D5-rods", governor(Couplers::rods).tolerance,
            loop_motion([] { return governor(Couplers::rods); })},
           {"D6", slider_crank().tolerance, loop_motion(slider_crank)},
           {"D7", four_bar().tolerance, four_bar_place()}}};
}

}  // namespace twinarm
