// F4: a spring-damper k, b couples a hinge of inertia I to a target at rest, in steps of h; alpha =
// k h^2 / I, beta = b h / I. Stability limit of the stepper, by bisection, against that of each
// scheme (roots of its characteristic polynomial; docs/understand/stability_of_spring_dampers.md):
//   euler                     alpha < beta < 2 + alpha / 2
//   semi-implicit             alpha < 4 - 2 beta, with the current velocity or a difference
//   euler, difference         alpha < beta (1 - beta)
//   semi-implicit, delayed    alpha < 1 - beta  (difference one step older)
//   force held for a step     alpha < 2 beta, beta < 2
//   the same, difference      alpha < 2 beta (2 - beta) / (2 + beta)
//   implicit damper           alpha < 4 + 2 beta
// The implicit discretization and implicit integrators have no limit.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "benchmarks/analytic/support/analytic_case.h"
#include "coupling/analysis/prediction.h"
#include "coupling/analysis/tracking.h"
#include "solver/dynamics/model_builder.h"

namespace twinarm {
namespace {

constexpr double kInertia = 0.7, kFrame = 0.01, kAmplitude = 1e-9;  // [kg m^2], [s], [rad]
constexpr int kHeldSteps = 20;  // steps of the integrator in one held step

// A target at rest.
class ConstantTarget final : public OperatorMotion {
 public:
  OperatorSample sample(double, double) const override { return {}; }  // robot angles 0
  double duration() const override { return 1; }
  std::string description() const override { return "at rest"; }
};

// Coupling and integrator of a scheme.
struct Stepping {
  CouplingSpec spec{};
  Integrator integrator = Integrator::semi_implicit;
  int substeps = 1;
};
Stepping stepping_of(SteppingScheme scheme) {
  Stepping s;
  s.spec.options.damper = Damper::vector_;
  const auto is = [&](auto... one) { return ((scheme == one) || ...); };
  if (is(SteppingScheme::euler, SteppingScheme::euler_difference)) s.integrator = Integrator::euler;
  s.spec.printed = is(SteppingScheme::euler_difference, SteppingScheme::semi_implicit_difference,
                      SteppingScheme::semi_implicit_older, SteppingScheme::hold_difference);
  if (is(SteppingScheme::semi_implicit_older)) s.spec.options.difference = Difference::older;
  if (is(SteppingScheme::hold, SteppingScheme::hold_difference)) {
    s.integrator = Integrator::rk4;
    s.substeps = s.spec.hold_steps = s.spec.options.hold_steps = kHeldSteps;
  }
  if (is(SteppingScheme::implicit_damper)) s.spec.discretization = Discretization::semi_implicit;
  if (is(SteppingScheme::implicit)) s.spec.discretization = Discretization::implicit;
  return s;
}

Model<double> lone_hinge(double inertia) {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("link", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), inertia * Matrix3::Identity()});
  return builder.build();
}

struct Setting {  // for a hinge of kInertia; that of a mutant differs
  double alpha, beta;
};

// Whether a small motion grows: its amplitude in the last quarter of the steps against the second.
bool grows(Stepping stepping, const Setting& at, double inertia) {
  stepping.spec.springs = {{"spring", 1, Vector3::Zero(), at.alpha * kInertia / (kFrame * kFrame),
                            at.beta * kInertia / kFrame}};
  const Model<double> model = lone_hinge(inertia);
  const ConstantTarget input;
  TargetRobot kvr(model, input, OperatorMapping(), {{"joint1"}, "", 0, 0});
  const std::unique_ptr<Coupling> coupling = make_coupling(stepping.spec, model, kvr);
  State<double> start(model);
  start.q[0] = kAmplitude;
  Simulation simulation(model, start);
  simulation.set_integrator(stepping.integrator);
  simulation.add(*coupling);
  const int steps = stepping.substeps > 1 ? 800 : 4000;
  double early = 0, late = 0;
  for (int n = 0; n < steps; ++n) {
    for (int m = 0; m < stepping.substeps; ++m) simulation.step(kFrame / stepping.substeps);
    const double size = std::abs(simulation.state().q[0]);
    if (!(size < 1e6 * kAmplitude)) return true;
    if (size < 1e-6 * kAmplitude && n > steps / 4) return false;
    if (n >= steps / 4 && n < steps / 2) early = std::max(early, size);
    if (n >= 3 * steps / 4) late = std::max(late, size);
  }
  return late > 1.01 * early;  // the sampled amplitude of an undamped motion varies by less
}

// A setting on the stability limit, and the number that is varied across it.
struct Limit {
  Setting at;
  double Setting::*varied = &Setting::alpha;
};

// Relative error of the stepper's limit, to 1e-4; NAN if there is none within 10 %.
double limit_error(const Stepping& stepping, const Limit& limit, double inertia) {
  const auto stable = [&](double part) {
    Setting at = limit.at;
    at.*limit.varied *= part;
    return !grows(stepping, at, inertia);
  };
  double inside = 0.9, outside = 1.1;
  if (!stable(inside) || stable(outside)) return std::numeric_limits<double>::quiet_NaN();
  while (std::abs(outside - inside) > 1e-4) {
    const double middle = (inside + outside) / 2;
    (stable(middle) ? inside : outside) = middle;
  }
  return std::abs(inside - 1);
}

// The limit is alpha(beta), and for alpha = 1 beta < max_beta (0: no such limit). Mutant: 1.5 %
// less inertia.
AnalyticCase limit_case(const char* name, SteppingScheme scheme, const std::array<double, 3>& betas,
                        double (*alpha)(double beta), double max_beta = 0) {
  std::vector<Limit> limits;
  for (const double beta : betas) limits.push_back({{alpha(beta), beta}});
  if (max_beta > 0) limits.push_back({{1, max_beta}, &Setting::beta});
  return {name, 0.01, [=](bool is_mutant) {
            const double inertia = is_mutant ? 0.985 * kInertia : kInertia;
            CaseResult result;
            for (const Limit& limit : limits)
              result.error =
                  nan_max(result.error, limit_error(stepping_of(scheme), limit, inertia));
            return result;
          }};
}

// Number of unstable settings.
CaseResult unstable(const Stepping& stepping, double max_alpha) {
  CaseResult result;
  for (const double alpha : {1e-2, 1.0, 1e2, 1e6, 1e10})
    for (const double beta : {0.0, 0.1, 1e2, 1e6})
      if (alpha <= max_alpha) result.error += grows(stepping, {alpha, beta}, kInertia) ? 1 : 0;
  return result;
}
Stepping by_integrator(Integrator integrator) {
  Stepping s = stepping_of(SteppingScheme::semi_implicit);
  s.integrator = integrator;
  return s;
}
// Mutant: semi-implicit steps.
AnalyticCase integrator_case(const char* name, Integrator integrator) {
  return {name, 0, [integrator](bool is_mutant) {
            return unstable(by_integrator(is_mutant ? Integrator::semi_implicit : integrator), 1e6);
          }};
}

}  // namespace

CaseFamily stability_cases() {
  constexpr std::array<double, 3> kBetas{0.15, 0.8, 1.5};
  const auto semi_implicit_limit = [](double b) { return 4 - 2 * b; };
  return {350,
          {limit_case(
               "F4-euler", SteppingScheme::euler, {0.2, 0.8, 1.5}, [](double b) { return b; }, 2.5),
           limit_case("F4-semi", SteppingScheme::semi_implicit, kBetas, semi_implicit_limit),
           limit_case("F4-semi-difference", SteppingScheme::semi_implicit_difference, kBetas,
                      semi_implicit_limit),
           limit_case("F4-euler-difference", SteppingScheme::euler_difference, {0.2, 0.5, 0.8},
                      [](double b) { return b * (1 - b); }),
           limit_case("F4-semi-older", SteppingScheme::semi_implicit_older, {0.15, 0.5, 0.8},
                      [](double b) { return 1 - b; }),
           limit_case(
               "F4-hold", SteppingScheme::hold, {0.2, 0.8, 1.5}, [](double b) { return 2 * b; }, 2),
           limit_case("F4-hold-difference", SteppingScheme::hold_difference, {0.2, 0.8, 1.5},
                      [](double b) { return 2 * b * (2 - b) / (2 + b); }),
           limit_case("F4-implicit-damper", SteppingScheme::implicit_damper, {0.15, 0.8, 3},
                      [](double b) { return 4 + 2 * b; }),
           {"F4-implicit", 0,
            [](bool is_mutant) {
              const SteppingScheme scheme =
                  is_mutant ? SteppingScheme::implicit_damper : SteppingScheme::implicit;
              return unstable(stepping_of(scheme), 1e10);
            }},
           integrator_case("F4-implicit-euler", Integrator::implicit_euler),
           integrator_case("F4-implicit-midpoint", Integrator::implicit_midpoint),
           integrator_case("F4-trapezoid", Integrator::trapezoid)}};
}

}  // namespace twinarm
