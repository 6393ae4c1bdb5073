// E1: bouncing ball, by Newton's law of impact. E6: balls in a row; the impact law holds at all
// contacts simultaneously, and with gaps between the balls the impacts follow one after the other.
#include <array>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kZeno = 4.063712768871578;  // t1 (1 + e) / (1 - e)

// Ball 1 m above the floor.
int add_falling_ball(ContactScene& scene, double restitution) {
  scene.add_floor(surface(0, restitution));
  return scene.start({Sphere{kBallRadius}, surface(0, 1), 1, {0, 0, 1 + kBallRadius}});
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
  return {max_over(std::array{false, true}, [scale](bool located) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, scale * 0.8);
    if (located) scene.locate_events();
    return scene.max_until(6, kStep,
                           [&] { return scene.t() > kZeno + kStep ? scene.v(ball).norm() : 0; });
  })};
}

CaseResult bounce_energy(double scale) {  // weight; energy() uses the correct one
  return {max_over({0.0, 0.3, 0.5, 0.8, 0.95, 1.0}, [scale](double e) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, e);
    scene.apply_force(ball, {0, 0, (1 - scale) * kGravity});
    scene.run(5, kStep);
    return scene.rise();
  })};
}

// ---- plots ----

double exact_bounce(double e, double t) {
  const double fall = std::sqrt(2 / kGravity);
  if (t < fall) return 1 - kGravity * t * t / 2;
  double speed = e * kGravity * fall, since = t - fall;
  while (speed > 1e-6 && since > 2 * speed / kGravity) since -= 2 * speed / kGravity, speed *= e;
  return speed > 1e-6 ? speed * since - kGravity * since * since / 2 : 0;
}

CaseResult two_balls(double scale) {  // e
  ContactScene scene(Vector3::Zero());
  const ContactSurface s = surface(0, std::sqrt(scale * 0.6));
  const int a = scene.add({Sphere{kBallRadius}, s, 1, {0, 0, 0}, {2, 0, 0}});
  const int b = scene.start({Sphere{kBallRadius}, s, 3, {0.25, 0, 0}});
  scene.run(0.2, kStep);
  return {std::max(relative(scene.v(a).x(), -0.4), relative(scene.v(b).x(), 0.8))};
}

// Balls in a row along x, the first one at 1 m/s.
void start_row(ContactScene& scene, int count, double gap, double restitution,
               double third_mass = 1) {
  const ContactSurface s = surface(0, std::sqrt(restitution));
  for (int i = 0; i < count; ++i)
    scene.add({Sphere{kBallRadius},
               s,
               i == 2 ? third_mass : 1,
               {i * (2 * kBallRadius + gap), 0, 0},
               {i == 0 ? 1.0 : 0.0, 0, 0}});
  scene.start();
}

struct Row {
  std::array<double, 5> v{};  // after all impacts
  double momentum = 0, rise = 0;
};
// Mutants of a cradle: mass of the third ball [kg], force on the first [N].
struct Flaw {
  double mass = 1, push = 0;
};
// Newton's cradle of five.
Row cradle(double restitution, double gap, const Flaw& flaw = {}) {
  ContactScene scene(Vector3::Zero());
  start_row(scene, 5, gap, restitution, flaw.mass);
  scene.apply_force(1, {flaw.push, 0, 0});
  Row row;
  for (int n = 0; n < 500; ++n) {
    scene.step(kStep);
    double sum = 0;
    for (int i = 0; i < 5; ++i) sum += scene.v(i + 1).x();
    row.momentum = std::max(row.momentum, std::abs(sum - 1));
  }
  for (int i = 0; i < 5; ++i) row.v[static_cast<std::size_t>(i)] = scene.v(i + 1).x();
  row.rise = scene.rise();
  return row;
}
CaseResult cradle_elastic(double scale) {  // e
  return {max_over({1e-4, 1e-3}, [scale](double gap) {
    std::array<double, 5> v = cradle(scale, gap).v;
    v[4] -= 1;
    return max_over(v, [](double error) { return std::abs(error); });
  })};
}
CaseResult cradle_lossy(double scale) {  // e
  return {relative(cradle(scale * 0.9, 1e-3).v[4], 0.81450625)};
}
double max_of_cradles(const Flaw& flaw, double Row::*number) {
  return max_over({0.0, 0.5, 0.9, 1.0}, [&](double e) {
    return max_over({0.0, 1e-4, 1e-3}, [&](double gap) { return cradle(e, gap, flaw).*number; });
  });
}
CaseResult cradle_momentum(double scale) {  // mass of a ball
  return {max_of_cradles({scale, 0}, &Row::momentum)};
}
CaseResult cradle_energy(double scale) {  // mutant: a force of scale - 1 on a ball [N]
  return {max_of_cradles({1, scale - 1}, &Row::rise)};
}
// Three touching balls, one simultaneous impact: (-1/3, 2/3, 2/3).
CaseResult touching_balls(double scale) {  // e
  ContactScene scene(Vector3::Zero());
  start_row(scene, 3, 0, scale);
  scene.run(0.1, kStep);
  return {std::max({relative(scene.v(1).x(), -1 / 3.0), relative(scene.v(2).x(), 2 / 3.0),
                    relative(scene.v(3).x(), 2 / 3.0)})};
}

// ---- plots ----

Values read_momentum(Scene s) {
  double sum = 0;
  for (int i = 1; i <= 5; ++i) sum += s.v(i).x();
  return {sum};
}
// Speed of the last ball: each gap is crossed at (1 + e)/2 = `part` of the speed before.
double exact_cradle(double gap, double part, double t) {
  double speed = 1, at = 0;
  for (int i = 0; i < 4; ++i) at += gap / speed, speed *= part;
  return t < at ? 0 : speed;
}
double exact_elastic(std::size_t run, double t) {
  return exact_cradle(run == 0 ? 1e-4 : 1e-3, 1, t);
}
double exact_lossy(std::size_t k, double t) {
  return k == 4 ? exact_cradle(1e-3, 0.95, t) : NAN;
}
double exact_two(std::size_t k, double t) {
  return t < 0.025 ? (k == 0 ? 2. : 0.) : (k == 0 ? -0.4 : 0.8);
}
double exact_touching(std::size_t k, double t) {
  return t == 0 ? (k == 0 ? 1. : 0.) : (k == 0 ? -1 / 3. : 2 / 3.);
}

}  // namespace

CaseFamily impacts_cases() {
  const auto read_height = [](Scene s) { return Values{s.p(1).z() - 0.1}; };
  const auto exact_bounces = [](std::size_t, double t) { return exact_bounce(0.8, t); };
  const Plot height{{"height of the ball [m]"}, read_height, exact_bounces};
  const Plot conserved = height.without_convergence(kRounding);
  const Plot last{{"speed of ball 5 [m/s]"}, velocity<5, 0>};
  const Plot speed{last.readings, last.read, nullptr, {"e = 0", "0.5", "0.9", "1"}, 3, 0.1};
  const auto one = [](std::size_t, double) { return 1.; };
  const Plot momentum{{"momentum [kg m/s]"}, read_momentum, one, speed.runs, 3, 0.1};
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
                                           .of_runs({"e = 0", "0.3", "0.5", "0.8", "0.95", "1"})),
       contact_case<two_balls, 1>("E6-two", 1e-3,
                                  {{"1 kg [m/s]", "3 kg [m/s]"}, velocities_x<1, 2>, exact_two}),
       contact_case<cradle_elastic, -1>(
           "E6-cradle", 1e-3,
           {last.readings, last.read, exact_elastic, {"gaps 0.1 mm", "gaps 1 mm"}, 1, 0.02}),
       contact_case<cradle_lossy, 1>(
           "E6-lossy", 1e-3,
           Plot{{"ball 1 [m/s]", "ball 2 [m/s]", "ball 3 [m/s]", "ball 4 [m/s]", "ball 5 [m/s]"},
                velocities_x<1, 2, 3, 4, 5>,
                exact_lossy}
               .with(&Plot::until, 0.02)
               .with(&Plot::convergence_note,
                     "A step of 2 ms is longer than the time between two impacts.")),
       contact_case<touching_balls, -1>("E6-touching", 1e-3,
                                        Plot{{"ball 1 [m/s]", "ball 2 [m/s]", "ball 3 [m/s]"},
                                             velocities_x<1, 2, 3>,
                                             exact_touching}
                                            .with(&Plot::until, 0.02)),
       contact_case<cradle_momentum, 1>("E6-momentum", 1e-12,
                                        momentum.without_convergence(kRounding)),
       contact_case<cradle_energy, 1>("E6-energy", 1e-10, speed.without_convergence(kRounding))}};
}

}  // namespace twinarm
