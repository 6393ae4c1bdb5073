// E1: bouncing ball, by Newton's law of impact.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kZeno = 4.063712768871578;  // t1 (1 + e) / (1 - e)

// Ball 1 m above the floor.
int add_falling_ball(ContactScene& scene, double restitution) {
  scene.add_floor(surface(0, restitution));
  const int ball = scene.start({Sphere{kBallRadius}, surface(0, 1), 1, {0, 0, 1 + kBallRadius}});
  return ball;
}

constexpr std::array kTimes = {0.4515236409857309, 1.1739614665629,   1.751911727024636,
                               2.214271935394024,  2.584160102089535, 2.880070635445944};
constexpr std::array kSpeeds = {4.42944691807002, 3.543557534456016, 2.834846027564813,
                                2.26787682205185, 1.81430145764148};

// Times and speeds of the impacts: free fall from the state before the step in which the velocity
// changes its sign.
struct Bounces {
  double time_error = NAN, speed_error = NAN;
};
Bounces bounce(bool located, double gravity, double e) {
  ContactScene scene(gravity);
  const int ball = add_falling_ball(scene, e);
  if (located) scene.locate_events();
  Bounces errors{0, 0};
  std::size_t impacts = 0;
  while (impacts < kTimes.size() && scene.t() < kZeno) {
    const double t = scene.t(), v = scene.v(ball).z(), gap = scene.p(ball).z() - kBallRadius;
    scene.step(kStep);
    if (v >= 0 || scene.v(ball).z() <= 0) continue;
    const double speed = std::sqrt(v * v + 2 * kGravity * std::max(0.0, gap));
    const double time = t + (speed + v) / kGravity;
    errors.time_error = std::max(errors.time_error, std::abs(time - kTimes[impacts]));
    if (impacts < kSpeeds.size())
      errors.speed_error = std::max(errors.speed_error, relative(speed, kSpeeds[impacts]));
    ++impacts;
  }
  return impacts == kTimes.size() ? errors : Bounces{};
}
CaseResult bounce_times(double scale) {  // gravity
  return {bounce(true, scale, 0.8).time_error};
}
CaseResult bounce_speeds(double scale) {  // gravity
  return {bounce(true, scale, 0.8).speed_error};
}
CaseResult bounce_fixed(double scale) {  // e
  return {bounce(false, 1, scale * 0.8).speed_error};
}

// With located impacts, of which there are infinitely many, and with fixed steps.
CaseResult rest_after_bounces(double scale) {  // e
  double fastest = 0;
  for (const bool located : {false, true}) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, scale * 0.8);
    if (located) scene.locate_events();
    while (scene.t() < 6) {
      scene.step(kStep);
      if (scene.t() > kZeno + kStep) fastest = std::max(fastest, scene.v(ball).norm());
    }
  }
  return {fastest};
}

CaseResult bounce_energy(double scale) {  // weight; energy() uses the correct one
  double rise = 0;
  for (const double e : {0.0, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, e);
    scene.apply_force(ball, {0, 0, (1 - scale) * kGravity});
    scene.run(5, kStep);
    rise = std::max(rise, scene.rise());
  }
  return {rise};
}

// ---- plots ----

Values read_height(Scene s) {
  return {s.p(1).z() - 0.1};
}
double exact_bounce(double e, double t) {
  const double fall = std::sqrt(2 / kGravity);
  if (t < fall) return 1 - kGravity * t * t / 2;
  double speed = e * kGravity * fall, since = t - fall;
  while (speed > 1e-6 && since > 2 * speed / kGravity) since -= 2 * speed / kGravity, speed *= e;
  return speed > 1e-6 ? speed * since - kGravity * since * since / 2 : 0;
}
double exact_bounces(std::size_t, double t) {
  return exact_bounce(0.8, t);
}

}  // namespace

CaseFamily bouncing_cases() {
  const Plot height{{"height of the ball [m]"}, read_height, exact_bounces};
  const Plot conserved = height.without_convergence(kRounding);
  return {
      180,
      {contact_case<bounce_times, 1>("E1-times", 1e-9, height.without_convergence(kLocated)),
       contact_case<bounce_speeds, 1>("E1-speeds", 1e-9, height.without_convergence(kLocated)),
       contact_case<bounce_fixed, 1>(
           "E1-fixed", 1e-3,
           height.with(&Plot::convergence_note,
                       "Flight is exact in any step. One step of 0.5 ms would end 1 µm below the "
                       "floor; it ends on the floor, 0.1 % slower, and the ball bounces in the "
                       "next step.")),
       contact_case<rest_after_bounces, 1>("E1-rest", 1e-6, conserved.of_runs({"located", "1 ms"})),
       contact_case<bounce_energy, 10>("E1-energy", 1e-10,
                                       conserved.with(&Plot::exact, nullptr)
                                           .of_runs({"e = 0", "0.3", "0.5", "0.8", "0.95", "1"}))}};
}

}  // namespace twinarm
