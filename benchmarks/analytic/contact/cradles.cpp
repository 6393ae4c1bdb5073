// Balls in a row (E6), by Newton's law of impact for all bodies that touch at once; balls with gaps
// hit one after another.
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

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

// ---- what a page draws of them ----

Values seen_momentum(Scene s) {
  double sum = 0;
  for (int i = 1; i <= 5; ++i) sum += s.v(i).x();
  return {sum};
}
// Impact n comes when all gaps before have been crossed, each at (1 + e)/2 of the speed before.
double known_cradle(double gap, double part, double t) {
  double speed = 1, at = 0;
  for (int i = 0; i < 4; ++i) at += gap / speed, speed *= part;
  return t < at ? 0 : speed;
}

}  // namespace

CaseFamily cradles_cases() {
  const ContactCasePlot speed{.readings = {"speed of ball 5 [m/s]"},
                              .read = velocity<5, 0>,
                              .runs = {"e = 0", "0.5", "0.9", "1"},
                              .every = 3,
                              .until = 0.1,
                              .no_steps = kRounding};
  ContactCasePlot momentum = speed;
  momentum.readings = {"momentum [kg m/s]"}, momentum.read = seen_momentum;
  momentum.exact = [](std::size_t, double) { return 1.; };
  return {190,
          {contact_case<two_balls, 1>("E6-two", 1e-3,
                                      {.readings = {"1 kg [m/s]", "3 kg [m/s]"},
                                       .read = velocities_x<1, 2>,
                                       .exact =
                                           [](std::size_t k, double t) {
                                             return t < 0.025 ? (k == 0 ? 2. : 0.)
                                                              : (k == 0 ? -0.4 : 0.8);
                                           }}),
           contact_case<cradle_elastic, -1>(
               "E6-cradle", 1e-3,
               {.readings = {"speed of ball 5 [m/s]"},
                .read = velocity<5, 0>,
                .exact = [](std::size_t run,
                            double t) { return known_cradle(run == 0 ? 1e-4 : 1e-3, 1, t); },
                .runs = {"gaps 0.1 mm", "gaps 1 mm"},
                .until = 0.02}),
           contact_case<cradle_lossy, 1>(
               "E6-lossy", 1e-3,
               {.readings = {"ball 1 [m/s]", "ball 2 [m/s]", "ball 3 [m/s]", "ball 4 [m/s]",
                             "ball 5 [m/s]"},
                .read = velocities_x<1, 2, 3, 4, 5>,
                .exact = [](std::size_t k,
                            double t) { return k == 4 ? known_cradle(1e-3, 0.95, t) : NAN; },
                .until = 0.02,
                .about_steps = "A step of 2 ms is longer than the time between two impacts."}),
           contact_case<touching_balls, -1>(
               "E6-touching", 1e-3,
               {.readings = {"ball 1 [m/s]", "ball 2 [m/s]", "ball 3 [m/s]"},
                .read = velocities_x<1, 2, 3>,
                .exact =
                    [](std::size_t k, double t) {
                      return t == 0 ? (k == 0 ? 1. : 0.) : (k == 0 ? -1 / 3. : 2 / 3.);
                    },
                .until = 0.02}),
           contact_case<cradle_momentum, 1>("E6-momentum", 1e-12, momentum),
           contact_case<cradle_energy, 1>("E6-energy", 1e-10, speed)}};
}

}  // namespace twinarm
