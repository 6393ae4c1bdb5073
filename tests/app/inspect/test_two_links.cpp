// An arm of two hinges, worked by hand in fractions: all three passes, in the axes of the file.
//
// Hinges along z, links along x, gravity (0, -10, 0). Link 1: 1 m to the next hinge, 2 kg, centre
// of mass at 1/2, 1/6 kg m^2 about it. Link 2: 3 kg, at 1/2, 1/4 kg m^2. q = (0, 90 deg), qd = (1,
// 2), tau = (5, -1). In the plane, of each vector (w; x, y):
//   v1 = (1; 0, 0)                 v2 = (1; 1, 0) + (2; 0, 0) = (3; 1, 0)
//   c1 = 0                         c2 = v2 x S qd2 = (0; 0, -2)
//   I1: 2/3, h = (1, 0)            I2: 1, h = (3/2, 0)
//   I v = (2/3; 0, 1)              I v = (3; 3, 9/2)
//   p1 = (0; -1, 0)                p2 = (9/2; -27/2, 9)
//   U2 = (1; 0, 3/2), D2 = 1, u2 = -1 - 9/2 = -11/2
//   Ia2 = diag(0; 3, 3 - 9/4 = 3/4), pa2 = p2 + Ia c2 + U2 u2 = (-1; -27/2, -3/4)
//   in link 1 (x2 = y1, y2 = -x1, 1 m further out):
//     X^T Ia X = (3 0 3; 0 3/4 0; 3 0 3), X^T pa = (-29/2; 3/4, -27/2)
//   IA1 = (11/3 0 4; 0 11/4 0; 4 0 5), pA1 = (-29/2; -1/4, -27/2)
//   U1 = (11/3; 0, 4), D1 = 11/3, u1 = 5 + 29/2 = 39/2
//   a1' = (0; 0, 10), qdd1 = (39/2 - 40) 3/11 = -123/22, a1 = (-123/22; 0, 10)
//   a2' = (-123/22; 97/22, -2), qdd2 = -11/2 + 123/22 + 3 = 34/11, a2 = (-5/2; 97/22, -2)
// Lagrange: 14/3 qdd1 + qdd2 = 5 + 12 - 40, qdd1 + qdd2 = -1 - 3/2.
#include <doctest/doctest.h>

#include <map>
#include <numbers>

#include "app/inspect/force_balance.h"
#include "app/inspect/inspection.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// The arm in axes rotated by R.
Model<double> arm(const Matrix3& R) {
  ModelBuilder builder;
  builder.set_gravity(R * Vector3(0, -10, 0));
  const Vector3 along = R * Vector3(1, 0, 0);
  const auto inertia = [&](double I) {
    return Matrix3(R * Vector3(0, I, I).asDiagonal() * R.transpose());
  };
  builder.add_body("upper", 0, "shoulder", JointType::revolute, {}, R * Vector3::UnitZ(),
                   {2, 0.5 * along, inertia(1.0 / 6)});
  builder.add_body("lower", 1, "elbow", JointType::revolute, {Matrix3::Identity(), along},
                   R * Vector3::UnitZ(), {3, 0.5 * along, inertia(1.0 / 4)});
  return builder.build();
}

Inspection at_the_state(const Model<double>& model) {
  State<double> x(model);
  x.q = {0, std::numbers::pi / 2};
  x.qd = {1, 2};
  return {model, x, {{"actuator", {}, {{0, 5, 0}, {1, -1, 0}}}}};
}

std::map<std::string, Eigen::MatrixXd> all_of(const Inspection& in, std::size_t body) {
  std::map<std::string, Eigen::MatrixXd> all;
  for (int pass = 1; pass <= 3; ++pass)
    for (const DisplayedQuantity& shown : shown_quantities(in, pass, body))
      all[shown.quantity.name] = shown.value;
  return all;
}

struct Plane {
  double w, x, y;
};
// (w; x, y) of the plane, in the axes of the file.
Vector6 turned(const Matrix3& R, const Plane& p) {
  return (Vector6() << R * Vector3(0, 0, p.w), R * Vector3(p.x, p.y, 0)).finished();
}

}  // namespace

TEST_CASE("two links: the passes give the fractions by hand, in any axes of the file") {
  Random random(3);
  std::vector<Matrix3> axes{Matrix3::Identity(),
                            (Matrix3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
                            Vector3(1, -1, -1).asDiagonal()};
  for (int k = 0; k < 5; ++k) axes.push_back(random.rotation());
  for (const Matrix3& R : axes) {
    const Model<double> model = arm(R);
    const Inspection in = at_the_state(model);
    const std::vector<std::map<std::string, Eigen::MatrixXd>> of{{}, all_of(in, 1), all_of(in, 2)};
    const auto check = [&](std::size_t body, const char* name, const Plane& wanted) {
      CAPTURE(body);
      CAPTURE(name);
      CHECK((of[body].at(name) - turned(R, wanted)).norm() < 1e-13 * 40);
    };
    const auto number = [&](std::size_t body, const char* name, double wanted) {
      CAPTURE(name);
      CHECK(std::abs(of[body].at(name)(0, 0) - wanted) < 1e-13 * 40);
    };
    check(1, "S", {1, 0, 0}), check(2, "S", {1, 0, 0});
    check(1, "v", {1, 0, 0}), check(2, "v", {3, 1, 0});
    check(1, "c", {0, 0, 0}), check(2, "c", {0, 0, -2});
    check(1, "p", {0, -1, 0}), check(2, "p", {4.5, -13.5, 9});
    check(2, "pA", {4.5, -13.5, 9}), check(1, "pA", {-14.5, -0.25, -13.5});
    check(2, "pa", {-1, -13.5, -0.75});
    check(2, "U", {1, 0, 1.5}), check(1, "U", {11.0 / 3, 0, 4});
    number(2, "D", 1), number(1, "D", 11.0 / 3);
    number(2, "u", -5.5), number(1, "u", 19.5);
    number(2, "tau", -1), number(1, "tau", 5);
    number(1, "qdd", -123.0 / 22), number(2, "qdd", 34.0 / 11);
    check(1, "a", {-123.0 / 22, 0, 10}), check(2, "a", {-2.5, 97.0 / 22, -2});
    // Planar part of the inertias: columns of unit motions.
    const Eigen::MatrixXd &IA = of[1].at("IA"), &Ia = of[2].at("Ia");
    const auto column = [&](const Eigen::MatrixXd& m, const Plane& motion, const Plane& wanted) {
      CHECK((m * turned(R, motion) - turned(R, wanted)).norm() < 1e-13 * 10);
    };
    column(IA, {1, 0, 0}, {11.0 / 3, 0, 4});
    column(IA, {0, 1, 0}, {0, 2.75, 0});
    column(IA, {0, 0, 1}, {4, 0, 5});
    column(Ia, {1, 0, 0}, {0, 0, 0});
    column(Ia, {0, 1, 0}, {0, 3, 0});
    column(Ia, {0, 0, 1}, {0, 0, 0.75});
    CHECK(of[1].count("Ia") == 0);  // not computed for children of the base
  }
}

TEST_CASE("free-body diagram of a hanging arm: each joint carries the weight below it") {
  const Model<double> model = arm(Matrix3::Identity());
  State<double> x(model);
  x.q = {-std::numbers::pi / 2, 0};
  const Inspection in(model, x, {});
  const BodyBalance lower = balance_of(in, 2), upper = balance_of(in, 1);
  const auto find = [](const BodyBalance& balance, const std::string& source) {
    for (const NamedWrench& wrench : balance.wrenches)
      if (wrench.source == source) return wrench;
    FAIL("no wrench " << source);
    return NamedWrench{};
  };
  CHECK((find(lower, "joint/elbow").force - Vector3(0, 30, 0)).norm() < 1e-12);
  CHECK((find(upper, "joint/shoulder").force - Vector3(0, 50, 0)).norm() < 1e-12);
  CHECK((find(upper, "child/lower").force - Vector3(0, -30, 0)).norm() < 1e-12);
  CHECK((find(upper, "gravity").force - Vector3(0, -20, 0)).norm() < 1e-12);
  CHECK(find(upper, "inertia").force.norm() < 1e-12);
  CHECK(upper.residual < 1e-14);
  CHECK(lower.residual < 1e-14);
}
