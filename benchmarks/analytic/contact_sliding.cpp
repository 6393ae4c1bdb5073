// Sliding and sticking: a block on an incline and on the flat (E2), a billiard ball (E5).
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "benchmarks/analytic/contact_cases.h"
#include "benchmarks/analytic/contact_scene.h"

namespace twinarm::contact_cases {
namespace {

constexpr double kIncline = std::numbers::pi / 6;
constexpr double kSlide = 0.6571453944373284;  // g (sin 30 - 0.5 cos 30) [m/s^2]

// A cube of 2 kg, 0.2 m wide, on an incline whose x points downhill.
int add_block(ContactScene& scene, double mu, const Vector3& v = Vector3::Zero()) {
  scene.add_floor(surface(mu));
  const int block = scene.add({Box{Vector3::Constant(0.2)}, surface(mu), 2, {0, 0, 0.1}, v});
  scene.start();
  return block;
}

CaseResult creep() {
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, 0.6);
  double most = 0;
  while (scene.t() < 10) {
    scene.step(kStep);
    most = std::max(most, (scene.p(block) - Vector3(0, 0, 0.1)).norm());
  }
  return {most};
}

CaseResult holding_forces() {
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, 0.6);
  double error = 0;
  for (int n = 0; n < 1000; ++n) {
    scene.step(kStep);
    const Vector3 F = scene.force(block);
    error = std::max({error, relative(F.x(), -9.81), relative(F.z(), 16.99141842225069)});
  }
  return {error};
}

CaseResult slide_speed() {
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, 0.5);
  scene.run(1, kStep);
  return {relative(scene.v(block).x(), kSlide)};
}
CaseResult slide_place() {
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, 0.5);
  scene.run(1, kStep);
  return {std::abs(scene.p(block).x() - 0.3285726972186642) / scene.v(block).x()};
}

// Pushed uphill at 3 m/s: where and when it turns, and how fast it comes back.
struct Return {
  double time = 0, distance = 0, speed = 0;
};
Return push_up(Steps steps) {
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, 0.5, {-3, 0, 0});
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
CaseResult turn_time() {
  const Return r = push_up(Steps::fixed);
  return {std::max(std::abs(r.time - 0.3277665962460217),
                   std::abs(r.distance - 0.4916498943690325) / 3)};
}
CaseResult return_speed() {
  return {relative(push_up(Steps::located).speed, 0.8038475772933681)};
}

// On the flat at 3 m/s, mu = 0.4, in some direction: when and where it stops.
struct Stop {
  double time = 0, distance = 0, sideways = 0;
};
Stop launch(double heading_deg) {
  const double heading = heading_deg * std::numbers::pi / 180;
  const Vector3 along(std::cos(heading), std::sin(heading), 0);
  ContactScene scene;
  const int block = add_block(scene, 0.4, 3 * along);
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
CaseResult stopping() {
  double error = 0;
  for (const double heading : kHeadings) {
    const Stop stop = launch(heading);
    error = std::max({error, std::abs(stop.time - 0.764525993883792),
                      std::abs(stop.distance - 1.146788990825688) / 3});
  }
  return {error};
}
CaseResult headings() {
  const double first = launch(kHeadings[0]).distance;
  double spread = 0;
  for (const double heading : kHeadings) {
    const Stop stop = launch(heading);
    spread = std::max({spread, relative(stop.distance, first), stop.sideways / first});
  }
  return {spread};
}

CaseResult least_friction_to_hold() {
  const double limit = threshold(0.4, 0.8, 1e-5, [](double mu) {
    ContactScene scene(tilted_gravity(kIncline));
    const int block = add_block(scene, mu);
    scene.run(0.5, kStep);
    return scene.v(block).norm() < 1e-6;
  });
  return {std::abs(limit - 0.5773502691896258)};
}

// Billiards: R = 0.0286 m, mu = 0.2, 2 m/s, without and with top spin (R w = 4 m/s).
struct Roll {
  double time = 0, x = 0, v = 0, rim = 0, loss = 0;
};
Roll billiard(double rim) {
  constexpr double R = 0.0286;
  ContactScene scene;
  scene.add_floor(surface(0.2));
  const int ball =
      scene.add({Sphere{R}, surface(0.2), 0.17, {0, 0, R}, {2, 0, 0}, {0, rim / R, 0}});
  scene.start();
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
CaseResult billiard_time() {
  const Roll roll = billiard(0);
  return {std::max(std::abs(roll.time - 0.291247997670016),
                   std::abs(roll.x - 0.4992822817200275) / roll.v)};
}
CaseResult billiard_speed() {
  const Roll roll = billiard(0), top = billiard(4);
  return {std::max({relative(roll.v, 10 / 7.0), relative(roll.rim, 10 / 7.0),
                    relative(roll.loss, 2 / 7.0), relative(top.v, 18 / 7.0)})};
}

}  // namespace

std::vector<AnalyticCase> sliding() {
  const char* group = "contact";
  return {
      {"E2-creep", group, "block on 30 degrees, mu = 0.6: creep in 10 s [m]", 1e-6, creep},
      {"E2-forces", group, "block held on 30 degrees: 9.81 N and 16.9914 N [relative]", 1e-6,
       holding_forces},
      {"E2-slide", group, "block on 30 degrees, mu = 0.5: speed after 1 s [relative]", 1e-3,
       slide_speed},
      {"E2-place", group, "block on 30 degrees, mu = 0.5: place after 1 s [s]", kStep, slide_place},
      {"E2-up", group, "block pushed uphill at 3 m/s: when and where it turns [s]", kStep,
       turn_time},
      {"E2-return", group, "block pushed uphill, events located: how fast it is back [relative]",
       1e-9, return_speed},
      {"E2-stop", group, "block on the flat, 3 m/s, mu = 0.4: when and where it stops [s]", kStep,
       stopping},
      {"E2-headings", group, "stops alike at headings of 0, 15, 30, 45 degrees [relative]", 1e-3,
       headings},
      {"E2-threshold", group, "least mu that holds on 30 degrees: tan 30", 1e-3,
       least_friction_to_hold},
      {"E5-time", group, "billiard ball: end of sliding [s]; closed form", kStep, billiard_time},
      {"E5-speed", group, "billiard ball: speed, spin, loss; with top spin [relative]", 1e-3,
       billiard_speed},
  };
}

}  // namespace twinarm::contact_cases
