// C7, Kapitza's pendulum: a point mass on a rod of 0.5 m, pivot at z = a cos(w t), a = 0.02 m
// (Landau, Lifshitz, Mechanics, section 30). From upright:  u'' = (g - a w^2 cos w t) sin(u) / l.
// Upright is stable if the trace of the monodromy matrix is below 2: for w >= 156.65935736181
// rad/s; averaging gives sqrt(2 g l) / a = 156.6.
#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

constexpr double kShaken = 0.5, kShake = 0.02, kFromTop = 0.01, kFloquet = 156.65935736181;

CaseScene shaken(double w, double from_top) {
  ModelBuilder builder;
  builder.add_body("pivot", 0, "shaker", JointType::prescribed, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Matrix3::Identity()});
  builder.add_body("rod", 1, "hinge", JointType::revolute, {}, Vector3::UnitY(),
                   {1, {0, 0, -kShaken}, Matrix3::Zero()});
  CaseScene scene = at_rest(builder.build());
  scene.start.q[scene.model.iq[2]] = std::numbers::pi + from_top;
  scene.conserves = false;
  scene.prepare = [w](Simulation& simulation) {
    simulation.prescribe(1, [w](double t) {
      PrescribedMotion motion;
      motion.X_JL.p.z() = kShake * std::cos(w * t);
      motion.velocity.z() = -kShake * w * std::sin(w * t);
      motion.acceleration.z() = -kShake * w * w * std::cos(w * t);
      return motion;
    });
  };
  return scene;
}
double from_top(ModelRef model, StateRef x) {
  return x.q[model.iq[2]] - std::numbers::pi;
}
// Angle and rate at t, from those at `from`.
special::Numbers shaken_solution(double w, const special::Numbers& x, Real from, Real t) {
  const special::Rates rates = [w, from](Real after, const special::Numbers& now,
                                         special::Numbers& dx) {
    const Real W = w, lift = 9.81L - kShake * W * W * std::cos(W * (from + after));
    dx = {now[1], lift * std::sin(now[0]) / kShaken};
  };
  return special::solution(rates, x, t - from, 1.0L / 512);
}

TrajectoryCase shaken_motion(double w, double until) {
  std::vector<double> times;
  for (int k = 1; k <= 8; ++k) times.push_back(until * k / 8);
  return {.scene = [w] { return shaken(w, kFromTop); },
          .times = times,
          .readings = {"angle from upright [rad]"},
          .observe = [](ModelRef model, StateRef x) { return values(from_top(model, x)); },
          .reference =
              [w](double t) {
                return values(shaken_solution(w, {kFromTop, 0}, 0, t)[0]);
              },
          .integration = rk4_with(2e-4)};
}

// Largest angle in 20 s, every 2 ms.
TrajectoryCase stays_up(double w) {
  TrajectoryCase c = shaken_motion(w, 20);
  c.times.clear();
  for (int k = 1; k <= 10000; ++k) c.times.push_back(20.0 * k / 10000);
  c.observe = [](ModelRef model, StateRef x) { return values(std::abs(from_top(model, x))); };
  c.reference = constantly({0});
  c.mutant = [](CaseScene& scene) { scene.model.gravity = 1.05 * scene.model.gravity; };
  c.needs_its_integrator = true;  // the reference is a bound, not a motion
  return c;
}

// Time at which it passes 1 rad.
TrajectoryCase falls(double w, double about) {
  return times_of(
      shaken_motion(w, about),
      {[](ModelRef model, StateRef x) { return std::abs(from_top(model, x)) - 1; }, 1, 20},
      [w, about](double) {
        // The first of several passages, for it oscillates about its path.
        Real t = about - 0.5L, end = t;
        special::Numbers x = shaken_solution(w, {kFromTop, 0}, 0, t), next = x;
        for (; std::abs(next[0]) < 1 && end < 20; next = shaken_solution(w, x, t, end)) {
          x = next;
          t = end;
          end = t + 2e-4L;
        }
        for (Real middle; (middle = (t + end) / 2) > t && middle < end;) {
          const special::Numbers there = shaken_solution(w, x, t, middle);
          if (std::abs(there[0]) < 1)
            x = there, t = middle;
          else
            end = middle;
        }
        return values(end);
      });
}

// By symmetry the trace is twice the final angle of a period that starts at 1 at rest: on the
// limit 1.
TrajectoryCase floquet() {
  static constexpr double small = 1e-5;
  TrajectoryCase c = shaken_motion(kFloquet, 1);
  c.scene = [] { return shaken(kFloquet, small); };
  c.times = {2 * std::numbers::pi / kFloquet};
  c.readings = {"angle after a period, of the initial one"};
  c.observe = [](ModelRef model, StateRef x) { return values(from_top(model, x) / small); };
  c.reference = constantly({1});
  c.integration = rk4_with(1e-5);
  return c;
}

}  // namespace

CaseFamily kapitza_cases() {
  return {140,
          {{"C7", 1e-8, shaken_motion(160, 2)},
           {"C7-157.5", 0.0101, stays_up(157.5)},
           {"C7-160", 0.0101, stays_up(160)},
           {"C7-156", 1e-5, falls(156, 10.2)},
           {"C7-150", 1e-5, falls(150, 3.9)},
           {"C7-limit", 1e-8, floquet()}}};
}

}  // namespace twinarm
