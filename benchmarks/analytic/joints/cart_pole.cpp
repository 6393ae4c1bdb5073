// C6, C10: a cart of mass M on a horizontal line, with or without a spring k, and a pole of mass m,
// centre at l from the hinge, J about the hinge, th from hanging (Lagrange):
//   (M + m) x'' + m l cos th th'' - m l sin th th'^2 + k x = 0,
//   m l cos th x'' + J th'' + m g l sin th = 0.
// About th = 0 and pi, k = 0:  w^2 = +- m g l / (J - m^2 l^2 / (M + m)).
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

struct CartPole {
  double cart = 1, pole = 0.3, com = 0.5;
  double inertia = 0.3 / 12;  // about the centre of mass
  double spring = 0, gravity = kGravity;

  double about_hinge() const { return inertia + pole * com * com; }
  CaseScene scene(double angle) const {
    ModelBuilder builder;
    builder.set_gravity({0, 0, -gravity});
    builder.add_body("cart", 0, "slide", JointType::prismatic, {}, Vector3::UnitX(),
                     {cart, Vector3::Zero(), Matrix3::Identity()});
    builder.add_body("pole", 1, "hinge", JointType::revolute, {}, -Vector3::UnitY(),
                     {pole, {0, 0, -com}, Vector3(inertia, inertia, 0).asDiagonal()});
    CaseScene all = start_at(builder.build(), {0, angle}, {0, 0});
    if (spring > 0) {
      const double k = spring;
      all.sources = {joint_effort([k](double, double x) { return -k * x; })};
      all.stored = [k](const State<double>& x) { return k * x.q[0] * x.q[0] / 2; };
    }
    return all;
  }
  std::function<CaseReadings(double)> motion(double angle) const {
    const Real both = Real(cart) + pole;
    const Real ml = Real(pole) * com, k = spring, g = gravity;
    const Real J = ml * com + inertia;
    return solution_of(
        [=](Real, const special::Numbers& x, special::Numbers& dx) {
          const Real c = std::cos(x[1]), s = std::sin(x[1]);
          const special::Two a =
              special::solve_two(both, ml * c, J, {ml * s * x[3] * x[3] - k * x[0], -ml * g * s});
          dx = {x[2], x[3], a.first, a.second};
        },
        {0, angle, 0, 0});
  }
  // Frequency about hanging, and growth rate about upright [rad/s].
  double frequency() const {
    const double ml = pole * com;
    return std::sqrt(ml * gravity / (about_hinge() - ml * ml / (cart + pole)));
  }
};

const CartPole kPlain{};
const CartPole kPoint{1, 0.3, 0.5, 0, 0, kGravity};
// Project Chrono's: centre at 0.5 m, on a spring, g = 10 m/s^2.
const CartPole kChrono{1, 1, 0.5, 1, 10, 10};

TrajectoryCase cart_pole_motion() {
  return {.scene = [] { return kPlain.scene(2); },
          .times = {1, 2, 5},
          .readings = {"x [m]", "angle [rad]", "speed [m/s]", "rate [rad/s]"},
          .observe = joint_state(),
          .reference = kPlain.motion(2)};
}
// No force acts along x: the x of the centre of mass is constant.
TrajectoryCase cart_pole_centre() {
  TrajectoryCase c = cart_pole_motion();
  c.times = {0.5, 1, 1.5, 2, 3, 4, 5};
  c.readings = {"x of the centre [m]"};
  c.observe = [](ModelRef model, StateRef x) {
    const Kinematics k = kinematics_at(model, x);
    const double cart = model.I[1].m, pole = model.I[2].m;
    const double at = k.position(2, {0, 0, -kPlain.com}).x();
    return values((cart * x.q[0] + pole * at) / (cart + pole));
  };
  c.reference =
      constantly({kPlain.pole * kPlain.com * std::sin(2.0) / (kPlain.cart + kPlain.pole)});
  c.integration = dopri5_with(1e-13);
  // A force on the cart.
  c.mutant = [](CaseScene& scene) {
    scene.sources = {joint_effort([](double, double) { return 1e-9; })};
  };
  return c;
}

// About hanging and about upright; of a rod, and of a point mass at its centre.
TrajectoryCase cart_pole_frequencies() {
  return evaluation(
      kPlain.scene(0), {"swinging [rad/s]", "falling [rad/s]", "point mass [rad/s]"},
      [](ModelRef model, StateRef x) {
        State<double> above = x;
        above.q[1] = std::numbers::pi;
        CaseScene point = kPoint.scene(0);
        point.model.gravity = model.gravity;
        return values(std::sqrt(squared_frequencies_of(model, x).back()),
                      std::sqrt(-squared_frequencies_of(model, above).front()),
                      std::sqrt(squared_frequencies_of(point.model, point.start).back()));
      },
      {kPlain.frequency(), kPlain.frequency(), kPoint.frequency()}, relative_each);
}

TrajectoryCase chrono_slider() {
  return {.scene = [] { return kChrono.scene(std::numbers::pi / 2); },
          .times = {1, 2, 5},
          .readings = {"x [m]", "angle from level [rad]", "speed [m/s]", "rate [rad/s]"},
          .observe =
              [](ModelRef, StateRef x) {
                return values(x.q[0], x.q[1] - std::numbers::pi / 2, x.qd[0], x.qd[1]);
              },
          .reference =
              [](double t) {
                CaseReadings x = kChrono.motion(std::numbers::pi / 2)(t);
                x[1] -= std::numbers::pi / 2;
                return x;
              }};
}

}  // namespace

CaseFamily cart_pole_cases() {
  return {130,
          {{"C6", 1e-8, cart_pole_motion()},
           {"C6-centre", 1e-12, cart_pole_centre()},
           {"C6-frequencies", 1e-12, cart_pole_frequencies()},
           {"C10-slider", 1e-8, chrono_slider()}}};
}

}  // namespace twinarm
