// E4: sphere, disc and hoop roll on an incline of 20 degrees.
#include <array>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kRollerIncline = 20 * kDegree;

// Inertia over m R^2, acceleration while rolling, friction coefficient that rolling requires.
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
  ContactScene::Body body{Sphere{radius}, surface(mu), 1, {0, 0, radius}};
  body.inertia = roller.inertia * radius * radius * Matrix3::Identity();
  if (roller.inertia != kSphere.inertia)
    body.shape = Cylinder{radius, 0.1}, body.R = axis_along_y();
  const int number = scene.start_on_floor(body);
  scene.run(1, kStep);
  return {scene.v(number).x(), radius * scene.w(number).y(), -scene.force(number).x(),
          scene.drift()};
}

CaseResult rolling_speeds(double scale) {  // gravity
  double error = 0, drift = 0;
  for (const Roller& roller : kRollers) {
    const AfterASecond end = roll(roller, 0.5, scale);
    drift = std::max(drift, end.drift);
    error = std::max(
        {error, relative(end.v, roller.acceleration), relative(end.rim, roller.acceleration)});
  }
  return {error, drift};
}
CaseResult rolling_friction(double scale) {  // gravity
  return {relative(roll(kSphere, 0.5, scale).friction, 0.9586336017213744)};
}
CaseResult min_friction(double scale) {  // mu
  return {max_over(kRollers, [scale](const Roller& roller) {
    const double limit = threshold(0.05, 0.25, 1e-5, [&](double mu) {
      const AfterASecond end = roll(roller, scale * mu);
      return end.v - end.rim < 1e-6;
    });
    return std::abs(limit - roller.min_friction);
  })};
}
CaseResult slipping(double scale) {  // mu
  const AfterASecond end = roll(kSphere, scale * 0.05);
  return {std::max(relative(end.v, 2.894298375529322), relative(end.rim, 1.15229807623872))};
}
CaseResult small_sphere(double scale) {  // gravity
  return {std::abs(roll(kSphere, 0.5, scale, 0.05, 15 * kDegree).v - 1.813582023182663)};
}

// ---- plots ----

double exact_rolling(std::size_t run, double t) {
  return kGravity * std::sin(kRollerIncline) / (1 + kRollers[run].inertia) * t;
}
double exact_slipping(std::size_t k, double t) {
  const double friction = 0.05 * std::cos(kRollerIncline);
  return kGravity * t * (k == 0 ? std::sin(kRollerIncline) - friction : 2.5 * friction);
}

}  // namespace

CaseFamily rolling_cases() {
  const Plot speed{{"speed [m/s]"}, velocity<1, 0>, exact_rolling};
  const auto read_friction = [](Scene s) { return Values{s.t() == 0 ? NAN : -s.force(1).x()}; };
  const auto exact_friction = [](std::size_t, double) { return 0.9586336017213744; };
  const auto exact_small = [](std::size_t, double t) {
    return 5 / 7. * kGravity * std::sin(15 * kDegree) * t;
  };
  return {
      240,
      {contact_case<rolling_speeds, 2>("E4-speeds", 1e-3,
                                       speed.of_runs({"sphere", "disc", "hoop"})),
       contact_case<rolling_friction, 2>("E4-friction", 1e-3,
                                         {{"friction [N]"}, read_friction, exact_friction}),
       contact_case<min_friction, 10>("E4-threshold", 1e-3,
                                      Plot{{"slip [m/s]"}, slip}.searching("μ")),
       contact_case<slipping, 2>(
           "E4-slip", 1e-3,
           {{"v of the centre [m/s]", "R ω [m/s]"}, speed_and_rim<1000>, exact_slipping}),
       contact_case<small_sphere, 1>("E4-small", 5.5e-4, speed.with(&Plot::exact, exact_small))}};
}

}  // namespace twinarm
