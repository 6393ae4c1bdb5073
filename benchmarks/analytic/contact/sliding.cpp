// E2: sliding and sticking of a block on an incline and on the flat.
#include <array>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kIncline = std::numbers::pi / 6;
constexpr double kSlide = 0.6571453944373284;  // g (sin 30 - 0.5 cos 30) [m/s^2]

// Cube of 2 kg, 0.2 m wide; on an incline x points downhill.
int add_block(ContactScene& scene, double mu, const Vector3& v = Vector3::Zero()) {
  return scene.start_on_floor({Box{Vector3::Constant(0.2)}, surface(mu), 2, {0, 0, 0.1}, v});
}

CaseResult creep(double scale) {  // mu
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, scale * 0.6);
  return {scene.max_until(10, kStep, [&] { return (scene.p(block) - Vector3(0, 0, 0.1)).norm(); })};
}

CaseResult holding_forces(double scale) {  // gravity
  ContactScene scene(scale * tilted_gravity(kIncline));
  const int block = add_block(scene, 0.6);
  return {scene.max_until(1, kStep, [&] {
    const Vector3 F = scene.force(block);
    return std::max(relative(F.x(), -9.81), relative(F.z(), 16.99141842225069));
  })};
}

CaseResult slide_speed(double scale) {  // mu
  ContactScene scene(tilted_gravity(kIncline));
  const int block = add_block(scene, scale * 0.5);
  scene.run(1, kStep);
  return {relative(scene.v(block).x(), kSlide)};
}
CaseResult slide_place(double scale) {  // mu
  return with_order(
      [scale](double h) {
        ContactScene scene(tilted_gravity(kIncline));
        const int block = add_block(scene, scale * 0.5);
        scene.run(1, h);
        return std::abs(scene.p(block).x() - 0.3285726972186642) / scene.v(block).x();
      },
      kStep);
}

// Starts uphill at 3 m/s: time and distance of its reversal, and speed of its return.
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
    if (v > 0 && x >= 0) {  // back at x = 0: extrapolated from just beyond
      result.speed = std::sqrt(v * v - 2 * kSlide * x);
      break;
    }
  }
  return result;
}
CaseResult reversal_time(double scale) {  // gravity
  const Return r = push_up(Steps::fixed, scale, 0.5);
  return {std::max(std::abs(r.time - 0.3277665962460217),
                   std::abs(r.distance - 0.4916498943690325) / 3)};
}
CaseResult return_speed(double scale) {  // mu
  return {relative(push_up(Steps::located, 1, scale * 0.5).speed, 0.8038475772933681)};
}

// On the flat at 3 m/s, mu = 0.4, in some direction: time and place of its stop.
struct Stop {
  double time = 0, distance = 0, sideways = 0;
};
Stop launch(double heading_deg, double mu, double y_scale = 1) {
  const double heading = heading_deg * kDegree;
  const Vector3 along(std::cos(heading), std::sin(heading), 0);
  ContactScene scene;
  const int block = add_block(scene, mu, 3 * along.cwiseProduct(Vector3(1, y_scale, 1)));
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
CaseResult stopping(double scale) {  // mu
  return {max_over(kHeadings, [scale](double heading) {
    const Stop stop = launch(heading, scale * 0.4);
    return std::max(std::abs(stop.time - 0.764525993883792),
                    std::abs(stop.distance - 1.146788990825688) / 3);
  })};
}
CaseResult headings(double scale) {  // velocity along y
  const double first = launch(kHeadings[0], 0.4).distance;
  return {max_over(kHeadings, [&](double heading) {
    const Stop stop = launch(heading, 0.4, scale);
    return std::max(relative(stop.distance, first), stop.sideways / first);
  })};
}

CaseResult min_friction_to_hold(double scale) {  // mu
  const double limit = threshold(0.4, 0.8, 1e-5, [scale](double mu) {
    ContactScene scene(tilted_gravity(kIncline));
    const int block = add_block(scene, scale * mu);
    scene.run(0.5, kStep);
    return scene.v(block).norm() < 1e-6;
  });
  return {std::abs(limit - 0.5773502691896258)};
}

// ---- plots ----

Values read_forces(Scene s) {
  if (s.t() == 0) return {NAN, NAN};
  return {-s.force(1).x(), s.force(1).z()};
}
// Constant deceleration until it stops, then constant acceleration downhill.
double exact_uphill(std::size_t, double t) {
  const double up = kGravity * (std::sin(kIncline) + 0.5 * std::cos(kIncline));
  const double top = 3 / up;
  return t < top ? 3 * t - up * t * t / 2 : 1.5 * top - kSlide * (t - top) * (t - top) / 2;
}
double exact_stop(std::size_t, double t) {
  const double a = 0.4 * kGravity, end = std::min(t, 3 / a);
  return 3 * end - a * end * end / 2;
}

}  // namespace

CaseFamily sliding_cases() {
  const auto exact_slide = [](std::size_t, double t) { return kSlide * t * t / 2; };
  const auto exact_slide_speed = [](std::size_t, double t) { return kSlide * t; };
  const auto read_up = [](Scene s) { return Values{-s.p(1).x()}; };
  const Plot speed{{"speed [m/s]"}, velocity<1, 0>};
  const Plot place_x{{"x downhill [m]"}, place<1, 0>, exact_slide};
  const Plot uphill{{"distance uphill [m]"}, read_up, exact_uphill};
  const Plot distance{{"distance [m]"}, horizontal_distance, exact_stop};
  const auto exact_forces = [](std::size_t k, double) {
    return 2 * kGravity * (k == 0 ? std::sin(kIncline) : std::cos(kIncline));
  };
  return {
      210,
      {contact_case<creep, -50>("E2-creep", 1e-6,
                                place_x.with(&Plot::exact, zero).without_convergence(kResting)),
       contact_case<holding_forces, 1>(
           "E2-forces", 1e-6,
           Plot{{"friction [N]", "normal force [N]"}, read_forces, exact_forces}
               .without_convergence(kResting)),
       contact_case<slide_speed, 1>("E2-slide", 1e-3, speed.with(&Plot::exact, exact_slide_speed)),
       contact_case<slide_place, 1>("E2-place", kStep, place_x),
       contact_case<reversal_time, 10>("E2-up", kStep,
                                       uphill.with(&Plot::convergence_note, kPartOfStep)),
       contact_case<return_speed, 1>("E2-return", 1e-9, uphill.without_convergence(kLocated)),
       contact_case<stopping, 5>("E2-stop", kStep,
                                 distance.of_runs({"0°", "15°", "30°", "45°"})
                                     .with(&Plot::convergence_note, kPartOfStep)),
       contact_case<headings, 5>("E2-headings", 1e-3,
                                 distance.of_runs({"0°", "0° again", "15°", "30°", "45°"})),
       contact_case<min_friction_to_hold, 5>("E2-threshold", 1e-3, speed.searching("μ"))}};
}

}  // namespace twinarm
