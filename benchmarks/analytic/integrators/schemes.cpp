// G2 to G4: integrators on an oscillator, a pendulum, a rotating body, a double pendulum. G2,
// invariants of the symplectic schemes on x'' = -w^2 x:
//   semi-implicit:  v^2 + w^2 x^2 - h w^2 x v,    verlet:  v^2 + w^2 x^2 (1 - h^2 w^2 / 4),
// exact up to rounding; on the pendulum the averaged energy has no trend.
// G3, a body at constant rate: the exponential update is exact and conserves |q| = 1.
// G4, the slope of the error on C2 is the order (Hairer, Lubich, Wanner, Geometric Numerical
// Integration, chapters I, VI).
#include <limits>

#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/stepping/simulation.h"

namespace twinarm {
namespace {

constexpr double kGoldenStep = 0.01;

// ---- G2 ----

constexpr double kSquare = 100;  // w^2 [rad^2/s^2]

CaseScene undamped_oscillator() {
  const BodyInertia mass{1, Vector3::Zero(), Matrix3::Identity()};
  CaseScene scene =
      start_at(weightless(one_body(JointType::prismatic, Vector3::UnitX(), mass)), {0.1}, {0.5});
  scene.sources = {joint_effort([](double, double x) { return -kSquare * x; })};
  return not_conserving(scene);
}
double invariant_of(Integrator integrator, double x, double v) {
  const double h = kGoldenStep, plain = v * v + kSquare * x * x;
  return integrator == Integrator::verlet ? plain - h * h * kSquare * kSquare * x * x / 4
                                          : plain - h * kSquare * x * v;
}
TrajectoryCase invariant(Integrator integrator) {
  return {.scene = undamped_oscillator,
          .times = {1, 100, 10000},
          .readings = {"invariant [m2/s2]"},
          .observe = [integrator](
                         ModelRef,
                         StateRef x) { return values(invariant_of(integrator, x.q[0], x.qd[0])); },
          .reference = constantly({invariant_of(integrator, 0.1, 0.5)}),
          .integration = {integrator, kGoldenStep},
          .measure = relative_each,
          .mutant = more_inertia,
          .needs_its_integrator = true};
}

// Mean energy of the last tenth of a million steps minus that of the first, weighted by sin^4 so
// that fractions of a period do not matter, per step and relative to the energy above the bottom.
CaseResult trend(Integrator integrator, bool is_mutant) {
  constexpr long steps = 1000000, window = steps / 10;
  Model<double> model = point_pendulum();
  model.damping[0] = is_mutant ? 1e-8 : 0;
  State<double> x(model);
  x.q[0] = std::numbers::pi / 2;
  Simulation simulation(model, x);
  simulation.set_integrator(integrator);
  double mean[2] = {0, 0}, weights = 0;
  for (long n = 0; n < steps; ++n) {
    if (!simulation.step(kGoldenStep).ok()) return {std::numeric_limits<double>::quiet_NaN()};
    const bool early = n < window;
    if (!early && n < steps - window) continue;
    const long i = early ? n : n - (steps - window);
    const double s = std::sin(std::numbers::pi * (double(i) + 0.5) / double(window));
    const double weight = s * s * s * s, v = simulation.state().qd[0];
    mean[early ? 0 : 1] += weight * (v * v / 2 - kGravity * std::cos(simulation.state().q[0]));
    if (early) weights += weight;
  }
  return {std::abs(mean[1] - mean[0]) / weights / kGravity / double(steps - window)};
}

// ---- G3 ----

const Vector3 kSteady(0.6, -1.2, 2.0);  // [rad/s]

TrajectoryCase steady_rotation() {
  return {.scene = fixed(start_at(free_body(1, {0.1, 0.1, 0.1}), {0, 0, 0, 1, 0, 0, 0},
                                  {kSteady.x(), kSteady.y(), kSteady.z(), 0, 0, 0})),
          .times = {0.1, 1, 10},
          .readings = {"qw", "qx", "qy", "qz", "wx [rad/s]", "wy [rad/s]", "wz [rad/s]"},
          .observe = observe_attitude_and_rate,
          .reference =
              [](double t) {
                return attitude_and_rate(
                    Eigen::Quaterniond(Eigen::AngleAxisd(kSteady.norm() * t, kSteady.normalized())),
                    kSteady);
              },
          .integration = {Integrator::semi_implicit, kGoldenStep},
          .measure = attitude_and_rate_error,
          .mutant = [](CaseScene& scene) { scene.start.qd[0] *= 1.001; }};
}
TrajectoryCase unit_quaternion() {
  TrajectoryCase c = steady_rotation();
  c.scene = [scene = c.scene] { return not_conserving(scene()); };
  c.times = {10000};
  c.readings = {"|q|", "rate [rad/s]"};
  c.observe = [](ModelRef, StateRef x) {
    return values(std::sqrt(x.q[3] * x.q[3] + x.q[4] * x.q[4] + x.q[5] * x.q[5] + x.q[6] * x.q[6]),
                  Vector3(x.qd[0], x.qd[1], x.qd[2]).norm());
  };
  c.reference = constantly({1, kSteady.norm()});
  c.measure = max_difference;
  c.needs_its_integrator = true;
  return c;
}

// ---- G1 and G4, orders ----

// Of a known motion at 1 s; each mutation is 0.1 % more gravity.
double error_after_1s(const std::string& name, CaseMeasure measure, const Integration& integration,
                      int mutations) {
  for (const CaseFamily& family : joint_cases())
    for (const AnalyticCase& known : family.cases) {
      if (known.name != name) continue;
      TrajectoryCase c = *known.trajectory;
      c.times = {1};
      c.measure = measure;
      c.scene = [scene = c.scene, mutations] {
        CaseScene all = not_conserving(scene());
        for (int k = 0; k < mutations; ++k) more_gravity(all);
        return all;
      };
      return run_trajectory(c, integration).error;
    }
  return std::numeric_limits<double>::quiet_NaN();
}

double double_pendulum_error(const Integration& integration, bool is_mutant) {
  return error_after_1s("C2", max_difference, integration, is_mutant ? 1 : 0);
}

// First-order schemes: the pendulum's angle with steps of 10, 5, 2.5 ms; the worse of the two
// slopes.
CaseResult halving(Integrator integrator, bool is_mutant) {
  const auto of_angle = [](const CaseReadings& seen, const CaseReadings& exact) {
    return std::abs(seen[0] - exact[0]);
  };
  double error[3];
  for (int i = 0; i < 3; ++i)
    error[i] =
        error_after_1s("B2", of_angle, {integrator, kGoldenStep / (1 << i)}, is_mutant ? 5 : 0);
  const double coarse = std::log2(error[0] / error[1]), fine = std::log2(error[1] / error[2]);
  return {std::max(std::abs(coarse - 1), std::abs(fine - 1)), {}, fine};
}

// Slope from h = n ms to h / 16 for a scheme of order n, minus n.
CaseResult slope(Integrator integrator, bool is_mutant) {
  const int order = facts_of(integrator).order;
  const double h = 1e-3 * order;
  const double coarse = double_pendulum_error({integrator, h}, is_mutant);
  const double fine = double_pendulum_error({integrator, h / 16}, is_mutant);
  const double found = std::log2(coarse / fine) / 4;
  return {std::abs(found - order), {}, found};
}

// Error of dopri5 over its tolerance, for tolerances over four decades: maximum over minimum.
CaseResult proportion(bool is_mutant) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const double tolerance : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    const double error = double_pendulum_error({Integrator::dopri5, 1, tolerance}, is_mutant);
    low = std::min(low, error / tolerance);
    high = std::max(high, error / tolerance);
  }
  return {high / low};
}

}  // namespace

CaseFamily schemes_cases() {
  using enum Integrator;
  using Integrators = std::vector<Integrator>;
  std::vector<AnalyticCase> all;
  const auto add = [&](const std::string& prefix, double tolerance, const Integrators& integrators,
                       CaseResult (*experiment)(Integrator, bool is_mutant)) {
    for (const Integrator integrator : integrators)
      all.push_back({prefix + integrator_name(integrator), tolerance,
                     [=](bool is_mutant) { return experiment(integrator, is_mutant); }});
  };
  add("G1-order-", 0.05, {euler, semi_implicit, semi_implicit_xv, implicit_euler}, halving);
  for (const Integrator integrator : {semi_implicit, verlet})
    all.push_back({std::string("G2-") + integrator_name(integrator), 1e-12, invariant(integrator)});
  add("G2-trend-", 1e-12, {semi_implicit, verlet}, trend);
  all.push_back({"G3", 1e-12, steady_rotation()});
  all.push_back({"G3-norm", 1e-12, unit_quaternion()});
  add("G4-", 0.1,
      {euler, semi_implicit, semi_implicit_xv, verlet, midpoint, heun, rk4, implicit_euler,
       implicit_midpoint, trapezoid},
      slope);
  all.push_back({"G4-dopri5", 2, proportion});
  return {370, all};
}

}  // namespace twinarm
