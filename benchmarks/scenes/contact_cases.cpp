// Scenes with contacts and closed forms (docs/reference/verification_cases.md, group E): free balls
// and boxes on a floor.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "benchmarks/scenes/scene.h"
#include "solver/linear_algebra/nan_max.h"

namespace twinarm::bench {
namespace {

constexpr double kRadius = 0.1;
using Values = std::vector<double>;

Scene with(Scene scene, const Body& body, const Vector3d& p, const Vector3d& v = Vector3d::Zero()) {
  add_free_body(scene, body, p, v);
  return scene;
}
Scene floored(double friction, double restitution = 0) {
  Scene scene;
  scene.floor = true;
  scene.floor_friction = scene.friction = friction, scene.restitution = restitution;
  return scene;
}
Scene inclined(double degrees, double friction) {  // x points downhill
  Scene scene = floored(friction);
  const double a = degrees * std::numbers::pi / 180;
  scene.gravity = {standard_gravity * std::sin(a), 0, -standard_gravity * std::cos(a)};
  return scene;
}

// The error at the end of the run.
template <class Error>
std::function<Judge()> at_the_end(Error error) {
  return [error] {
    return [error](double, const Values& q, const Values& v) { return std::abs(error(q, v)); };
  };
}
// Angular velocity of body 0 in world axes.
Vector3d turning(const Values& q, const Values& v) {
  const Vector3d u(&q[4]), w(v.data()), t = u.cross(w);
  return w + 2 * (q[3] * t + u.cross(t));
}

SceneCase contact_case(const std::string& name, const std::string& what, const std::string& unit,
                       Scene scene, double duration, std::function<Judge()> judge) {
  SceneCase c{name, "contact", what, unit, std::move(scene)};
  c.duration = duration, c.judge = std::move(judge);
  return c;
}

SceneCase bouncing_ball() {
  const auto judge = [] {
    std::vector<double> tops;
    double last = 1, before = 1;
    return [=](double, const Values& q, const Values&) mutable {
      const double z = q[2] - kRadius;
      if (last > before && last >= z && last > 1e-3) tops.push_back(last);
      before = last, last = z;
      double worst = 0;
      for (std::size_t n = 0; n < 3; ++n) {
        const double exact = std::pow(0.64, static_cast<double>(n + 1));
        worst = std::max(worst, n < tops.size() ? std::abs(tops[n] - exact) : exact);
      }
      return worst;
    };
  };
  return contact_case("E1", "ball from 1 m, e = 0.8: heights of three bounces", "m",
                      with(floored(0, 0.8), solid_ball(1, kRadius), {0, 0, 1 + kRadius}), 2.2,
                      judge);
}

SceneCase block(const std::string& name, const std::string& what, double friction, double duration,
                double exact) {
  return contact_case(name, what, "m",
                      with(inclined(30, friction), solid_cube(2, 0.2), {0, 0, 0.1}), duration,
                      at_the_end([exact](const Values& q, const Values&) {
                        return std::hypot(q[0] - exact, q[1]);
                      }));
}

SceneCase heading(int degrees) {
  const std::string angle = std::to_string(degrees);
  const double a = degrees * std::numbers::pi / 180, far = 9 / (2 * 0.4 * standard_gravity);
  return contact_case(
      "E2-" + angle, "block launched at 3 m/s, heading " + angle + " degrees, mu = 0.4", "m",
      with(floored(0.4), solid_cube(2, 0.2), {0, 0, 0.1}, {3 * std::cos(a), 3 * std::sin(a), 0}), 1,
      at_the_end([a, far](const Values& q, const Values&) {
        return std::hypot(q[0] - far * std::cos(a), q[1] - far * std::sin(a));
      }));
}

// A ball on the floor: speed along x, and the surface speed R w.
std::function<Judge()> speed_and_spin(double radius, double v_x, double spin) {
  return at_the_end([=](const Values& q, const Values& v) {
    return std::hypot(v[3] - v_x, radius * turning(q, v)[1] - spin);
  });
}

SceneCase sphere_downhill(const std::string& name, const std::string& what, double friction,
                          std::function<Judge()> judge) {
  return contact_case(name, what, "m/s",
                      with(inclined(20, friction), solid_ball(1, kRadius), {0, 0, kRadius}), 1,
                      std::move(judge));
}

// Rolls at (5 v + 2 R w)/7 of the initial values.
SceneCase billiard(const std::string& name, const std::string& what, double top_spin) {
  constexpr double kBilliard = 0.0286, kSpeed = 2;
  Scene scene = with(floored(0.2), solid_ball(0.17, kBilliard), {0, 0, kBilliard}, {kSpeed, 0, 0});
  scene.v[1] = top_spin / kBilliard;
  const double rolls = (5 * kSpeed + 2 * top_spin) / 7;
  return contact_case(name, what, "m/s", scene, 0.5, speed_and_spin(kBilliard, rolls, rolls));
}

// Balls in a row along x without gravity, the first with a velocity; final velocities.
SceneCase in_a_row(const std::string& name, const std::string& what, double restitution,
                   const Values& masses, double speed, const Values& exact) {
  constexpr double kGap = 0.01;
  Scene scene = floored(0, restitution);
  scene.gravity.setZero();
  for (std::size_t i = 0; i < masses.size(); ++i)
    add_free_body(scene, solid_ball(masses[i], kRadius),
                  {(2 * kRadius + kGap) * static_cast<double>(i), 0, 1},
                  {i == 0 ? speed : 0, 0, 0});
  return contact_case(
      name, what, "m/s", scene, 0.2, at_the_end([exact](const Values&, const Values& v) {
        double worst = 0;
        for (std::size_t i = 0; i < exact.size(); ++i)
          worst = nan_max(worst, std::hypot(v[6 * i + 3] - exact[i], v[6 * i + 4], v[6 * i + 5]));
        return worst;
      }));
}

SceneCase stack() {
  Scene scene = floored(0.5);
  for (int i = 0; i < 10; ++i)
    add_free_body(scene, solid_cube(1, 0.2),
                  {0.01 * std::sin(3 * i), 0.01 * std::cos(2 * i), (i + 0.5) * 0.2});
  const auto judge = [start = scene.q] {
    double worst = 0;
    return [=](double, const Values& q, const Values&) mutable {
      for (std::size_t i = 0; i < q.size(); i += 7)
        worst = std::max(
            worst, std::hypot(q[i] - start[i], q[i + 1] - start[i + 1], q[i + 2] - start[i + 2]));
      return worst;
    };
  };
  return contact_case("E11", "ten boxes stand for 10 s: the farthest that one moves", "m", scene,
                      10, judge);
}

SceneCase oblique(const std::string& name, const std::string& what, double friction, double v_x,
                  double spin) {
  Scene scene =
      with(floored(friction, 0.8), solid_ball(1, kRadius), {0, 0, kRadius + 0.1}, {2, 0, -3});
  scene.gravity.setZero();
  return contact_case(
      name, what, "m/s", scene, 0.1, at_the_end([=](const Values& q, const Values& v) {
        return std::hypot(v[3] - v_x, v[5] - 2.4, kRadius * turning(q, v)[1] - spin);
      }));
}

}  // namespace

std::vector<SceneCase> contact_cases() {
  return {
      bouncing_ball(),
      block("E2-slide", "block on 30 degrees, mu = 0.5, slides 1 s", 0.5, 1, 0.3285726972186642),
      block("E2-creep", "block on 30 degrees, mu = 0.6, holds 10 s", 0.6, 10, 0),
      heading(0),
      heading(45),
      sphere_downhill(
          "E4", "sphere rolls down 20 degrees, mu = 0.5: its speed after 1 s", 0.5,
          at_the_end([](const Values&, const Values& v) { return v[3] - 2.396584004303436; })),
      sphere_downhill("E4-slip", "sphere slips down 20 degrees, mu = 0.05: v, R w after 1 s", 0.05,
                      speed_and_spin(kRadius, 2.894298375529322, 1.15229807623872)),
      billiard("E5", "billiard ball at 2 m/s, mu = 0.2: speed and R w when it rolls", 0),
      billiard("E5-top", "billiard ball at 2 m/s with top spin of 4 m/s, mu = 0.2", 4),
      in_a_row("E6-two", "1 kg at 2 m/s hits 3 kg, e = 0.6: speeds", 0.6, {1, 3}, 2, {-0.4, 0.8}),
      in_a_row("E6-cradle", "five balls with gaps, e = 1: the last one leaves", 1, {1, 1, 1, 1, 1},
               1, {0, 0, 0, 0, 1}),
      stack(),
      oblique("E16", "sphere hits the floor at (2, -3) m/s, e = 0.8, mu = 0.2: v, R w", 0.2,
              10 / 7.0, 10 / 7.0),
      oblique("E16-slip", "sphere hits the floor at (2, -3) m/s, e = 0.8, mu = 0.05: it slips",
              0.05, 1.73, 0.675)};
}

}  // namespace twinarm::bench
