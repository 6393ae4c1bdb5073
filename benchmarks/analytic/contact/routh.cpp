// E17: a rod falls on its lower end: E. J. Routh's impact with friction, in closed form.
//
// Uniform, 1 m and 1 kg, at 45 degrees, 2 m/s downwards, e = 0.5; J M^-1 J^T = [n t; t n] below.
// If the end sticks (mu > t / n = 0.6), its tangential velocity becomes zero; else it slips, and
// the tangential impulse is mu times the normal one. The end leaves with e times its speed before.
#include "benchmarks/analytic/support/contact_scene.h"
#include "collision/geometry/convex_hull.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kRodLength = 1, kRodInertia = 1 / 12.0, kSpeed = 2, kRestitution = 0.5;

// Pointed ends, so that it touches exactly at its end.
Shape needle() {
  constexpr double kThin = 1e-3;
  std::vector<Vector3> tips;
  for (const double side : {1.0, -1.0}) {
    tips.emplace_back(0, 0, side * kRodLength / 2);
    tips.emplace_back(side * kThin, 0, 0);
    tips.emplace_back(0, side * kThin, 0);
  }
  return convex_hull(tips);
}

struct RodMotion {
  double vx, vz, w;  // of the centre of mass; about y
  double kinetic() const { return 0.5 * (vx * vx + vz * vz + kRodInertia * w * w); }
};

// The end lies s to the left of the centre and s below it; n and t are the vertical and horizontal
// responses of the end to a vertical unit impulse.
RodMotion closed_form(double mu) {
  const double s = kRodLength / 2 * std::sqrt(0.5);
  const double n = 1 + s * s / kRodInertia, t = s * s / kRodInertia;
  const double gain = (1 + kRestitution) * kSpeed;  // of the end's velocity, upwards
  const bool sticks = mu > t / n;
  const double up = sticks ? gain * n / (n * n - t * t) : gain / (n - mu * t);
  const double side = sticks ? up * t / n : mu * up;
  return {side, -kSpeed + up, s * (up - side) / kRodInertia};
}

// Rod at an angle from the vertical, with a velocity along x besides the one downwards.
RodMotion simulated(double mu, double restitution, double lean, double along, double inertia = 1) {
  ContactScene scene(Vector3::Zero());
  scene.add_floor(surface(mu, restitution));
  ContactScene::Body rod{needle(), surface(mu, 1), 1};
  rod.R = rotation_about(Vector3::UnitY(), lean);
  rod.p = rod.R * Vector3(0, 0, kRodLength / 2);
  rod.v = {along, 0, -kSpeed};
  rod.inertia = Vector3(inertia * kRodInertia, inertia * kRodInertia, 1e-6).asDiagonal();
  const int body = scene.start(rod);
  scene.step(kStep);
  if (!scene.ok()) return {NAN, NAN, NAN};
  return {scene.v(body).x(), scene.v(body).z(), scene.w(body).y()};
}

CaseResult velocities(double scale) {  // mu
  const double error = max_over({0.0, 0.3, 1.0}, [scale](double mu) {
    const RodMotion wanted = closed_form(mu);
    const RodMotion found = simulated(scale * mu, kRestitution, std::numbers::pi / 4, 0);
    return std::max({std::abs(found.vx - wanted.vx), std::abs(found.vz - wanted.vz),
                     std::abs(found.w - wanted.w) * kRodLength / 2});
  });
  return {error / kSpeed};
}
// With a velocity along the floor Newton's law could gain energy: T. R. Kane, D. A. Levinson, 1985.
CaseResult energy(double scale) {  // inertia; kinetic() uses the correct one
  double gained = 0;
  for (const double mu : {0.0, 0.1, 0.3, 0.5, 0.8, 1.2})
    for (const double lean : {0.2, 0.5, 0.8, 1.1, 1.4})
      for (const double along : {-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0})
        for (const double restitution : {0.5, 0.8, 1.0}) {
          const double before = RodMotion{along, -kSpeed, 0}.kinetic();
          const double after = simulated(mu, restitution, lean, along, scale).kinetic();
          gained = std::max(gained, std::isfinite(after) ? after / before - 1 : 1);
        }
  return {gained};
}

// ---- plots ----

// Routh: n = 2.5, t = 1.5, and (1 + e) v = 3 m/s.
double exact_rod(std::size_t run, double t) {
  constexpr double kUp[] = {3 / 2.5, 3 / (2.5 - 0.3 * 1.5), 3 * 2.5 / (2.5 * 2.5 - 1.5 * 1.5)};
  return t == 0 ? -2 : t < 1e-3 ? NAN : -2 + kUp[run];
}

}  // namespace

CaseFamily routh_cases() {
  const Plot upwards{{"v upwards [m/s]"}, velocity<1, 2>};
  return {310,
          {contact_case<velocities, 1>(
               "E17", 1e-12,
               upwards.with(&Plot::exact, exact_rod)
                   .of_runs({"μ = 0", "μ = 0.3", "μ = 1"})
                   .without_convergence("One step is one impact at any length.")),
           contact_case<energy, -1>(
               "E17-energy", 1e-10,
               upwards.of_runs({"e = 0.5", "e = 0.8", "e = 1"})
                   .without_convergence(
                       "One step is one impact at any length. The first three are drawn."))}};
}

}  // namespace twinarm
