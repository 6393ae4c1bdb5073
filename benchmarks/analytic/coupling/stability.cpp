// F4: a spring-damper k, b holds a hinge of inertia I to a target at rest, in steps of h; alpha =
// k h^2 / I, beta = b h / I. Where the real stepper begins to grow, by bisection, against the
// limits of each scheme (the roots of its characteristic polynomial;
// docs/understand/stability_of_spring_dampers.md):
//   euler                     alpha < beta < 2 + alpha / 2
//   semi-implicit             alpha < 4 - 2 beta, with the current velocity or a difference
//   euler, difference         alpha < beta (1 - beta)
//   semi-implicit, older one  alpha < 1 - beta
//   force held for a step     alpha < 2 beta, beta < 2
//   the same, difference      alpha < 2 beta (2 - beta) / (2 + beta)
//   implicit damper           alpha < 4 + 2 beta
// and the implicit treatment and implicit integrators, which have none.
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

constexpr double kHinge = 0.7, kFrame = 0.01, kLittle = 1e-9;
constexpr int kHeldSteps = 20;  // steps of the integrator in one held step

// The target: a hand that stands still.
class StillHand final : public OperatorMotion {
 public:
  HandSample sample(double, double) const override {
    HandSample hand;
    for (std::size_t j = 0; j < 3; ++j) HandMapping().set_robot_angle(hand, j, 0, 0);
    return hand;
  }
  double duration() const override { return 1; }
  std::string description() const override { return "still"; }
};

// What makes a scheme.
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
  if (is(SteppingScheme::implicit_damper)) s.spec.treatment = Discretization::semi_implicit;
  if (is(SteppingScheme::implicit)) s.spec.treatment = Discretization::implicit;
  return s;
}

Model<double> lone_hinge(double inertia) {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("link", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), inertia * Matrix3::Identity()});
  return builder.build();
}

// A setting, for the hinge as it should be; the one that is stepped may have another inertia.
struct Setting {
  double alpha, beta;
};

// Whether a small motion grows: its size in the last quarter of the steps against the second.
bool grows(Stepping stepping, const Setting& at, double inertia) {
  stepping.spec.springs = {{"spring", 1, Vector3::Zero(), at.alpha * kHinge / (kFrame * kFrame),
                            at.beta * kHinge / kFrame}};
  const Model<double> model = lone_hinge(inertia);
  const StillHand hand;
  TargetRobot kvr(model, hand, HandMapping(), {{"joint1"}, "", 0, 0});
  const std::unique_ptr<Coupling> coupling = make_coupling(stepping.spec, model, kvr);
  State<double> start(model);
  start.q[0] = kLittle;
  Simulation simulation(model, start);
  simulation.set_integrator(stepping.integrator);
  simulation.add(*coupling);
  const int steps = stepping.substeps > 1 ? 800 : 4000;
  double early = 0, late = 0;
  for (int n = 0; n < steps; ++n) {
    for (int m = 0; m < stepping.substeps; ++m) simulation.step(kFrame / stepping.substeps);
    const double size = std::abs(simulation.state().q[0]);
    if (!(size < 1e6 * kLittle)) return true;
    if (size < 1e-6 * kLittle && n > steps / 4) return false;
    if (n >= steps / 4 && n < steps / 2) early = std::max(early, size);
    if (n >= 3 * steps / 4) late = std::max(late, size);
  }
  return late > 1.01 * early;  // undamped motion, seen once a step, seems to by less
}

// A setting on the limit, and what is turned to pass it.
struct Edge {
  Setting at;
  double Setting::*turned = &Setting::alpha;
};

// By how much the stepper's edge is off, to 1e-4 of itself; not a number where there is none within
// a tenth of it.
double missed(const Stepping& stepping, const Edge& edge, double inertia) {
  const auto stable = [&](double part) {
    Setting at = edge.at;
    at.*edge.turned *= part;
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

// Its mistake: a hinge of 1.5 % less inertia.
// The limit is alpha(beta); with alpha = 1, beta is below `max_beta` (0: without such a limit).
AnalyticCase edge_case(const char* name, SteppingScheme scheme, const std::array<double, 3>& betas,
                       double (*alpha)(double beta), double max_beta = 0) {
  std::vector<Edge> edges;
  for (const double beta : betas) edges.push_back({{alpha(beta), beta}});
  if (max_beta > 0) edges.push_back({{1, max_beta}, &Setting::beta});
  return {name, 0.01, [=](bool mistaken) {
            CaseResult result;
            for (const Edge& edge : edges)
              result.error = nan_max(result.error, missed(stepping_of(scheme), edge,
                                                          mistaken ? 0.985 * kHinge : kHinge));
            return result;
          }};
}

// How many settings grow.
CaseResult unstable(const Stepping& stepping, double max_alpha) {
  CaseResult result;
  for (const double alpha : {1e-2, 1.0, 1e2, 1e6, 1e10})
    for (const double beta : {0.0, 0.1, 1e2, 1e6})
      if (alpha <= max_alpha) result.error += grows(stepping, {alpha, beta}, kHinge) ? 1 : 0;
  return result;
}
Stepping by_integrator(Integrator integrator) {
  Stepping s = stepping_of(SteppingScheme::semi_implicit);
  s.integrator = integrator;
  return s;
}
// Its mistake: steps that are semi-implicit.
AnalyticCase integrator_case(const char* name, Integrator integrator) {
  return {name, 0, [integrator](bool mistaken) {
            return unstable(by_integrator(mistaken ? Integrator::semi_implicit : integrator), 1e6);
          }};
}

}  // namespace

CaseFamily stability_cases() {
  constexpr std::array<double, 3> kMiddling{0.15, 0.8, 1.5};
  const auto semi_implicit_limit = [](double b) { return 4 - 2 * b; };
  return {350,
          {edge_case(
               "F4-euler", SteppingScheme::euler, {0.2, 0.8, 1.5}, [](double b) { return b; }, 2.5),
           edge_case("F4-semi", SteppingScheme::semi_implicit, kMiddling, semi_implicit_limit),
           edge_case("F4-semi-difference", SteppingScheme::semi_implicit_difference, kMiddling,
                     semi_implicit_limit),
           edge_case("F4-euler-difference", SteppingScheme::euler_difference, {0.2, 0.5, 0.8},
                     [](double b) { return b * (1 - b); }),
           edge_case("F4-semi-older", SteppingScheme::semi_implicit_older, {0.15, 0.5, 0.8},
                     [](double b) { return 1 - b; }),
           edge_case(
               "F4-hold", SteppingScheme::hold, {0.2, 0.8, 1.5}, [](double b) { return 2 * b; }, 2),
           edge_case("F4-hold-difference", SteppingScheme::hold_difference, {0.2, 0.8, 1.5},
                     [](double b) { return 2 * b * (2 - b) / (2 + b); }),
           edge_case("F4-implicit-damper", SteppingScheme::implicit_damper, {0.15, 0.8, 3},
                     [](double b) { return 4 + 2 * b; }),
           {"F4-implicit", 0,
            [](bool mistaken) {
              const SteppingScheme scheme =
                  mistaken ? SteppingScheme::implicit_damper : SteppingScheme::implicit;
              return unstable(stepping_of(scheme), 1e10);
            }},
           integrator_case("F4-implicit-euler", Integrator::implicit_euler),
           integrator_case("F4-implicit-midpoint", Integrator::implicit_midpoint),
           integrator_case("F4-trapezoid", Integrator::trapezoid)}};
}

}  // namespace twinarm
