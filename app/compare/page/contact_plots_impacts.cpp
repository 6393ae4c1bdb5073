// Impacts: E1, E6, E16, E17.
#include <algorithm>

#include "app/compare/page/contact_readings.h"

namespace twinarm::compare_page::contact_look {
namespace {

// Body by body, from 1 on.
template <int body>
Values height_above_radius(Scene s) {
  return {s.p(body).z() - 0.1};
}
Values momentum(Scene s) {
  double sum = 0;
  for (int i = 1; i <= 5; ++i) sum += s.v(i).x();
  return {sum};
}
// The gap of a ball that falls from 1 m.
double bouncing(double e, double t) {
  const double fall = std::sqrt(2 / kGravity);
  if (t < fall) return 1 - kGravity * t * t / 2;
  double speed = e * kGravity * fall, since = t - fall;
  while (speed > 1e-6 && since > 2 * speed / kGravity) since -= 2 * speed / kGravity, speed *= e;
  return speed > 1e-6 ? speed * since - kGravity * since * since / 2 : 0;
}
double bouncing_08(std::size_t, double t) {
  return bouncing(0.8, t);
}
// Impact n comes when all gaps before have been crossed, each at (1 + e)/2 of the speed before.
double last_of_cradle(double gap, double part, double t) {
  double speed = 1, at = 0;
  for (int i = 0; i < 4; ++i) at += gap / speed, speed *= part;
  return t < at ? 0 : speed;
}
// Routh: n = 2.5, t = 1.5, and (1 + e) v = 3 m/s.
double routh(std::size_t run, double t) {
  constexpr double kUp[] = {3 / 2.5, 3 / (2.5 - 0.3 * 1.5), 3 * 2.5 / (2.5 * 2.5 - 1.5 * 1.5)};
  return t == 0 ? -2 : t < 1e-3 ? NAN : -2 + kUp[run];
}

}  // namespace

std::vector<ContactLook> impacts() {
  const std::vector<std::string> gap = {"height of the ball [m]"}, vz = {"v upwards [m/s]"};
  const std::vector<std::string> mus = {"μ = 0.05", "μ = 0.2"}, es = {"e = 0", "0.5", "0.9", "1"};
  const std::vector<std::string> five = {"ball 1 [m/s]", "ball 2 [m/s]", "ball 3 [m/s]",
                                         "ball 4 [m/s]", "ball 5 [m/s]"};
  return {
      {.name = "E1-times",
       .readings = gap,
       .read = height_above_radius<1>,
       .exact = bouncing_08,
       .no_steps = kLocated},
      {.name = "E1-speeds",
       .readings = gap,
       .read = height_above_radius<1>,
       .exact = bouncing_08,
       .no_steps = kLocated},
      {.name = "E1-fixed",
       .readings = gap,
       .read = height_above_radius<1>,
       .exact = bouncing_08,
       .about_steps = "Flight is exact in any step. One of 0.5 ms would end 1 µm within the floor, "
                      "ends on it, 0.1 % slower, and the ball bounces in the next one."},
      {.name = "E1-rest",
       .readings = gap,
       .read = height_above_radius<1>,
       .exact = bouncing_08,
       .runs = {"located", "1 ms"},
       .no_steps = kRounding},
      {.name = "E1-energy",
       .readings = gap,
       .read = height_above_radius<1>,
       .runs = {"e = 0", "0.3", "0.5", "0.8", "0.95", "1"},
       .no_steps = kRounding},
      {.name = "E6-two",
       .readings = {"1 kg [m/s]", "3 kg [m/s]"},
       .read = velocities_x<1, 2>,
       .exact = [](std::size_t k,
                   double t) { return t < 0.025 ? (k == 0 ? 2. : 0.) : (k == 0 ? -0.4 : 0.8); }},
      {.name = "E6-cradle",
       .readings = {"speed of ball 5 [m/s]"},
       .read = velocity<5, 0>,
       .exact = [](std::size_t run,
                   double t) { return last_of_cradle(run == 0 ? 1e-4 : 1e-3, 1, t); },
       .runs = {"gaps 0.1 mm", "gaps 1 mm"},
       .until = 0.02},
      {.name = "E6-lossy",
       .readings = five,
       .read = velocities_x<1, 2, 3, 4, 5>,
       .exact = [](std::size_t k,
                   double t) { return k == 4 ? last_of_cradle(1e-3, 0.95, t) : NAN; },
       .until = 0.02,
       .about_steps = "A step of 2 ms is longer than the time between two impacts."},
      {.name = "E6-touching",
       .readings = {five[0], five[1], five[2]},
       .read = velocities_x<1, 2, 3>,
       .exact = [](std::size_t k,
                   double t) { return t == 0 ? (k == 0 ? 1. : 0.) : (k == 0 ? -1 / 3. : 2 / 3.); },
       .until = 0.02},
      {.name = "E6-momentum",
       .readings = {"momentum [kg m/s]"},
       .read = momentum,
       .exact = [](std::size_t, double) { return 1.; },
       .runs = es,
       .every = 3,
       .until = 0.1,
       .no_steps = kRounding},
      {.name = "E6-energy",
       .readings = {"speed of ball 5 [m/s]"},
       .read = velocity<5, 0>,
       .runs = es,
       .every = 3,
       .until = 0.1,
       .no_steps = kRounding},
      {.name = "E16",
       .readings = {"v along the floor [m/s]"},
       .read = velocity<1, 0>,
       .exact = [](std::size_t run, double t) { return t == 0     ? 2
                                                       : run == 0 ? 1.73
                                                                  : 10 / 7.; },
       .runs = mus,
       .until = 0.02},
      {.name = "E16-limit",
       .readings = {"slip [m/s]"},
       .read = [](Scene s) { return Values{s.v(1).x() - 0.1 * s.w(1).y()}; },
       .exact = [](std::size_t run,
                   double t) { return t == 0 ? 2 : 2 - 3.5 * (run == 0 ? 0.04 : 0.08) * 1.8 * 3; },
       .runs = {"μ = 0.04", "μ = 0.08"},
       .no_steps = "One step is one impact, whatever its length."},
      {.name = "E16-flight",
       .readings = {"v along the floor [m/s]"},
       .read = velocity<1, 0>,
       .exact = [](std::size_t run,
                   double t) { return t < 0.1 / 3 ? 2
                                      : run == 0  ? 1.73
                                                  : 10 / 7.; },
       .runs = mus},
      {.name = "E17",
       .readings = vz,
       .read = velocity<1, 2>,
       .exact = routh,
       .runs = {"μ = 0", "μ = 0.3", "μ = 1"},
       .no_steps = "One step is one impact, whatever its length."},
      {.name = "E17-energy",
       .readings = vz,
       .read = velocity<1, 2>,
       .runs = {"e = 0.5", "e = 0.8", "e = 1"},
       .no_steps = "One step is one impact, whatever its length. Drawn are the first three."},
  };
}

}  // namespace twinarm::compare_page::contact_look
