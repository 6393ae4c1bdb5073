// Modes with known frequencies.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "app/modes/linear_system.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

const AppliedForces nothing = [](const State<double>&, const Kinematics&, Forces<double>&) {};

// Point masses on n hinges in a row, all hanging, length 1.
Model<double> pendulum_of(int n) {
  ModelBuilder builder;
  const double l = 1.0 / n;
  for (int i = 1; i <= n; ++i)
    builder.add_body("bob" + std::to_string(i), i - 1, "hinge" + std::to_string(i),
                     JointType::revolute, {Matrix3::Identity(), {0, 0, i == 1 ? 0.0 : -l}},
                     Vector3::UnitY(), {1.0, {0, 0, -l}, Matrix3::Zero()});
  return builder.build();
}

Model<double> cart_and_pole() {
  ModelBuilder builder;
  builder.add_body("cart", 0, "slide", JointType::prismatic, {}, Vector3::UnitX(),
                   {1.0, Vector3::Zero(), Matrix3::Zero()});
  const double m = 0.3, L = 1.0;
  const Vector3 about_com(m * L * L / 12, m * L * L / 12, 0);
  builder.add_body("pole", 1, "hinge", JointType::revolute, {}, Vector3::UnitY(),
                   {m, {0, 0, -L / 2}, about_com.asDiagonal()});
  return builder.build();
}

std::vector<Mode> modes_at(const Model<double>& model, const State<double>& x,
                           const AppliedForces& push = nothing) {
  return modes_of(linearise(model, x, push).A);
}

}  // namespace

TEST_CASE("n hanging point masses have frequencies at the zeros of Laguerre's polynomial") {
  const double g = 9.81;
  const std::vector<std::vector<double>> zeros{
      {1},
      {2 - std::sqrt(2.0), 2 + std::sqrt(2.0)},
      {0.415774556783479083, 2.29428036027904172, 6.28994508293747920}};
  for (const std::vector<double>& x : zeros) {
    const int n = static_cast<int>(x.size());
    const Model<double> model = pendulum_of(n);
    const std::vector<Mode> modes = modes_at(model, State<double>(model));
    REQUIRE(modes.size() == x.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      CHECK(modes[k].frequency() == doctest::Approx(std::sqrt(n * g * x[k])).epsilon(1e-12));
      CHECK(std::abs(modes[k].damping_ratio()) < 1e-12);
      CHECK(modes[k].eigenvalue.imag() > 0);
    }
  }
}

TEST_CASE("cart-pole: oscillation when hanging, growth and decay when upright, drift of the cart") {
  const Model<double> model = cart_and_pole();
  const double wanted = 4.2183982411491488;  // w^2 = m g l / (J - m^2 l^2 / (M + m))
  State<double> x(model);
  const std::vector<Mode> hanging = modes_at(model, x);
  REQUIRE(hanging.size() == 3);
  CHECK(hanging[0].eigenvalue == 0.0);
  CHECK(hanging[1].eigenvalue == 0.0);
  CHECK(std::abs(hanging[0].shape[0]) == doctest::Approx(1));
  CHECK(std::abs(hanging[0].shape[1]) < 1e-9);
  CHECK(hanging[2].frequency() == doctest::Approx(wanted).epsilon(1e-12));

  x.q[1] = std::numbers::pi;
  const std::vector<Mode> upright = modes_at(model, x);
  REQUIRE(upright.size() == 4);
  CHECK(upright[0].eigenvalue == 0.0);
  CHECK(upright[1].eigenvalue == 0.0);
  double product = 1;
  for (std::size_t k : {2, 3}) {
    CHECK(upright[k].eigenvalue.imag() == 0);
    CHECK(upright[k].frequency() == doctest::Approx(wanted).epsilon(1e-12));
    product *= upright[k].eigenvalue.real();
  }
  CHECK(product < 0);
}

TEST_CASE(
    "spring-damper: omega = sqrt(k/I), zeta = b / (2 sqrt(k I)); overdamped: two real "
    "eigenvalues") {
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("wheel", 0, "axle", JointType::revolute, {}, {1, 2, 2},
                   {1.0, Vector3::Zero(), 0.25 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  const double k = 40, I = 0.25;
  for (const double b : {0.0, 0.7, 30.0}) {
    CAPTURE(b);
    const AppliedForces spring = [&](const State<double>& x, const Kinematics&, Forces<double>& f) {
      f.tau[0] += -k * x.q[0] - b * x.qd[0];
    };
    const std::vector<Mode> modes = modes_at(model, State<double>(model), spring);
    if (b < 2 * std::sqrt(k * I)) {
      REQUIRE(modes.size() == 1);
      CHECK(modes[0].frequency() == doctest::Approx(std::sqrt(k / I)).epsilon(1e-12));
      CHECK(std::abs(modes[0].damping_ratio() - b / (2 * std::sqrt(k * I))) < 1e-12);
    } else {
      REQUIRE(modes.size() == 2);
      const double root = std::sqrt(b * b - 4 * k * I);
      CHECK(modes[0].eigenvalue.real() == doctest::Approx((-b + root) / (2 * I)).epsilon(1e-11));
      CHECK(modes[1].eigenvalue.real() == doctest::Approx((-b - root) / (2 * I)).epsilon(1e-11));
    }
  }
}

TEST_CASE("a point spring with a distant target has geometric stiffness") {
  // I w^2 = k r R for a point at radius r and a target at radius R in line with it.
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  builder.add_body("wheel", 0, "axle", JointType::revolute, {}, Vector3::UnitZ(),
                   {1.0, Vector3::Zero(), 0.25 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  const double k = 100, r = 0.3, R = 1.1, I = 0.25;
  const AppliedForces pull = [&](const State<double>&, const Kinematics& kin, Forces<double>& f) {
    const Vector3 arm = kin.X_WL[1].R * Vector3(r, 0, 0);
    const Vector3 force = k * (Vector3(R, 0, 0) - arm);
    f.f_ext[1] += {from_eigen(kin.R_WB[1].transpose() * arm.cross(force)),
                   from_eigen(kin.R_WB[1].transpose() * force)};
  };
  const std::vector<Mode> modes = modes_at(model, State<double>(model), pull);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].frequency() == doctest::Approx(std::sqrt(k * r * R / I)).epsilon(1e-11));
}

TEST_CASE("A equals differences of aba() at random states of joints with vector coordinates") {
  Random random(5);
  const Model<double> model =
      random_tree(random, 5, {JointType::revolute, JointType::prismatic, JointType::universal});
  const State<double> x = random_state(random, model);
  const LinearSystem system = linearise(model, x, nothing);
  const auto n = static_cast<Eigen::Index>(model.nv);
  CHECK((system.A.topRightCorner(n, n) - Eigen::MatrixXd::Identity(n, n)).norm() == 0);
  CHECK(system.A.topLeftCorner(n, n).norm() == 0);
  CHECK((system.B.bottomRows(n) - system.B.bottomRows(n).transpose()).norm() <
        1e-12 * system.B.norm());
}
