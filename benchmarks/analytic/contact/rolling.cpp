// Rolling: sphere, disc and hoop on an incline of 20 degrees (E4).
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kRollerIncline = 20 * kDegree;

// Inertia over m R^2, acceleration where it rolls, least friction for that.
struct Roller {
  double inertia, acceleration, min_friction;
};
constexpr Roller kSphere{0.4, 2.396584004303436, 0.1039914955046292};
constexpr Roller kDisc{0.5, 2.236811737349874, 0.1213234114220675};
constexpr Roller kHoop{1.0, 1.677608803012405, 0.1819851171331012};
constexpr std::array kRollers{kSphere, kDisc, kHoop};

struct AfterASecond {
  double v, rim, friction;  // after a second: speed, R times spin, friction force
  double drift;             // of the energy until then
};
AfterASecond roll(const Roller& roller, double mu, double gravity = 1, double radius = kBallRadius,
                  double incline = kRollerIncline) {
  ContactScene scene(gravity * tilted_gravity(incline));
  scene.add_floor(surface(mu));
  ContactScene::Body body{Sphere{radius}, surface(mu), 1, {0, 0, radius}};
  body.inertia = roller.inertia * radius * radius * Matrix3::Identity();
  if (roller.inertia != kSphere.inertia)
    body.shape = Cylinder{radius, 0.1}, body.R = axis_along_y();
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
CaseResult min_friction(double off) {  // mu
  double error = 0;
  for (const Roller& roller : kRollers) {
    const double limit = threshold(0.05, 0.25, 1e-5, [&](double mu) {
      const AfterASecond end = roll(roller, off * mu);
      return end.v - end.rim < 1e-6;
    });
    error = std::max(error, std::abs(limit - roller.min_friction));
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

// ---- what a page draws of them ----

Values seen_slip(Scene s) {
  return {s.v(1).x() - 0.1 * s.w(1).y()};
}
Values seen_friction(Scene s) {
  return {s.t() == 0 ? NAN : -s.force(1).x()};
}
double known_rolling(std::size_t run, double t) {
  constexpr double kInertia[] = {0.4, 0.5, 1};
  return kGravity * std::sin(kRollerIncline) / (1 + kInertia[run]) * t;
}
double known_slipping(std::size_t k, double t) {
  const double rub = 0.05 * std::cos(kRollerIncline);
  return kGravity * t * (k == 0 ? std::sin(kRollerIncline) - rub : 2.5 * rub);
}

}  // namespace

CaseFamily rolling_cases() {
  return {
      240,
      {contact_case<rolling_speeds, 2>("E4-speeds", 1e-3,
                                       {.readings = {"speed [m/s]"},
                                        .read = velocity<1, 0>,
                                        .exact = known_rolling,
                                        .runs = {"sphere", "disc", "hoop"}}),
       contact_case<rolling_friction, 2>(
           "E4-friction", 1e-3,
           {.readings = {"friction [N]"},
            .read = seen_friction,
            .exact = [](std::size_t, double) { return 0.9586336017213744; }}),
       contact_case<min_friction, 10>(
           "E4-threshold", 1e-3, searched({.readings = {"slip [m/s]"}, .read = seen_slip}, "μ")),
       contact_case<slipping, 2>("E4-slip", 1e-3,
                                 {.readings = {"v of the centre [m/s]", "R ω [m/s]"},
                                  .read = speed_and_rim<1000>,
                                  .exact = known_slipping}),
       contact_case<small_sphere, 1>("E4-small", 5.5e-4,
                                     {.readings = {"speed [m/s]"},
                                      .read = velocity<1, 0>,
                                      .exact = [](std::size_t, double t) {
                                        return 5 / 7. * kGravity * std::sin(15 * kDegree) * t;
                                      }})}};
}

}  // namespace twinarm
