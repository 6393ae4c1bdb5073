// Modes of mechanisms with closed loops, against frequencies from energy.
#include <doctest/doctest.h>

#include <cmath>

#include "app/modes/linear_system.h"
#include "solver/dynamics/model_builder.h"
#include "solver/loops/loop_closure.h"

using namespace twinarm;

namespace {

constexpr double kFall = 9.81;

const AppliedForces no_push = [](const State<double>&, const Kinematics&, Forces<double>&) {};

// Slender, hanging from its origin to (0, -length), in the plane of x and y.
BodyInertia hanging_rod(double mass, double length) {
  const double I = mass * length * length / 12;
  return {mass, {0, -length / 2, 0}, Vector3(I, 0, I).asDiagonal()};
}
ModelBuilder builder_in_plane() {
  ModelBuilder builder;
  builder.set_gravity({0, -kFall, 0});
  return builder;
}
LoopClosure closure_of_type(LoopType type, int a, Vector3 on_a, int b, Vector3 on_b) {
  LoopClosure closure;
  closure.name = "pin", closure.type = type;
  closure.body_a = a, closure.body_b = b;
  closure.X_LaC.p = on_a, closure.X_LbC.p = on_b;
  return closure;
}

// Two cranks of length l hang from the ceiling, a bar between their ends.
constexpr double kCrank = 0.5, kCrankMass = 1.5, kBarMass = 4, kWidth = 0.8;
Model<double> parallelogram() {
  ModelBuilder builder = builder_in_plane();
  builder.add_body("left", 0, "left", JointType::revolute, {}, Vector3::UnitZ(),
                   hanging_rod(kCrankMass, kCrank));
  builder.add_body("bar", 1, "pin", JointType::revolute, {Matrix3::Identity(), {0, -kCrank, 0}},
                   Vector3::UnitZ(),
                   {kBarMass, {kWidth / 2, 0, 0}, Vector3(0, 0.3, 0.3).asDiagonal()});
  builder.add_body("right", 0, "right", JointType::revolute, {Matrix3::Identity(), {kWidth, 0, 0}},
                   Vector3::UnitZ(), hanging_rod(kCrankMass, kCrank));
  return builder.build();
}
constexpr double kSwinging = 2 * kCrankMass / 3 + kBarMass;  // times l^2

// Crank and rod hang in line, the piston moves along y below them. theta is independent; phi: angle
// of the rod in the plane.
struct SliderCrank {
  double r = 0.3, L = 0.7, crank = 1, rod = 2, piston = 1.5;

  Model<double> model() const {
    ModelBuilder builder = builder_in_plane();
    builder.add_body("crank", 0, "crank", JointType::revolute, {}, Vector3::UnitZ(),
                     hanging_rod(crank, r));
    builder.add_body("rod", 1, "rod", JointType::revolute, {Matrix3::Identity(), {0, -r, 0}},
                     Vector3::UnitZ(), hanging_rod(rod, L));
    builder.add_body("piston", 0, "piston", JointType::prismatic, {}, Vector3::UnitY(),
                     {piston, Vector3::Zero(), Matrix3::Identity()});
    return builder.build();
  }
  LoopClosure pin() const {
    return closure_of_type(LoopType::ball, 2, {0, -L, 0}, 3, Vector3::Zero());
  }

  double phi(double theta) const { return std::asin(-r / L * std::sin(theta)); }
  double phi_rate(double theta) const { return -r / L * std::cos(theta) / std::cos(phi(theta)); }
  double shift(double theta) const { return -r * std::cos(theta) - L * std::cos(phi(theta)); }
  double shift_rate(double theta) const {
    return r * std::sin(theta) + L * std::sin(phi(theta)) * phi_rate(theta);
  }
  // Kinetic energy is half of this times theta'^2.
  double inertia(double theta) const {
    const double p = phi(theta), dp = phi_rate(theta), ds = shift_rate(theta);
    const double vx = r * std::cos(theta) + L / 2 * std::cos(p) * dp;
    const double vy = r * std::sin(theta) + L / 2 * std::sin(p) * dp;
    return crank * r * r / 3 + rod * (vx * vx + vy * vy + L * L / 12 * dp * dp) + piston * ds * ds;
  }
  double potential(double theta) const {
    return -kFall * (crank * r / 2 * std::cos(theta) +
                     rod * (r * std::cos(theta) + L / 2 * std::cos(phi(theta)))) +
           kFall * piston * shift(theta);
  }
  // J theta'' + J' theta'^2 / 2 + V' = 0
  double acceleration(double theta, double rate) const;

  State<double> state(const Model<double>& of, double theta, double rate) const {
    State<double> x(of);
    x.q = {theta, phi(theta) - theta, shift(theta)};
    x.qd = {rate, (phi_rate(theta) - 1) * rate, shift_rate(theta) * rate};
    return x;
  }
};

// Central differences with Richardson extrapolation.
template <class F>
double derivative(F f, double x) {
  const double h = 4e-3;
  const auto at = [&](double s) { return (f(x + s) - f(x - s)) / (2 * s); };
  const double a = at(h), b = at(h / 2), c = at(h / 4);
  return ((16 * (4 * c - b) / 3) - (4 * b - a) / 3) / 15;
}
double SliderCrank::acceleration(double theta, double rate) const {
  const double dJ = derivative([&](double t) { return inertia(t); }, theta);
  const double dV = derivative([&](double t) { return potential(t); }, theta);
  return -(dJ * rate * rate / 2 + dV) / inertia(theta);
}

}  // namespace

TEST_CASE("a hanging parallelogram has the frequency of its energies, with three or five rows") {
  const Model<double> model = parallelogram();
  const double wanted =
      std::sqrt(kFall * (kCrankMass + kBarMass) / (kSwinging * kCrank));  // 2 m l/2 + M l
  for (const LoopType type : {LoopType::ball, LoopType::hinge}) {
    CAPTURE(facts_of(type).name);
    const LoopedSystem looped =
        linearise_with_loops(model, State<double>(model), no_push,
                             {closure_of_type(type, 2, {kWidth, 0, 0}, 3, {0, -kCrank, 0})});
    REQUIRE(looped.system.dofs.size() == 1);
    const std::vector<Mode> modes = modes_of(looped.system.A);
    REQUIRE(modes.size() == 1);
    CHECK(modes[0].frequency() == doctest::Approx(wanted).epsilon(1e-11));
    const Mode all = by_all_velocities(looped, modes[0]);
    CHECK(std::abs(all.shape[0] - 1.0) < 1e-11);
    CHECK(std::abs(all.shape[1] + 1.0) < 1e-11);  // the bar does not rotate
    CHECK(std::abs(all.shape[2] - 1.0) < 1e-11);
    CHECK(looped.system.B(1, 0) ==
          doctest::Approx(1 / (kSwinging * kCrank * kCrank)).epsilon(1e-11));
  }
}

TEST_CASE("a spring-damper on one crank of a parallelogram acts on the whole mechanism") {
  const Model<double> model = parallelogram();
  const double k = 25, b = 0.7, inertia = kSwinging * kCrank * kCrank;
  const AppliedForces spring = [&](const State<double>& x, const Kinematics&, Forces<double>& f) {
    f.tau[2] += -k * x.q[2] - b * x.qd[2];
  };
  const LoopedSystem looped = linearise_with_loops(
      model, State<double>(model), spring,
      {closure_of_type(LoopType::ball, 2, {kWidth, 0, 0}, 3, {0, -kCrank, 0})});
  const std::vector<Mode> modes = modes_of(looped.system.A);
  REQUIRE(modes.size() == 1);
  const double w2 = (kFall * (kCrankMass + kBarMass) * kCrank + k) / inertia;
  CHECK(modes[0].frequency() == doctest::Approx(std::sqrt(w2)).epsilon(1e-11));
  CHECK(modes[0].damping_ratio() ==
        doctest::Approx(b / (2 * inertia * std::sqrt(w2))).epsilon(1e-11));
}

TEST_CASE("hanging slider-crank: the piston's weight adds stiffness, its mass no inertia") {
  // V'' = m1 g r/2 + m2 g (r + r^2/2L) + m3 g (r + r^2/L), J = (m1 +
  // m2) r^2/3.
  const SliderCrank crank;
  const Model<double> model = crank.model();
  const LoopedSystem looped =
      linearise_with_loops(model, crank.state(model, 0, 0), no_push, {crank.pin()});
  const std::vector<Mode> modes = modes_of(looped.system.A);
  REQUIRE(modes.size() == 1);
  const double r = crank.r, L = crank.L;
  const double stiffness = kFall * (crank.crank * r / 2 + crank.rod * (r + r * r / (2 * L)) +
                                    crank.piston * (r + r * r / L));
  const double inertia = (crank.crank + crank.rod) * r * r / 3;
  CHECK(modes[0].frequency() == doctest::Approx(std::sqrt(stiffness / inertia)).epsilon(1e-10));
}

TEST_CASE("slider-crank in motion: A is the derivative of its equation by angle and rate") {
  const SliderCrank crank;
  const Model<double> model = crank.model();
  for (const double theta : {0.4, 0.9, -2.0})
    for (const double rate : {0.0, 3.0}) {
      CAPTURE(theta);
      CAPTURE(rate);
      const LoopedSystem looped =
          linearise_with_loops(model, crank.state(model, theta, rate), no_push, {crank.pin()});
      REQUIRE(looped.system.dofs.size() == 1);
      REQUIRE(looped.system.dofs[0] == 0);
      const double by_angle =
          derivative([&](double t) { return crank.acceleration(t, rate); }, theta);
      const double by_rate =
          derivative([&](double w) { return crank.acceleration(theta, w); }, rate);
      CHECK(looped.qdd[0] == doctest::Approx(crank.acceleration(theta, rate)).epsilon(1e-8));
      CHECK(std::abs(looped.system.A(1, 0) - by_angle) < 1e-6 * (1 + std::abs(by_angle)));
      CHECK(std::abs(looped.system.A(1, 1) - by_rate) < 1e-6 * (1 + std::abs(by_rate)));
    }
}

TEST_CASE("a gear couples two wheels by its ratio; a locked joint makes two links one") {
  ModelBuilder builder = builder_in_plane();
  const auto wheel = [](double I) {
    return BodyInertia{1, Vector3::Zero(), I * Matrix3::Identity()};
  };
  builder.add_body("a", 0, "a", JointType::revolute, {}, Vector3::UnitZ(), wheel(0.2));
  builder.add_body("b", 0, "b", JointType::revolute, {}, Vector3::UnitZ(), wheel(0.5));
  const Model<double> wheels = builder.build();
  LoopClosure gear = closure_of_type(LoopType::gear, 1, {}, 2, {});
  gear.ratio = 3;  // q_a = 3 q_b
  const AppliedForces spring = [](const State<double>& x, const Kinematics&, Forces<double>& f) {
    f.tau[0] -= 12 * x.q[0];
  };
  const LoopedSystem geared = linearise_with_loops(wheels, State<double>(wheels), spring, {gear});
  REQUIRE(geared.system.dofs.size() == 1);
  CHECK(modes_of(geared.system.A)[0].frequency() ==
        doctest::Approx(std::sqrt(12 * 9 / (0.2 * 9 + 0.5))).epsilon(1e-12));

  ModelBuilder two = builder_in_plane();
  two.add_body("upper", 0, "shoulder", JointType::revolute, {}, Vector3::UnitZ(),
               hanging_rod(1, 0.4));
  two.add_body("lower", 1, "elbow", JointType::revolute, {Matrix3::Identity(), {0, -0.4, 0}},
               Vector3::UnitZ(), hanging_rod(1, 0.4));
  const Model<double> arm = two.build();
  const LoopedSystem stiff = linearise_with_loops(
      arm, State<double>(arm), no_push, {closure_of_type(LoopType::locked, 2, {}, 0, {})});
  REQUIRE(stiff.system.dofs.size() == 1);
  CHECK(modes_of(stiff.system.A)[0].frequency() ==  // one rod of 0.8 m: 3 g / 2 L
        doctest::Approx(std::sqrt(1.5 * kFall / 0.8)).epsilon(1e-12));
}

TEST_CASE("without loops the result is linearise(); fixed velocities are left out") {
  const Model<double> model = parallelogram();
  const State<double> x(model);
  const LinearSystem free = linearise(model, x, no_push);
  const LoopedSystem none = linearise_with_loops(model, x, no_push, {});
  CHECK((none.system.A - free.A).norm() < 1e-12 * free.A.norm());
  CHECK((none.system.B - free.B).norm() < 1e-12 * free.B.norm());
  const LoopedSystem still = linearise_with_loops(model, x, no_push, {}, {0, 1});
  REQUIRE(still.system.dofs == std::vector<std::size_t>{2});
  CHECK(modes_of(still.system.A)[0].frequency() ==
        doctest::Approx(std::sqrt(1.5 * kFall / kCrank)).epsilon(1e-11));
}
