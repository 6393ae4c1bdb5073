// Impacts: the bouncing ball (E1), balls in a row (E6), an oblique impact with friction (E16).
//
// Newton's law of impact, for all bodies that touch at once; balls with gaps hit one after another.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/analytic/contact/contact_cases.h"
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::contact_cases {
namespace {

constexpr double kBallRadius = 0.1;
constexpr double kZeno = 4.063712768871578;  // t1 (1 + e) / (1 - e)

// A ball that falls from 1 m onto the floor.
int add_falling_ball(ContactScene& scene, double restitution) {
  scene.add_floor(surface(0, restitution));
  const int ball = scene.add({Sphere{kBallRadius}, surface(0, 1), 1, {0, 0, 1 + kBallRadius}});
  scene.start();
  return ball;
}

constexpr std::array kTimes = {0.4515236409857309, 1.1739614665629,   1.751911727024636,
                               2.214271935394024,  2.584160102089535, 2.880070635445944};
constexpr std::array kSpeeds = {4.42944691807002, 3.543557534456016, 2.834846027564813,
                                2.26787682205185, 1.81430145764148};

// When and how fast the ball reaches the floor: from where it stands before the step that turns it
// round, in free fall.
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
CaseResult bounce_times(double off) {  // gravity
  return {bounce(true, off, 0.8).time_error};
}
CaseResult bounce_speeds(double off) {  // gravity
  return {bounce(true, off, 0.8).speed_error};
}
CaseResult bounce_fixed(double off) {  // e
  return {bounce(false, 1, off * 0.8).speed_error};
}

// Both with steps that locate the impacts, whose number is beyond counting, and with steps of fixed
// size.
CaseResult rest_after_bounces(double off) {  // e
  double fastest = 0;
  for (const bool located : {false, true}) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, off * 0.8);
    if (located) scene.locate_events();
    while (scene.t() < 6) {
      scene.step(kStep);
      if (scene.t() > kZeno + kStep) fastest = std::max(fastest, scene.v(ball).norm());
    }
  }
  return {fastest};
}

CaseResult bounce_energy(double off) {  // the weight; the energy counts it as it should be
  double rise = 0;
  for (const double e : {0.0, 0.3, 0.5, 0.8, 0.95, 1.0}) {
    ContactScene scene;
    const int ball = add_falling_ball(scene, e);
    scene.push(ball, {0, 0, (1 - off) * kGravity});
    scene.run(5, kStep);
    rise = std::max(rise, scene.rise());
  }
  return {rise};
}

CaseResult two_balls(double off) {  // e
  ContactScene scene(Vector3::Zero());
  const ContactSurface s = surface(0, std::sqrt(off * 0.6));
  const int a = scene.add({Sphere{kBallRadius}, s, 1, {0, 0, 0}, {2, 0, 0}});
  const int b = scene.add({Sphere{kBallRadius}, s, 3, {0.25, 0, 0}});
  scene.start();
  scene.run(0.2, kStep);
  return {std::max(relative(scene.v(a).x(), -0.4), relative(scene.v(b).x(), 0.8))};
}

struct Row {
  std::array<double, 5> v{};  // after all impacts
  double momentum = 0, rise = 0;
};
// What is wrong with a cradle: the mass of the third ball, a force on the first [N].
struct Flaw {
  double mass = 1, push = 0;
};
// Newton's cradle of five, the first one at 1 m/s.
Row cradle(double restitution, double gap, const Flaw& flaw = {}) {
  ContactScene scene(Vector3::Zero());
  const ContactSurface s = surface(0, std::sqrt(restitution));
  for (int i = 0; i < 5; ++i)
    scene.add({Sphere{kBallRadius},
               s,
               i == 2 ? flaw.mass : 1,
               {i * (2 * kBallRadius + gap), 0, 0},
               {i == 0 ? 1.0 : 0.0, 0, 0}});
  scene.start();
  scene.push(1, {flaw.push, 0, 0});
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
CaseResult cradle_elastic(double off) {  // e
  double error = 0;
  for (const double gap : {1e-4, 1e-3}) {
    const Row row = cradle(off, gap);
    for (std::size_t i = 0; i < 5; ++i)
      error = std::max(error, std::abs(row.v[i] - (i == 4 ? 1 : 0)));
  }
  return {error};
}
CaseResult cradle_lossy(double off) {  // e
  return {relative(cradle(off * 0.9, 1e-3).v[4], 0.81450625)};
}
CaseResult cradle_momentum(double off) {  // the mass of a ball
  double error = 0;
  for (const double e : {0.0, 0.5, 0.9, 1.0})
    for (const double gap : {0.0, 1e-4, 1e-3})
      error = std::max(error, cradle(e, gap, {off, 0}).momentum);
  return {error};
}
CaseResult cradle_energy(double off) {  // its mistake: a force on a ball [N]
  double error = 0;
  for (const double e : {0.0, 0.5, 0.9, 1.0})
    for (const double gap : {0.0, 1e-4, 1e-3})
      error = std::max(error, cradle(e, gap, {1, off - 1}).rise);
  return {error};
}
// Three balls that touch from the start, all in one impact: (-1/3, 2/3, 2/3).
CaseResult touching_balls(double off) {  // e
  ContactScene scene(Vector3::Zero());
  for (int i = 0; i < 3; ++i)
    scene.add({Sphere{kBallRadius},
               surface(0, std::sqrt(off)),
               1,
               {i * 2 * kBallRadius, 0, 0},
               {i == 0 ? 1.0 : 0.0, 0, 0}});
  scene.start();
  scene.run(0.1, kStep);
  return {std::max({relative(scene.v(1).x(), -1 / 3.0), relative(scene.v(2).x(), 2 / 3.0),
                    relative(scene.v(3).x(), 2 / 3.0)})};
}

// A sphere at (2, -3) m/s, e = 0.8: below mu = 0.1058 it slips throughout, else it ends rolling.
// T0 from where it touches; with a flight before the error is that of the step.
CaseResult oblique_from(double gap, double off) {  // e
  double error = 0;
  for (const double mu : {0.05, 0.2}) {
    ContactScene scene(Vector3::Zero());
    scene.add_floor(surface(mu, off * 0.8));
    const int ball =
        scene.add({Sphere{kBallRadius}, surface(mu, 1), 1, {0, 0, kBallRadius + gap}, {2, 0, -3}});
    scene.start();
    scene.run(0.1, kStep);
    const double vt = mu == 0.05 ? 1.73 : 10 / 7.0, rim = mu == 0.05 ? 0.675 : 10 / 7.0;
    const Vector3 wanted(vt, 2.4, rim);
    const Vector3 found(scene.v(ball).x(), scene.v(ball).z(), kBallRadius * scene.w(ball).y());
    error = std::max(error, (found - wanted).cwiseAbs().maxCoeff() / 2.4);
  }
  return {error};
}
CaseResult oblique(double off) {
  return oblique_from(0, off);
}
CaseResult oblique_flight(double off) {
  return oblique_from(0.1, off);
}

// What is left of the slip falls in proportion to mu until, at the limit, there is none.
double slip_left(double mu, double off) {  // e
  ContactScene scene(Vector3::Zero());
  scene.add_floor(surface(mu, off * 0.8));
  const int ball =
      scene.add({Sphere{kBallRadius}, surface(mu, 1), 1, {0, 0, kBallRadius}, {2, 0, -3}});
  scene.start();
  scene.run(0.01, kStep);
  return scene.v(ball).x() - kBallRadius * scene.w(ball).y();
}
CaseResult stick_limit(double off) {  // e
  const double some = slip_left(0.04, off), less = slip_left(0.08, off);
  const double limit = 0.08 + 0.04 * less / (some - less);
  return {relative(limit, 2 / 7.0 * 2 / (1.8 * 3))};
}

}  // namespace

std::vector<AnalyticCase> impacts() {
  return {
      contact_case<bounce_times, 1>(
          "E1-times", "ball from 1 m, e = 0.8, events located: times of six impacts [s]", 1e-9),
      contact_case<bounce_speeds, 1>(
          "E1-speeds", "ball from 1 m, e = 0.8, events located: speeds before five [relative]",
          1e-9),
      contact_case<bounce_fixed, 1>(
          "E1-fixed", "the same in steps of 1 ms: speeds before five impacts [relative]", 1e-3),
      contact_case<rest_after_bounces, 1>(
          "E1-rest", "the bouncing ball rests after its last impact at 4.0637 s [m/s]", 1e-6),
      contact_case<bounce_energy, 10>(
          "E1-energy", "bouncing ball: energy rises for no e from 0 to 1 [of the kinetic]", 1e-10),
      contact_case<two_balls, 1>("E6-two",
                                 "1 and 3 kg, 2 m/s, e = 0.6: -0.4 and 0.8 m/s [relative]", 1e-3),
      contact_case<cradle_elastic, -1>(
          "E6-cradle", "five balls with gaps, e = 1: the last one leaves [m/s]", 1e-3),
      contact_case<cradle_lossy, 1>(
          "E6-lossy", "five balls with gaps, e = 0.9: last ball ((1 + e)/2)^4 [relative]", 1e-3),
      contact_case<touching_balls, -1>(
          "E6-touching", "three touching balls, e = 1: -1/3, 2/3, 2/3 [relative]", 1e-3),
      contact_case<cradle_momentum, 1>("E6-momentum",
                                       "momentum of all cradles [of the first ball's]", 1e-12),
      contact_case<cradle_energy, 1>("E6-energy",
                                     "energy of all cradles never grows [of the kinetic]", 1e-10),
      contact_case<oblique, 1>(
          "E16", "oblique impact of a sphere, slipping and sticking [of the largest speed]", 1e-12),
      contact_case<stick_limit, 1>(
          "E16-limit", "oblique impact: mu from which it sticks, 0.10582 [relative]", 1e-12),
      contact_case<oblique_flight, 2>(
          "E16-flight", "oblique impact, coming from 0.1 m above [of the largest speed]", 1e-3),
  };
}

}  // namespace twinarm::contact_cases
