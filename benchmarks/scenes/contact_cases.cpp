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

Body ball(double mass, double radius) {
  Body b;
  b.mass = mass, b.form = Form::sphere, b.half = {radius, radius, radius};
  const double I = 0.4 * mass * radius * radius;
  b.inertia = {I, I, I, 0, 0, 0};
  return b;
}
Body cube(double mass, double edge) {
  Body b;
  b.mass = mass, b.form = Form::box, b.half = {edge / 2, edge / 2, edge / 2};
  const double I = mass * edge * edge / 6;
  b.inertia = {I, I, I, 0, 0, 0};
  return b;
}
// At rest except for a linear velocity.
void add(Scene& scene, const Body& b, const Numbers3& p, const Numbers3& v = {}) {
  scene.bodies.push_back(b);
  scene.q.insert(scene.q.end(), {p[0], p[1], p[2], 1, 0, 0, 0});
  scene.v.insert(scene.v.end(), {0, 0, 0, v[0], v[1], v[2]});
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
Numbers3 turning(const Values& q, const Values& v) {
  const Numbers3 u{q[4], q[5], q[6]}, w{v[0], v[1], v[2]};
  const auto cross = [](const Numbers3& a, const Numbers3& b) {
    return Numbers3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]};
  };
  const Numbers3 t = cross(u, w), s = cross(u, t);
  Numbers3 out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = w[k] + 2 * (q[3] * t[k] + s[k]);
  return out;
}

SceneCase bouncing_ball() {
  SceneCase c{"E1", "contact", "ball from 1 m, e = 0.8: heights of three bounces", "m",
              floored(0, 0.8)};
  add(c.scene, ball(1, kRadius), {0, 0, 1 + kRadius});
  c.duration = 2.2;
  c.judge = [] {
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
  return c;
}

SceneCase block(const std::string& name, const std::string& what, double friction, double duration,
                double exact) {
  SceneCase c{name, "contact", what, "m", inclined(30, friction)};
  add(c.scene, cube(2, 0.2), {0, 0, 0.1});
  c.duration = duration;
  c.judge = at_the_end(
      [exact](const Values& q, const Values&) { return std::hypot(q[0] - exact, q[1]); });
  return c;
}

SceneCase heading(int degrees) {
  SceneCase c{"E2-" + std::to_string(degrees), "contact",
              "block launched at 3 m/s, heading " + std::to_string(degrees) + " degrees, mu = 0.4",
              "m", floored(0.4)};
  const double a = degrees * std::numbers::pi / 180;
  add(c.scene, cube(2, 0.2), {0, 0, 0.1}, {3 * std::cos(a), 3 * std::sin(a), 0});
  c.duration = 1;
  const double far = 9 / (2 * 0.4 * standard_gravity);
  c.judge = at_the_end([a, far](const Values& q, const Values&) {
    return std::hypot(q[0] - far * std::cos(a), q[1] - far * std::sin(a));
  });
  return c;
}

// A ball on the floor: speed along x, and the surface speed R w.
std::function<Judge()> speed_and_spin(double radius, double v_x, double spin) {
  return at_the_end([=](const Values& q, const Values& v) {
    return std::hypot(v[3] - v_x, radius * turning(q, v)[1] - spin);
  });
}

SceneCase rolling_sphere() {
  SceneCase c{"E4", "contact", "sphere rolls down 20 degrees, mu = 0.5: its speed after 1 s", "m/s",
              inclined(20, 0.5)};
  add(c.scene, ball(1, kRadius), {0, 0, kRadius});
  c.duration = 1;
  c.judge = at_the_end([](const Values&, const Values& v) { return v[3] - 2.396584004303436; });
  return c;
}

SceneCase slipping_sphere() {
  SceneCase c{"E4-slip", "contact", "sphere slips down 20 degrees, mu = 0.05: v, R w after 1 s",
              "m/s", inclined(20, 0.05)};
  add(c.scene, ball(1, kRadius), {0, 0, kRadius});
  c.duration = 1;
  c.judge = speed_and_spin(kRadius, 2.894298375529322, 1.15229807623872);
  return c;
}

// Rolls at (5 v + 2 R w)/7 of the initial values.
SceneCase billiard(const std::string& name, const std::string& what, double top_spin) {
  constexpr double kBilliard = 0.0286, kSpeed = 2;
  SceneCase c{name, "contact", what, "m/s", floored(0.2)};
  add(c.scene, ball(0.17, kBilliard), {0, 0, kBilliard}, {kSpeed, 0, 0});
  c.scene.v[1] = top_spin / kBilliard;
  c.duration = 0.5;
  const double rolls = (5 * kSpeed + 2 * top_spin) / 7;
  c.judge = speed_and_spin(kBilliard, rolls, rolls);
  return c;
}

// Balls in a row along x without gravity, the first with a velocity; final velocities.
SceneCase in_a_row(const std::string& name, const std::string& what, double restitution,
                   const Values& masses, double speed, const Values& exact) {
  constexpr double kGap = 0.01;
  SceneCase c{name, "contact", what, "m/s", floored(0, restitution)};
  c.scene.gravity = {};
  for (std::size_t i = 0; i < masses.size(); ++i)
    add(c.scene, ball(masses[i], kRadius), {(2 * kRadius + kGap) * static_cast<double>(i), 0, 1},
        {i == 0 ? speed : 0, 0, 0});
  c.duration = 0.2;
  c.judge = at_the_end([exact](const Values&, const Values& v) {
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      worst = nan_max(worst, std::hypot(v[6 * i + 3] - exact[i], v[6 * i + 4], v[6 * i + 5]));
    return worst;
  });
  return c;
}

SceneCase stack() {
  SceneCase c{"E11", "contact", "ten boxes stand for 10 s: the farthest that one moves", "m",
              floored(0.5)};
  for (int i = 0; i < 10; ++i)
    add(c.scene, cube(1, 0.2), {0.01 * std::sin(3 * i), 0.01 * std::cos(2 * i), (i + 0.5) * 0.2});
  c.duration = 10;
  c.judge = [start = c.scene.q] {
    double worst = 0;
    return [=](double, const Values& q, const Values&) mutable {
      for (std::size_t i = 0; i < q.size(); i += 7)
        worst = std::max(
            worst, std::hypot(q[i] - start[i], q[i + 1] - start[i + 1], q[i + 2] - start[i + 2]));
      return worst;
    };
  };
  return c;
}

SceneCase oblique(const std::string& name, const std::string& what, double friction, double v_x,
                  double spin) {
  SceneCase c{name, "contact", what, "m/s", floored(friction, 0.8)};
  c.scene.gravity = {};
  add(c.scene, ball(1, kRadius), {0, 0, kRadius + 0.1}, {2, 0, -3});
  c.duration = 0.1;
  c.judge = at_the_end([=](const Values& q, const Values& v) {
    return std::hypot(v[3] - v_x, v[5] - 2.4, kRadius * turning(q, v)[1] - spin);
  });
  return c;
}

}  // namespace

std::vector<SceneCase> contact_cases() {
  return {
      bouncing_ball(),
      block("E2-slide", "block on 30 degrees, mu = 0.5, slides 1 s", 0.5, 1, 0.3285726972186642),
      block("E2-creep", "block on 30 degrees, mu = 0.6, holds 10 s", 0.6, 10, 0),
      heading(0),
      heading(45),
      rolling_sphere(),
      slipping_sphere(),
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
