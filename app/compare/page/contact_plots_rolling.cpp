// Rolling, spinning, standing: E4, E8 to E14.
#include <algorithm>

#include "app/compare/page/contact_readings.h"

namespace twinarm::compare_page::contact_look {
namespace {

constexpr double kRollSlope = 20 * kDegree;
constexpr const char* kSmallSwings =
    "It does not fall: the formula is that of small swings, and those of 0.02 rad are slower by "
    "0.02²/16 = 2.5e-5.";

Values slip(Scene s) {
  return {s.v(1).x() - 0.1 * s.w(1).y()};
}
Values friction(Scene s) {
  return {s.t() == 0 ? NAN : -s.force(1).x()};
}
// Forces under boxes that stand on each other.
template <int... boxes>
Values loads(Scene s) {
  const auto under = [&](int box) {
    double sum = s.t() == 0 ? NAN : 0;
    for (const ContactPoint& point : s.contacts().points())
      if (std::max(s.contacts().geometry(point.contact.a).body,
                   s.contacts().geometry(point.contact.b).body) == box)
        sum += std::abs(point.force_W.z());
    return sum;
  };
  return {under(boxes)...};
}
Values jellett_per_inertia(Scene s) {
  return {-s.w(1).dot(0.003 * s.R(1).col(2) - 0.015 * Vector3::UnitZ())};
}
Values ball_on_table(Scene s) {
  return {s.p(2).x(), s.p(2).y()};
}
double rolling_speed(std::size_t run, double t) {
  constexpr double kInertia[] = {0.4, 0.5, 1};
  return kGravity * std::sin(kRollSlope) / (1 + kInertia[run]) * t;
}
double slipping(std::size_t k, double t) {
  const double rub = 0.05 * std::cos(kRollSlope);
  return kGravity * t * (k == 0 ? std::sin(kRollSlope) - rub : 2.5 * rub);
}
double circle(std::size_t k, double t) {
  const double angle = 4 / 7.0 * t;
  return 0.2 * (k == 0 ? 3.5 * std::cos(angle) - 2.5 : 3.5 * std::sin(angle));
}
double swing(double rate, double t) {
  return 0.9 * std::sin(0.02 * std::cos(rate * t));
}
double sphere_swing(std::size_t, double t) {
  return swing(std::sqrt(5 * kGravity / (7 * 0.9)), t);
}
// From v_z'' = -(2/7) W^2 v_z, and v_z' = -(5/7) g at the start.
double tube_height(std::size_t, double t) {
  const double rate = std::sqrt(2 / 7.) * 12;
  return -5 / 7. * kGravity / (rate * rate) * (1 - std::cos(rate * t));
}
double cylinder_swing(std::size_t, double t) {
  return swing(std::sqrt(2 * kGravity / (3 * 0.9)), t);
}

}  // namespace

std::vector<ContactLook> rolling() {
  const std::vector<std::string> xy = {"x [m]", "y [m]"};
  return {
      {.name = "E4-speeds",
       .readings = {"speed [m/s]"},
       .read = velocity<1, 0>,
       .exact = rolling_speed,
       .runs = {"sphere", "disc", "hoop"}},
      {.name = "E4-friction",
       .readings = {"friction [N]"},
       .read = friction,
       .exact = [](std::size_t, double) { return 0.9586336017213744; }},
      {.name = "E4-threshold",
       .readings = {"slip [m/s]"},
       .read = slip,
       .search = "μ",
       .no_steps = kSearch},
      {.name = "E4-slip",
       .readings = {"v of the centre [m/s]", "R ω [m/s]"},
       .read = speed_and_rim<1000>,
       .exact = slipping},
      {.name = "E4-small",
       .readings = {"speed [m/s]"},
       .read = velocity<1, 0>,
       .exact = [](std::size_t,
                   double t) { return 5 / 7. * kGravity * std::sin(15 * kDegree) * t; }},
      {.name = "E12-bowl",
       .readings = {"x [m]"},
       .read = place<1, 0>,
       .exact = sphere_swing,
       .until = 6,
       .about_steps = kSmallSwings},
      {.name = "E12-trough",
       .readings = {"x [m]"},
       .read = place<1, 0>,
       .exact = sphere_swing,
       .until = 6,
       .about_steps = kSmallSwings},
      {.name = "E12-cylinder",
       .readings = {"x [m]"},
       .read = place<1, 0>,
       .exact = cylinder_swing,
       .until = 6,
       .about_steps = kSmallSwings},
      {.name = "E12-turntable", .readings = xy, .read = ball_on_table, .exact = circle},
      {.name = "E12-circle",
       .readings = xy,
       .read = ball_on_table,
       .exact = circle,
       .until = 5.5,
       .no_steps = kLocated},
      {.name = "E12-tube",
       .readings = {"height [m]"},
       .read = place<1, 2>,
       .exact = tube_height,
       .no_steps = kLocated},
      {.name = "E8",
       .readings = {"off its place [m]"},
       .read = [](Scene s) { return Values{std::hypot(s.p(1).x(), s.p(1).y())}; },
       .exact = zero,
       .until = 0.2,
       .no_steps = kLocated},
      {.name = "E9-jellett",
       .readings = {"change of J / I [m/s]"},
       .read = jellett_per_inertia,
       .exact = zero,
       .from_start = true,
       .step = 1e-4},
      {.name = "E9-over",
       .readings = {"cos of the lean [1]"},
       .read = [](Scene s) { return Values{s.R(1)(2, 2)}; },
       .no_steps = kCounted},
      {.name = "E10-time",
       .readings = {"spin [rad/s]"},
       .read = [](Scene s) { return Values{s.w(1).z()}; },
       .exact = [](std::size_t, double t) { return t == 4.156 ? 0. : NAN; },
       .known_at = 4.156,
       .step = 1e-4,
       .about_steps =
           "It falls from 0.1 ms on, nearly by half as the step halves. With longer steps rolling "
           "loses "
           "so "
           "much that the stone hardly rattles; with located events it is 7e-5 (E10-spin)."},
      {.name = "E10-spin",
       .readings = {"spin [rad/s]"},
       .read = [](Scene s) { return Values{s.w(1).z()}; },
       .exact = [](std::size_t, double t) { return t == 5 ? 1.80929591321873 : NAN; },
       .known_at = 5,
       .no_steps = kLocated},
      {.name = "E10-other",
       .readings = {"spin [rad/s]"},
       .read = [](Scene s) { return Values{s.w(1).z()}; },
       .until = 6,
       .no_steps = kCounted},
  };
}

std::vector<ContactLook> buildings() {
  return {
      {.name = "E11-forces",
       .readings = {"under box 1 [N]", "under box 5 [N]", "under box 10 [N]"},
       .read = loads<1, 5, 10>,
       .exact = [](std::size_t k, double) { return kGravity * (k == 0   ? 10
                                                               : k == 1 ? 6
                                                                        : 1); },
       .until = 1,
       .no_steps = kResting},
      {.name = "E11-drift",
       .readings = {"x of the top box [m]"},
       .read = place<10, 0>,
       .exact = zero,
       .until = 1,
       .from_start = true,
       .no_steps = kResting},
      {.name = "E11-sinking",
       .readings = {"z of the top box [m]"},
       .read = place<10, 2>,
       .exact = zero,
       .until = 1,
       .from_start = true,
       .no_steps = kResting},
      {.name = "E11-heavy",
       .readings = {"under 1 kg [N]", "under 100 kg [N]"},
       .read = loads<1, 2>,
       .exact = [](std::size_t k, double) { return kGravity * (k == 0 ? 101 : 100); },
       .no_steps = kResting},
      {.name = "E13-stands",
       .readings = {"z of the crown [m]"},
       .read = place<10, 2>,
       .exact = zero,
       .from_start = true,
       .no_steps = kResting},
      {.name = "E13-falls",
       .readings = {"z of the crown [m]"},
       .read = place<10, 2>,
       .from_start = true,
       .no_steps = kCounted},
      {.name = "E13-limit",
       .readings = {"z of the crown [m]"},
       .read = place<10, 2>,
       .from_start = true,
       .search = "t/R",
       .no_steps = kSearch},
      {.name = "E14",
       .readings = {"z of the wedge [m]"},
       .read = place<2, 2>,
       .from_start = true,
       .search = "μ",
       .no_steps = kSearch},
  };
}

}  // namespace twinarm::compare_page::contact_look
