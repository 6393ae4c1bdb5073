// E5: billiard ball that slides until it rolls.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

// Billiards: R = 0.0286 m, mu = 0.2, 2 m/s, without and with top spin (R w = 4 m/s).
struct Roll {
  double time = 0, x = 0, v = 0, rim = 0, loss = 0;
};
Roll billiard(double rim, double mu, double inertia = 1) {
  constexpr double R = 0.0286;
  ContactScene scene;
  ContactScene::Body body{Sphere{R}, surface(mu), 0.17, {0, 0, R}, {2, 0, 0}, {0, rim / R, 0}};
  body.inertia = inertia * 0.4 * 0.17 * R * R * Matrix3::Identity();
  const int ball = scene.start_on_floor(body);
  const double before = scene.energy() - 0.17 * kGravity * R;
  Roll roll;
  while (scene.t() < 1) {
    scene.step(kStep);
    const double slip = scene.v(ball).x() - R * scene.w(ball).y();
    if (roll.time == 0 && std::abs(slip) < 1e-9) roll.time = scene.t(), roll.x = scene.p(ball).x();
  }
  roll.v = scene.v(ball).x();
  roll.rim = R * scene.w(ball).y();
  roll.loss = 1 - (scene.energy() - 0.17 * kGravity * R) / before;
  return roll;
}
CaseResult billiard_time(double scale) {  // mu
  const Roll roll = billiard(0, scale * 0.2);
  return {std::max(std::abs(roll.time - 0.291247997670016),
                   std::abs(roll.x - 0.4992822817200275) / roll.v)};
}
CaseResult billiard_speed(double scale) {  // inertia
  const Roll roll = billiard(0, 0.2, scale), top = billiard(4, 0.2, scale);
  return {std::max({relative(roll.v, 10 / 7.0), relative(roll.rim, 10 / 7.0),
                    relative(roll.loss, 2 / 7.0), relative(top.v, 18 / 7.0)})};
}

// ---- plots ----

// Without and with top spin: the final speed is 5/7 v + 2/7 R w.
double exact_centre(std::size_t run, double t) {
  const double change = 0.2 * kGravity * t;
  return run == 0 ? std::max(2 - change, 10 / 7.0) : std::min(2 + change, 18 / 7.0);
}
double exact_billiard(std::size_t k, double t) {
  return k == 0 ? exact_centre(0, t) : std::min(2.5 * 0.2 * kGravity * t, 10 / 7.0);
}

}  // namespace

CaseFamily billiards_cases() {
  return {
      220,
      {contact_case<billiard_time, 10>(
           "E5-time", kStep,
           Plot{{"v of the centre [m/s]", "R ω [m/s]"}, speed_and_rim<286>, exact_billiard}.with(
               &Plot::convergence_note, kPartOfStep)),
       contact_case<billiard_speed, 10>(
           "E5-speed", 1e-3,
           {{"v of the centre [m/s]"}, velocity<1, 0>, exact_centre, {"no spin", "top spin"}})}};
}

}  // namespace twinarm
