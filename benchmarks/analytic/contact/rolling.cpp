// Rolling: sphere, disc and hoop on an incline of 20 degrees (E4); in a bowl, in a trough, on a
// turntable and in an upright tube (E12).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/contact/contact_cases.h"
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::contact_cases {
namespace {

constexpr double kRadius = 0.1;
constexpr double kRollerIncline = 20 * kDegree;
const Matrix3 kAxisAlongY = turn_about(Vector3::UnitX(), std::numbers::pi / 2);

// Inertia over m R^2, acceleration where it rolls, least friction for that.
struct Roller {
  double inertia, acceleration, least_friction;
};
constexpr Roller kSphere{0.4, 2.396584004303436, 0.1039914955046292};
constexpr Roller kDisc{0.5, 2.236811737349874, 0.1213234114220675};
constexpr Roller kHoop{1.0, 1.677608803012405, 0.1819851171331012};
constexpr std::array kRollers{kSphere, kDisc, kHoop};

struct AfterASecond {
  double v, rim, friction;  // after a second: speed, R times spin, friction force
  double drift;             // of the energy until then
};
AfterASecond roll(const Roller& roller, double mu, double gravity = 1, double radius = kRadius,
                  double incline = kRollerIncline) {
  ContactScene scene(gravity * tilted_gravity(incline));
  scene.add_floor(surface(mu));
  ContactScene::Body body{Sphere{radius}, surface(mu), 1, {0, 0, radius}};
  body.inertia = roller.inertia * radius * radius * Matrix3::Identity();
  if (roller.inertia != kSphere.inertia) body.shape = Cylinder{radius, 0.1}, body.R = kAxisAlongY;
  const int number = scene.add(body);
  scene.start();
  scene.run(1, kStep);
  return {scene.v(number).x(), radius * scene.w(number).y(), -scene.force(number).x(),
          scene.drift()};
}

CaseResult rolling_speeds(double off) {  // gravity
  double error = 0, drift = 0;
  for (const Roller& roller : kRollers) {
    const AfterASecond end = roll(roller, 0.5, off);
    drift = std::max(drift, end.drift);
    error = std::max(
        {error, relative(end.v, roller.acceleration), relative(end.rim, roller.acceleration)});
  }
  return {error, drift};
}
CaseResult rolling_friction(double off) {  // gravity
  return {relative(roll(kSphere, 0.5, off).friction, 0.9586336017213744)};
}
CaseResult least_friction(double off) {  // mu
  double error = 0;
  for (const Roller& roller : kRollers) {
    const double limit = threshold(0.05, 0.25, 1e-5, [&](double mu) {
      const AfterASecond end = roll(roller, off * mu);
      return end.v - end.rim < 1e-6;
    });
    error = std::max(error, std::abs(limit - roller.least_friction));
  }
  return {error};
}
CaseResult slipping(double off) {  // mu
  const AfterASecond end = roll(kSphere, off * 0.05);
  return {std::max(relative(end.v, 2.894298375529322), relative(end.rim, 1.15229807623872))};
}
CaseResult small_sphere(double off) {  // gravity
  return {std::abs(roll(kSphere, 0.5, off, 0.05, 15 * kDegree).v - 1.813582023182663)};
}

// Angular frequency of small swings, from the times at which `reading` passes zero; 0.02 rad wide.
template <class Reading>
double frequency(ContactScene& scene, double duration, Reading&& reading) {
  double before = reading(), first = 0, last = 0;
  int passes = 0;
  while (scene.t() < duration) {
    const double t = scene.t();
    scene.step(kStep);
    const double now = reading();
    if (before * now < 0) {
      last = scene.t() - (scene.t() - t) * now / (now - before);
      if (passes++ == 0) first = last;
    }
    before = now;
  }
  return (passes - 1) * std::numbers::pi / (last - first);
}

CaseResult bowl(const Shape& hollow, const Shape& shape, double reference, double gravity) {
  constexpr double kAngle = 0.02, kArm = 1 - kRadius;
  const Matrix3 R =
      std::holds_alternative<HollowCylinder>(hollow) ? kAxisAlongY : Matrix3(Matrix3::Identity());
  ContactScene scene(gravity);
  scene.add_fixed(hollow, surface(1), {R, Vector3::Zero()});
  const int body = scene.add(
      {shape, surface(1), 1, {kArm * std::sin(kAngle), 0, -kArm * std::cos(kAngle)}, {}, {}, R});
  scene.start();
  const double found = frequency(scene, 12, [&] { return scene.p(body).x(); });
  return {relative(found, reference), scene.drift()};
}
CaseResult sphere_in_bowl(double off) {  // gravity
  return bowl(HollowSphere{1}, Sphere{kRadius}, 2.79028928352, off);
}
CaseResult sphere_in_trough(double off) {  // gravity
  return bowl(HollowCylinder{1, 1}, Sphere{kRadius}, 2.79028928352, off);
}
CaseResult cylinder_in_trough(double off) {  // gravity
  return bowl(HollowCylinder{1, 1}, Cylinder{kRadius, 0.3}, 2.69567554922, off);
}

// Starts with the table's own velocity there, W x r_0, and without spin. From v' = (2/7) W x v the
// centre circles at 2/7 of the table's rate, about r_0 - (7/2) r_0.
struct Circle {
  double period, astray;  // [s], [of the radius]
};
// The table may turn at a rate that is off.
Circle turntable(double h, double off, Steps steps = Steps::fixed) {
  constexpr double W = 2, kStart = 0.2;
  ContactScene scene;
  scene.add_turning(Cylinder{3, 0.2}, surface(1), {Matrix3::Identity(), {0, 0, -0.1}}, off * W);
  ContactScene::Body ball{Sphere{kRadius}, surface(1), 1, {kStart, 0, kRadius}};
  ball.v = {0, W * kStart, 0};
  const int body = scene.add(ball);
  scene.start();
  if (steps == Steps::located) scene.locate_events();
  double turned = 0, error = 0;
  Vector3 last = ball.v;
  while (turned < 2 * std::numbers::pi && scene.t() < 15) {
    scene.step(h);
    const Vector3 v = scene.v(body);
    turned += std::atan2(last.x() * v.y() - last.y() * v.x(), last.x() * v.x() + last.y() * v.y());
    last = v;
    const double angle = 2 / 7.0 * W * scene.t();
    const Vector3 wanted(kStart * (3.5 * std::cos(angle) - 2.5), kStart * 3.5 * std::sin(angle),
                         kRadius);
    error = std::max(error, (scene.p(body) - wanted).norm() / (3.5 * kStart));
  }
  return {scene.t() * 2 * std::numbers::pi / turned, error};
}
CaseResult turntable_period(double off) {  // the table's rate
  return with_order(
      [off](double h) { return relative(turntable(h, off).period, 3.5 * std::numbers::pi); },
      kStep);
}
CaseResult turntable_circle(double off) {  // the table's rate
  return {turntable(0.01, off, Steps::located).astray};
}

// Rolls round in an upright tube, fast enough not to slip: it does not sink but goes up and down at
// sqrt(2/7) of the rate at which it goes round. Steps of fixed size lose a fifth of that rate in
// 6 s; so events are located.
CaseResult upright_tube(double off) {  // inertia
  constexpr double kArm = 0.5 - kRadius, kRate = 12;
  ContactScene scene;
  scene.add_fixed(HollowCylinder{0.5, 4}, surface(2));
  ContactScene::Body ball{Sphere{kRadius}, surface(2), 1, {kArm, 0, 0}};
  ball.inertia = off * 0.4 * kRadius * kRadius * Matrix3::Identity();
  ball.v = {0, kArm * kRate, 0};
  ball.w = {0, 0, -kArm * kRate / kRadius};
  const int body = scene.add(ball);
  scene.start();
  scene.locate_events();
  // How far it goes round from one level place to the next.
  double turned = 0, before = scene.v(body).z(), first = 0, last = 0;
  Vector3 p = scene.p(body);
  int passes = 0;
  while (scene.t() < 3) {
    scene.step(kStep);
    const Vector3 now = scene.p(body);
    const double turn =
        std::atan2(p.x() * now.y() - p.y() * now.x(), p.x() * now.x() + p.y() * now.y());
    const double rise = scene.v(body).z();
    turned += turn;
    if (before * rise < 0) {
      last = turned - turn * rise / (rise - before);
      if (passes++ == 0) first = last;
    }
    before = rise, p = now;
  }
  const double found = (passes - 1) * std::numbers::pi / (last - first);
  return {relative(found, std::sqrt(2 / 7.0)), scene.drift()};
}

}  // namespace

std::vector<AnalyticCase> rolling() {
  return {
      contact_case<rolling_speeds, 2>(
          "E4-speeds", "sphere, disc, hoop on 20 degrees: 5/7, 2/3, 1/2 g sin [relative]", 1e-3),
      contact_case<rolling_friction, 2>(
          "E4-friction", "friction on the rolling sphere: 0.95863 N [relative]", 1e-3),
      contact_case<least_friction, 10>(
          "E4-threshold", "least mu that lets sphere, disc, hoop roll: 2/7, 1/3, 1/2 tan", 1e-3),
      contact_case<slipping, 2>(
          "E4-slip", "mu = 0.05: speed and spin of the sphere after 1 s [relative]", 1e-3),
      contact_case<small_sphere, 1>("E4-small", "R = 0.05 m on 15 degrees: speed after 1 s [m/s]",
                                    5.5e-4),
  };
}

std::vector<AnalyticCase> hollows() {
  return {
      contact_case<sphere_in_bowl, 5>("E12-bowl",
                                      "sphere in a bowl: sqrt(5 g/(7 (R - r))) [relative]", 1e-3),
      contact_case<sphere_in_trough, 5>(
          "E12-trough", "sphere in a trough: sqrt(5 g/(7 (R - r))) [relative]", 1e-3),
      contact_case<cylinder_in_trough, 5>(
          "E12-cylinder", "cylinder in a trough: sqrt(2 g/(3 (R - r))) [relative]", 1e-3),
      contact_case<turntable_period, 2>(
          "E12-turntable", "ball on a turntable: its circle takes 7/2 turns [relative]", 1e-3),
      contact_case<turntable_circle, 1>(
          "E12-circle", "ball on a turntable, events located: place on its circle [of R]", 1e-9),
      contact_case<upright_tube, 10>(
          "E12-tube",
          "ball in an upright tube, events located: up and down at sqrt(2/7) [relative]", 1e-9),
  };
}

}  // namespace twinarm::contact_cases
