// Sliding and sticking: a block on an incline and on the flat (E2).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/contact/contact_cases.h"
#include "benchmarks/analytic/support/contact_look.h"
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kIncline = std::numbers::pi / 6;
constexpr double kSlide = 0.6571453944373284;  // g (sin 30 - 0.5 cos 30) [m/s^2]

// A cube of 2 kg, 0.2 m wide, on an incline whose x points downhill.
int add_block(ContactScene& scene, double mu, const Vector3& v = Vector3::Zero()) {
  scene.add_floor(surface(mu));
  const int block = scene.add({Box{Vector3::Constant(0.2)}, surface(mu), 2, {0, 0, 0.1}, v});
  scene.start();
  return block;
}

CaseResult creep(double off) {  // mu
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, off * 0.6);
  double most = 0;
  while (scene.t() < 10) {
    scene.step(kStep);
    most = std::max(most, (scene.p(block) - Vector3(0, 0, 0.1)).norm());
  }
  return {most};
}

CaseResult holding_forces(double off) {  // gravity
  ContactScene scene(off * tilted_gravity(kIncline));
  const int block = add_block(scene, 0.6);
  double error = 0;
  for (int n = 0; n < 1000; ++n) {
    scene.step(kStep);
    const Vector3 F = scene.force(block);
    error = std::max({error, relative(F.x(), -9.81), relative(F.z(), 16.99141842225069)});
  }
  return {error};
}

CaseResult slide_speed(double off) {  // mu
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, off * 0.5);
  scene.run(1, kStep);
  return {relative(scene.v(block).x(), kSlide)};
}
CaseResult slide_place(double off) {  // mu
  return with_order(
      [off](double h) {
        ContactScene scene(tilted_gravity(kIncline));
        const int block = add_block(scene, off * 0.5);
        scene.run(1, h);
        return std::abs(scene.p(block).x() - 0.3285726972186642) / scene.v(block).x();
      },
      kStep);
}

// Pushed uphill at 3 m/s: where and when it turns, and how fast it comes back.
struct Return {
  double time = 0, distance = 0, speed = 0;
};
Return push_up(Steps steps, double gravity, double mu) {
  ContactScene scene(gravity * tilted_gravity(kIncline));
  const int block = add_block(scene, mu, {-3, 0, 0});
  if (steps == Steps::located) scene.locate_events();
  Return result;
  while (scene.t() < 3) {
    scene.step(kStep);
    const double v = scene.v(block).x(), x = scene.p(block).x();
    if (result.time == 0 && v >= 0) result.time = scene.t(), result.distance = -x;
    if (v > 0 && x >= 0) {  // back to x = 0, from the place just beyond
      result.speed = std::sqrt(v * v - 2 * kSlide * x);
      break;
    }
  }
  return result;
}
CaseResult turn_time(double off) {  // gravity
  const Return r = push_up(Steps::fixed, off, 0.5);
  return {std::max(std::abs(r.time - 0.3277665962460217),
                   std::abs(r.distance - 0.4916498943690325) / 3)};
}
CaseResult return_speed(double off) {  // mu
  return {relative(push_up(Steps::located, 1, off * 0.5).speed, 0.8038475772933681)};
}

// On the flat at 3 m/s, mu = 0.4, in some direction: when and where it stops.
struct Stop {
  double time = 0, distance = 0, sideways = 0;
};
// One of its velocity's components may be off.
Stop launch(double heading_deg, double mu, double off = 1) {
  const double heading = heading_deg * kDegree;
  const Vector3 along(std::cos(heading), std::sin(heading), 0);
  ContactScene scene;
  const int block = add_block(scene, mu, 3 * along.cwiseProduct(Vector3(1, off, 1)));
  Stop stop;
  while (scene.t() < 1) {
    scene.step(kStep);
    if (stop.time == 0 && scene.v(block).norm() < 1e-9) stop.time = scene.t();
  }
  const Vector3 moved = scene.p(block) - Vector3(0, 0, 0.1);
  stop.distance = moved.dot(along);
  stop.sideways = (moved - stop.distance * along).norm();
  return stop;
}
constexpr std::array kHeadings = {0.0, 15.0, 30.0, 45.0};
CaseResult stopping(double off) {  // mu
  double error = 0;
  for (const double heading : kHeadings) {
    const Stop stop = launch(heading, off * 0.4);
    error = std::max({error, std::abs(stop.time - 0.764525993883792),
                      std::abs(stop.distance - 1.146788990825688) / 3});
  }
  return {error};
}
CaseResult headings(double off) {  // the velocity along y
  const double first = launch(kHeadings[0], 0.4).distance;
  double spread = 0;
  for (const double heading : kHeadings) {
    const Stop stop = launch(heading, 0.4, off);
    spread = std::max({spread, relative(stop.distance, first), stop.sideways / first});
  }
  return {spread};
}

CaseResult least_friction_to_hold(double off) {  // mu
  const double limit = threshold(0.4, 0.8, 1e-5, [off](double mu) {
    ContactScene scene(tilted_gravity(kIncline));
    const int block = add_block(scene, off * mu);
    scene.run(0.5, kStep);
    return scene.v(block).norm() < 1e-6;
  });
  return {std::abs(limit - 0.5773502691896258)};
}

// ---- what a page draws of them ----

constexpr double kSlope = 30 * kDegree;
// None before the first step.
Values seen_forces(Scene s) {
  if (s.t() == 0) return {NAN, NAN};
  return {-s.force(1).x(), s.force(1).z()};
}
Values seen_way(Scene s) {
  return {std::hypot(s.p(1).x(), s.p(1).y())};
}
// Constant deceleration until it stops, and what comes then.
double known_uphill(std::size_t, double t) {
  const double up = kGravity * (std::sin(kSlope) + 0.5 * std::cos(kSlope));
  const double down = kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope));
  const double turn = 3 / up;
  return t < turn ? 3 * t - up * t * t / 2 : 1.5 * turn - down * (t - turn) * (t - turn) / 2;
}
double known_stop(std::size_t, double t) {
  const double a = 0.4 * kGravity, end = std::min(t, 3 / a);
  return 3 * end - a * end * end / 2;
}
double known_slide(std::size_t, double t) {
  return kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope)) * t * t / 2;
}
double known_slide_speed(std::size_t, double t) {
  return kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope)) * t;
}
Values seen_up(Scene s) {
  return {-s.p(1).x()};
}

constexpr const char* kStatementE2 =
    "A block of 2 kg on an incline of 30° with a friction of μ = 0.5 slides, for tan 30° = 0.577 "
    "is more than that: <p>x″ = g (sin α − μ cos α)</p>";

}  // namespace

CaseFamily sliding_cases() {
  const std::vector<AnalyticCase> cases = {
      contact_case<creep, -50>(
          "E2-creep", "block on 30 degrees, mu = 0.6: creep in 10 s [m]", 1e-6,
          "A block of 2 kg on an incline of 30° with μ = 0.6 &gt; tan 30° is at rest, and stays "
          "there: exact Coulomb friction does not creep. <p>x(t) = x(0)</p>",
          ContactLook{.readings = {"x downhill [m]"},
                      .read = place<1, 0>,
                      .exact = zero,
                      .no_steps = kResting}),
      contact_case<holding_forces, 1>(
          "E2-forces", "block held on 30 degrees: 9.81 N and 16.9914 N [relative]", 1e-6,
          "The block at rest on 30°: what carries it is its weight. <p>F = m g sin α = "
          "9.81&nbsp;N, N = m g cos α = 16.991&nbsp;N</p>",
          ContactLook{.readings = {"friction [N]", "normal force [N]"},
                      .read = seen_forces,
                      .exact =
                          [](std::size_t k, double) {
                            return 2 * kGravity * (k == 0 ? std::sin(kSlope) : std::cos(kSlope));
                          },
                      .no_steps = kResting}),
      contact_case<slide_speed, 1>(
          "E2-slide", "block on 30 degrees, mu = 0.5: speed after 1 s [relative]", 1e-3,
          kStatementE2,
          ContactLook{
              .readings = {"speed [m/s]"}, .read = velocity<1, 0>, .exact = known_slide_speed}),
      contact_case<slide_place, 1>(
          "E2-place", "block on 30 degrees, mu = 0.5: place after 1 s [s]", kStep, kStatementE2,
          ContactLook{.readings = {"x downhill [m]"}, .read = place<1, 0>, .exact = known_slide}),
      contact_case<turn_time, 10>(
          "E2-up", "block pushed uphill at 3 m/s: when and where it turns [s]", kStep,
          "The block is pushed uphill at 3 m/s, μ = 0.5: friction and weight slow it down "
          "together. <p>t = v/(g (sin α + μ cos α)), s = v<sup>2</sup>/(2g (sin α + μ cos α))</p>",
          ContactLook{.readings = {"way uphill [m]"},
                      .read = seen_up,
                      .exact = known_uphill,
                      .about_steps = kPartOfStep}),
      contact_case<return_speed, 1>(
          "E2-return", "block pushed uphill, events located: how fast it is back [relative]", 1e-9,
          "The block is pushed uphill at 3 m/s, and comes back to where it was: friction has taken "
          "energy on both ways. <p>v<sub>back</sub> = v √((sin α − μ cos α)/(sin α + μ cos α))</p>",
          ContactLook{.readings = {"way uphill [m]"},
                      .read = seen_up,
                      .exact = known_uphill,
                      .no_steps = kLocated}),
      contact_case<stopping, 5>(
          "E2-stop", "block on the flat, 3 m/s, mu = 0.4: when and where it stops [s]", kStep,
          "A block on the flat starts at 3 m/s, μ = 0.4, in four directions: <p>t = v/(μ g), s = "
          "v<sup>2</sup>/(2 μ g)</p>",
          ContactLook{.readings = {"way [m]"},
                      .read = seen_way,
                      .exact = known_stop,
                      .runs = {"0°", "15°", "30°", "45°"},
                      .about_steps = kPartOfStep}),
      contact_case<headings, 5>("E2-headings",
                                "stops alike at headings of 0, 15, 30, 45 degrees [relative]", 1e-3,
                                "The same in four directions: a cone of friction knows none, a "
                                "pyramid does. <p>s(0°) = s(15°) = s(30°) = s(45°)</p>",
                                ContactLook{.readings = {"way [m]"},
                                            .read = seen_way,
                                            .exact = known_stop,
                                            .runs = {"0°", "0° again", "15°", "30°", "45°"}}),
      contact_case<least_friction_to_hold, 5>("E2-threshold",
                                              "least mu that holds on 30 degrees: tan 30", 1e-3,
                                              "The least friction that holds a block on 30°, by "
                                              "bisection: <p>μ = tan 30° = 0.57735</p>",
                                              ContactLook{.readings = {"speed [m/s]"},
                                                          .read = velocity<1, 0>,
                                                          .search = "μ",
                                                          .no_steps = kSearch}),
  };
  return {210, cases};
}

}  // namespace twinarm
