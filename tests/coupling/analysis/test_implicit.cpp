// Semi-implicit and implicit spring-dampers on mechanisms with known discrete motion:
// docs/understand/coupling_laws.md, solver/forces/spring.h.
#include <doctest/doctest.h>

#include "coupling/analysis/prediction.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kInertia = 0.7, kStep = 0.01;

// Couplings that are linear on one joint.
struct LinearCase {
  const char* name;
  JointType joint;
  CouplingSpec::Type type;
  SpringSpace measure;
};
constexpr LinearCase kCases[] = {{"linear spring on a slide", JointType::prismatic,
                                  CouplingSpec::Type::linear, SpringSpace::world},
                                 {"joint spring on a slide", JointType::prismatic,
                                  CouplingSpec::Type::torsional, SpringSpace::joint},
                                 {"joint spring on a hinge", JointType::revolute,
                                  CouplingSpec::Type::torsional, SpringSpace::joint},
                                 {"world spring on a hinge", JointType::revolute,
                                  CouplingSpec::Type::torsional, SpringSpace::world}};

CouplingSpec spec_of(const LinearCase& c, Discretization discretization, double k, double b) {
  CouplingSpec spec;
  spec.type = c.type;
  spec.measure = c.measure;
  spec.discretization = discretization;
  spec.springs = {{"spring", 1, {0.1, 0.2, -0.3}, k, b}};
  return spec;
}

}  // namespace

TEST_CASE("implicit and semi-implicit: one degree of freedom follows its recurrence to 1e-12") {
  struct {
    Discretization discretization;
    double k, b;
  } const rows[] = {{Discretization::implicit, 30, 0.05 * std::sqrt(30)},
                    {Discretization::implicit, 7e3, 0.05 * std::sqrt(7e3)},
                    {Discretization::implicit, 7e6, 0.05 * std::sqrt(7e6)},
                    {Discretization::semi_implicit, 3e3, 400}};
  for (const LinearCase& c : kCases)
    for (const auto& row : rows) {
      const double k = row.k, b = row.b, h = kStep;
      CAPTURE(c.name);
      CAPTURE(k);
      const bool implicit = row.discretization == Discretization::implicit;
      const Model<double> model = one_joint(c.joint, kInertia);
      SteadyHand hand;
      hand.angle[0] = 0.4;
      hand.rate[0] = -0.6;
      Coupled system(model, hand, {"joint1"}, spec_of(c, row.discretization, k, b),
                     state_of(model, {-0.3}, {0.8}));
      double x = -0.3, v = 0.8, worst = 0;
      for (int n = 0; n < 200; ++n) {
        // Target at the end of the step (backward Euler), or at its start with an implicit damper.
        const double target = 0.4 - 0.6 * h * (implicit ? n + 1 : n);
        v = (kInertia * v + h * k * (target - x) - h * b * 0.6) /
            (kInertia + h * b + (implicit ? h * h * k : 0));
        x += h * v;
        system.simulation.step(h);
        worst = std::max(worst, std::abs(system.simulation.state().q[0] - x));
      }
      CHECK(worst < 1e-12);
    }
}

TEST_CASE("implicit: the product of the two eigenvalues of a step is 1/(1 + alpha + beta)") {
  for (const LinearCase& c : kCases)
    for (double alpha : {0.01, 1.0, 400.0})
      for (double beta : {0.0, 0.3, 20.0}) {
        CAPTURE(c.name);
        const Model<double> model = one_joint(c.joint, kInertia);
        Eigen::Matrix2d A;  // of one step, by columns
        for (Eigen::Index column = 0; column < 2; ++column) {
          const double q = column == 0 ? 1e-3 : 0, qd = column == 1 ? 1e-3 : 0;
          Coupled system(model, {}, {"joint1"},
                         spec_of(c, Discretization::implicit, alpha * kInertia / (kStep * kStep),
                                 beta * kInertia / kStep),
                         state_of(model, {q}, {qd}));
          system.simulation.step(kStep);
          const State<double>& x = system.simulation.state();
          A.col(column) << 1e3 * x.q[0], 1e3 * x.qd[0];
        }
        CHECK(A.determinant() == doctest::Approx(1 / (1 + alpha + beta)).epsilon(1e-10));
        const Eigen::Vector2d size = eigenvalues_of(A).cwiseAbs();
        if (beta * beta < 4 * alpha)  // a complex pair of this magnitude
          CHECK(size.maxCoeff() == doctest::Approx(1 / std::sqrt(1 + alpha + beta)).epsilon(1e-6));
      }
}

TEST_CASE("a horizontal link has the static deflection with all three discretizations") {
  const double m = 3, c = 0.2, r = 0.25, k = 80, g = 9.81;
  ModelBuilder builder;
  builder.add_body("link", 0, "joint1", JointType::revolute, {}, Vector3::UnitY(),
                   {m, {c, 0, 0}, 0.02 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  SteadyHand hand;
  hand.angle[0] = 0.3;
  for (const CouplingSpec::Type type : {CouplingSpec::Type::torsional, CouplingSpec::Type::linear})
    for (const SpringSpace measure : {SpringSpace::joint, SpringSpace::world})
      for (const Discretization discretization :
           {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
        const bool linear = type == CouplingSpec::Type::linear;
        CouplingSpec spec;
        spec.type = type;
        spec.measure = measure;
        spec.discretization = discretization;
        const double scale = linear ? 1 / (r * r) : 1;
        spec.springs = {{"spring", 1, {r, 0, 0}, k * scale, 4 * scale}};
        Coupled system(model, hand, {"joint1"}, spec, state_of(model, {0.3}, {0}));
        for (int n = 0; n < 20000; ++n) system.simulation.step(1e-3);
        const double q = system.simulation.state().q[0];
        const double tau_g = m * g * c * std::cos(q);  // about +y: downwards, q > 0
        const double sag = q - 0.3;
        CHECK(sag > 0.01);
        if (linear)
          CHECK(std::abs(std::sin(sag) - tau_g / (spec.springs[0].k * r * r)) < 1e-12);
        else
          CHECK(std::abs(sag - tau_g / k) < 1e-12);
      }
}

TEST_CASE(
    "a two-link arm at w h = 85 settles with implicit springs, and diverges with explicit ones") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  SteadyHand hand;
  hand.angle = {0.5, -0.9, 0};
  const double h = 1e-3;
  for (const bool point : {true, false}) {
    const auto spec = [&](double k, double b, Discretization discretization) {
      return point ? linear(arm.springs(k, b), discretization)
                   : torsional(arm.springs(k, b), SpringSpace::world, discretization);
    };
    const State<double> start = state_of(model, {0.3, -0.6}, {2, -3});
    State<double> pose(model);
    pose.q = {0.5, -0.9};
    Coupled unit(model, hand, {"joint1", "joint2"}, spec(1, 0, Discretization::explicit_), pose);
    const double per_gain =
        squared_frequencies(mass_matrix(model, pose),
                            unit.coupling->joint_space(unit.simulation.kinematics()).K)
            .maxCoeff();
    const double w = 85 / h, k = w * w / per_gain, b = 2 * 0.7 * k / w;
    Coupled still(model, hand, {"joint1", "joint2"}, spec(k, b, Discretization::implicit), start);
    for (int n = 0; n < 1000; ++n) CHECK_UNARY(still.simulation.step(h).finite);
    CHECK(std::abs(still.simulation.state().q[0] - 0.5) < 1e-9);
    CHECK(std::abs(still.simulation.state().q[1] + 0.9) < 1e-9);
    CHECK(std::abs(still.simulation.state().qd[1]) < 1e-6);
    Coupled wild(model, hand, {"joint1", "joint2"}, spec(k, b, Discretization::explicit_), start);
    bool finite = true;
    for (int n = 0; n < 1000 && finite; ++n)
      finite = wild.simulation.step(h).finite && std::abs(wild.simulation.state().qd[0]) < 1e6;
    CHECK_FALSE(finite);
  }
}

TEST_CASE("implicit and semi-implicit converge to the explicit motion with order 1 in h") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  SteadyHand hand;
  hand.angle = {0.5, -0.9, 0};
  hand.rate = {1, -2, 0};
  const auto end = [&](const CouplingSpec& spec, Integrator integrator, double h) {
    Coupled system(model, hand, {"joint1", "joint2"}, spec, state_of(model, {0.2, -0.5}, {0, 0}),
                   integrator);
    for (long n = 0; n < std::lround(0.5 / h); ++n) system.simulation.step(h);
    return Eigen::Vector2d(system.simulation.state().q[0], system.simulation.state().q[1]);
  };
  for (const bool point : {true, false}) {
    const auto spec = [&](Discretization discretization) {
      return point ? linear(arm.springs(2000, 60), discretization)
                   : torsional(arm.springs(100, 3), SpringSpace::world, discretization);
    };
    const Eigen::Vector2d exact = end(spec(Discretization::explicit_), Integrator::rk4, 1e-4);
    for (const Discretization discretization :
         {Discretization::semi_implicit, Discretization::implicit}) {
      const auto error = [&](double h) {
        return (end(spec(discretization), Integrator::semi_implicit, h) - exact).norm();
      };
      CHECK(std::abs(std::log2(error(5e-4) / error(2.5e-4)) - 1) < 0.1);
      CHECK(error(2.5e-4) < 1e-2);
    }
  }
}
