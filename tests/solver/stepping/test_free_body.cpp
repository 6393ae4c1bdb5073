// A free rigid body against closed forms (docs/cases.md, A1, A2): the free joint and its group.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/solver/dynamics/random_tree.h"
#include "tests/solver/stepping/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Quaternion = Eigen::Quaterniond;

BodyInertia diagonal(double mass, double I1, double I2, double I3) {
  return {mass, Vector3::Zero(), Vector3(I1, I2, I3).asDiagonal()};
}
Quaternion orientation(const State<double>& x) {
  return {x.q[3], x.q[4], x.q[5], x.q[6]};
}
Vector3 rate(const State<double>& x) {
  return {x.qd[0], x.qd[1], x.qd[2]};
}
State<double> spinning(const Model<double>& model, const Vector3& w) {
  State<double> x(model);
  for (int k = 0; k < 3; ++k) x.qd[static_cast<std::size_t>(k)] = w[k];
  return x;
}
double angle_between(const Quaternion& a, const Quaternion& b) {
  return a.angularDistance(b);
}

struct Row {
  double t;
  Quaternion orientation;
  Vector3 rate;
};

}  // namespace

TEST_CASE("a spinning symmetric body under rk4 of 1 ms precesses as the closed form, to 1e-8") {
  const Model<double> model = free_body(diagonal(1, 0.04, 0.04, 0.02), Vector3::Zero());
  const Row table[] = {
      {1,
       {-0.75015282954333481, 0.19689177386125114, -0.59255951164587993, 0.2176639310310615},
       {-1.6022872310938674, -1.196944288207913, 5.0}},
      {5,
       {-0.12366243070076768, 0.61734743258548386, 0.02049438798735788, 0.77664002650797811},
       {1.9955965583571613, 0.13264379470240138, 5.0}},
      {10,
       {-0.96857516658840294, -0.18411263317329652, -0.012237643031846953, -0.1667780713021581},
       {1.9824056237269472, 0.26470350019554606, 5.0}},
  };
  const Vector3 H = Vector3(0.04 * 2, 0, 0.02 * 5);
  for (const Row& row : table) {
    CAPTURE(row.t);
    const State<double> x =
        run(model, spinning(model, {2, 0, 5}), Integrator::rk4, 0.001, std::lround(row.t * 1000));
    CHECK(angle_between(orientation(x), row.orientation) < 1e-8);
    CHECK((rate(x) - row.rate).norm() < 1e-8);
    const Quaternion closed_form(
        Eigen::AngleAxisd(H.norm() / 0.04 * row.t, H.normalized()) *
        Eigen::AngleAxisd(5 * (0.04 - 0.02) / 0.04 * row.t, Vector3::UnitZ()));
    CHECK(angle_between(orientation(x), closed_form) < 1e-8);
  }
}

TEST_CASE("a spinning asymmetric body under rk4 of 1 ms follows Jacobi's functions, to 1e-8") {
  const Model<double> model = free_body(diagonal(1, 1, 2, 3), Vector3::Zero());
  const Row table[] = {
      {1,
       {0.77903960258822208, 0.35820926595727759, 0.1958299706947999, 0.4758508610470377},
       {0.57780247181207994, 0.81617663747981084, 0.88201581551053634}},
      {2,
       {0.31471045431246096, 0.2326940711691227, 0.37018177392959456, 0.84248219769887259},
       {-0.21637836906745774, 0.97630958276548072, 0.82599830480057947}},
      {5,
       {-0.89205938023754275, 0.34571995700736429, -0.24610292441078016, 0.15537414216496626},
       {-0.16435042976526949, -0.98640201552712331, 0.82199169982914645}},
      {10,
       {0.86144117406547744, 0.10734075762015901, 0.22094732179436732, -0.44449898354227806},
       {-0.92106999844433224, 0.38939704411533198, 0.97440066058308243}},
  };
  for (const Row& row : table) {
    CAPTURE(row.t);
    const State<double> x =
        run(model, spinning(model, {1, 0, 1}), Integrator::rk4, 0.001, std::lround(row.t * 1000));
    CHECK(angle_between(orientation(x), row.orientation) < 1e-8);
    CHECK((rate(x) - row.rate).norm() < 1e-8);
  }
}

TEST_CASE("a spinning body: the error of its orientation falls by 16 when h halves (rk4)") {
  const Model<double> model = free_body(diagonal(1, 1, 2, 3), Vector3::Zero());
  const Quaternion exact(0.77903960258822208, 0.35820926595727759, 0.1958299706947999,
                         0.4758508610470377);
  const auto error = [&](long steps) {
    const State<double> x = run(model, spinning(model, {1, 0, 1}), Integrator::rk4,
                                1.0 / static_cast<double>(steps), steps);
    return (orientation(x).coeffs() - exact.coeffs()).norm();
  };
  CHECK(std::abs(std::log2(error(20) / error(40)) - 4) < 0.15);
  CHECK(std::abs(std::log2(error(40) / error(80)) - 4) < 0.15);
}

TEST_CASE("a body thrown with spin: its centre of mass, off its origin, flies the parabola") {
  Random random(11);
  BodyInertia inertia = random.inertia();
  const Vector3 g(0.3, -0.7, -9.81);
  const Model<double> model = free_body(inertia, g);
  State<double> x = spinning(model, {2, -3, 4});
  for (std::size_t k = 3; k < 6; ++k) x.qd[k] = random.uniform(-3, 3);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  const Vector3 p0 = k.position(1, inertia.com), v0 = k.velocity(1, p0);
  for (const long steps : {500L, 2000L}) {
    const double t = 0.001 * static_cast<double>(steps);
    forward_kinematics(model, run(model, x, Integrator::rk4, 0.001, steps), k);
    CHECK((k.position(1, inertia.com) - (p0 + v0 * t + 0.5 * g * t * t)).norm() < 1e-8);
  }
}

TEST_CASE("semi-implicit: a body that falls from rest is at -g t (t + h) / 2, its own recurrence") {
  const Model<double> model = free_body(diagonal(2, 0.1, 0.2, 0.25), {0, 0, -9.81});
  const State<double> x = run(model, State<double>(model), Integrator::semi_implicit, 0.01, 150);
  CHECK(std::abs(x.q[2] + 9.81 * 1.5 * 1.51 / 2) < 1e-12);
  CHECK(std::abs(x.q[0]) + std::abs(x.q[1]) < 1e-15);
}

TEST_CASE("the quaternion of a spinning body stays of unit length for 100 000 steps") {
  const Model<double> model = free_body(diagonal(1, 1, 2, 3), Vector3::Zero());
  const State<double> x =
      run(model, spinning(model, {1, 5, 3}), Integrator::semi_implicit, 0.001, 100000);
  CHECK(std::abs(orientation(x).norm() - 1) < 1e-12);
}

TEST_CASE("a body that spins about a principal axis turns by w t exactly under every integrator") {
  const Model<double> model = free_body(diagonal(1, 1, 2, 3), Vector3::Zero());
  for (Integrator integrator : {Integrator::euler, Integrator::semi_implicit, Integrator::rk4}) {
    const State<double> x = run(model, spinning(model, {0, 0, 7}), integrator, 0.01, 1000);
    const Quaternion exact(Eigen::AngleAxisd(70, Vector3::UnitZ()));
    CHECK(angle_between(orientation(x), exact) < 1e-11);
  }
}
