// Sliding, toppling, jamming: E2, E3, E5, E7.
#include <algorithm>

#include "app/compare/page/contact_readings.h"

namespace twinarm::compare_page::contact_look {
namespace {

constexpr double kSlope = 30 * kDegree;

Values lean(Scene s) {
  return {std::atan2(s.R(1)(0, 2), s.R(1)(2, 2))};
}
// None before the first step.
Values forces(Scene s) {
  if (s.t() == 0) return {NAN, NAN};
  return {-s.force(1).x(), s.force(1).z()};
}
Values flat_distance(Scene s) {
  return {std::hypot(s.p(1).x(), s.p(1).y())};
}
// Constant deceleration until it stops, and what comes then.
double uphill(std::size_t, double t) {
  const double up = kGravity * (std::sin(kSlope) + 0.5 * std::cos(kSlope));
  const double down = kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope));
  const double turn = 3 / up;
  return t < turn ? 3 * t - up * t * t / 2 : 1.5 * turn - down * (t - turn) * (t - turn) / 2;
}
double stopping(std::size_t, double t) {
  const double a = 0.4 * kGravity, end = std::min(t, 3 / a);
  return 3 * end - a * end * end / 2;
}
double sliding_place(std::size_t, double t) {
  return kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope)) * t * t / 2;
}
double sliding_speed(std::size_t, double t) {
  return kGravity * (std::sin(kSlope) - 0.5 * std::cos(kSlope)) * t;
}
// Without and with top spin: the centre goes to 5/7 v + 2/7 R w.
double billiard_centre(std::size_t run, double t) {
  const double change = 0.2 * kGravity * t;
  return run == 0 ? std::max(2 - change, 10 / 7.0) : std::min(2 + change, 18 / 7.0);
}
double billiard(std::size_t k, double t) {
  return k == 0 ? billiard_centre(0, t) : std::min(2.5 * 0.2 * kGravity * t, 10 / 7.0);
}
// Housner: what is left of the turn's energy lifts it again.
double rocked_back(std::size_t, double t) {
  const double alpha = std::atan(0.4), height = std::cos(alpha);
  const double lift = 0.629013079667063 * (std::cos(alpha - 0.1) - height);
  return t < 0.2 ? NAN : std::acos(lift + height) - alpha;
}

}  // namespace

std::vector<ContactLook> sliding() {
  const std::vector<std::string> uphill_m = {"way uphill [m]"}, lean_rad = {"lean [rad]"};
  const auto up = [](Scene s) { return Values{-s.p(1).x()}; };
  return {
      {.name = "E2-creep",
       .readings = {"x downhill [m]"},
       .read = place<1, 0>,
       .exact = zero,
       .no_steps = kResting},
      {.name = "E2-forces",
       .readings = {"friction [N]", "normal force [N]"},
       .read = forces,
       .exact =
           [](std::size_t k, double) {
             return 2 * kGravity * (k == 0 ? std::sin(kSlope) : std::cos(kSlope));
           },
       .no_steps = kResting},
      {.name = "E2-slide",
       .readings = {"speed [m/s]"},
       .read = velocity<1, 0>,
       .exact = sliding_speed},
      {.name = "E2-place",
       .readings = {"x downhill [m]"},
       .read = place<1, 0>,
       .exact = sliding_place},
      {.name = "E2-up",
       .readings = uphill_m,
       .read = up,
       .exact = uphill,
       .about_steps = kPartOfStep},
      {.name = "E2-return",
       .readings = uphill_m,
       .read = up,
       .exact = uphill,
       .no_steps = kLocated},
      {.name = "E2-stop",
       .readings = {"way [m]"},
       .read = flat_distance,
       .exact = stopping,
       .runs = {"0°", "15°", "30°", "45°"},
       .about_steps = kPartOfStep},
      {.name = "E2-headings",
       .readings = {"way [m]"},
       .read = flat_distance,
       .exact = stopping,
       .runs = {"0°", "0° again", "15°", "30°", "45°"}},
      {.name = "E2-threshold",
       .readings = {"speed [m/s]"},
       .read = velocity<1, 0>,
       .search = "μ",
       .no_steps = kSearch},
      {.name = "E5-time",
       .readings = {"v of the centre [m/s]", "R ω [m/s]"},
       .read = speed_and_rim<286>,
       .exact = billiard,
       .about_steps = kPartOfStep},
      {.name = "E5-speed",
       .readings = {"v of the centre [m/s]"},
       .read = velocity<1, 0>,
       .exact = billiard_centre,
       .runs = {"no spin", "top spin"}},
      {.name = "E3-tilt",
       .readings = lean_rad,
       .read = lean,
       .search = "α/rad",
       .no_steps = kSearch},
      {.name = "E3-push",
       .readings = lean_rad,
       .read = lean,
       .search = "F/(m g)",
       .no_steps = kSearch},
      {.name = "E3-slide", .readings = lean_rad, .read = lean, .search = "μ", .no_steps = kSearch},
      {.name = "E3-curb",
       .readings = {"rate [rad/s]"},
       .read = [](Scene s) { return Values{s.w(1).y()}; },
       .exact = [](std::size_t, double) { return 2.586206896551724; },
       .known_at = 2e-3,
       .no_steps =
           "A plastic impact takes two steps: the rate is read after the second, and weight "
           "works on it meanwhile."},
      {.name = "E3-over",
       .readings = lean_rad,
       .read = lean,
       .search = "v/(m/s)",
       .no_steps = kSearch},
      {.name = "E3-rocking",
       .readings = lean_rad,
       .read = lean,
       .exact = rocked_back,
       .no_steps = kLocated},
      {.name = "E7-rod",
       .readings = {"v along the floor [m/s]"},
       .read = velocity<1, 0>,
       .runs = {"μ = 0.3", "0.8", "1.2", "1.3", "1.4", "2"},
       .no_steps = kCounted},
  };
}

}  // namespace twinarm::compare_page::contact_look
