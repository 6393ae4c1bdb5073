// Bodies that spin on a floor: coin (E8), tippe-top (E9), rattleback (E10).
#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

// A thin disc that rolls round on its rim, leaning by 10 degrees, its centre at rest:
// W^2 = 4 g / (R sin a); its angular velocity W sin a points from the contact to the centre.
// Rolling so fast in a curve, it loses energy in first order of a fixed step; so events are
// located.
CaseResult coin(double off) {  // gravity
  constexpr double R = 0.0375, kThick = 1e-5, kLean = 10 * kDegree;
  const double rate = std::sqrt(4 * kGravity * std::sin(kLean) / R);
  ContactScene scene(off);
  scene.add_floor(surface(1));
  ContactScene::Body disc{Cylinder{R, kThick}, surface(1), 0.01};
  disc.R = turn_about(Vector3::UnitY(), kLean);
  disc.p = {0, 0, R * std::sin(kLean) + 0.5 * kThick * std::cos(kLean)};
  disc.w = -rate * disc.R.col(0);
  disc.inertia = 0.01 * R * R * Vector3(0.25, 0.25, 0.5).asDiagonal().toDenseMatrix();
  const int body = scene.add(disc);
  scene.start();
  scene.locate_events();
  double astray = 0;
  while (scene.t() < 1) {
    scene.step(1e-3);
    astray = std::max(astray, (scene.p(body) - disc.p).norm() / R);
  }
  return {astray, scene.drift()};
}
// A sphere whose centre of mass lies 3 mm below its middle, leaning by 0.1 rad. Spun about the
// vertical it turns over.
struct Top {
  double jellett = 0, lowest_cosine = 1;
};
// The offset and the spin may be off what Jellett's integral and the start know.
Top tippe_top(double offset_off, double spin_off) {
  constexpr double R = 0.015, kOffset = 0.003, kMass = 0.006, kFineStep = 1e-4;
  ContactScene scene;
  scene.add_floor(surface(0.1));
  ContactScene::Body top{Sphere{R}, surface(0.1), kMass};
  top.shape_at = {0, 0, offset_off * kOffset};
  const Vector3 moments = 0.4 * kMass * R * R * Vector3(1, 1, 1);
  top.inertia = moments.asDiagonal();
  top.R = turn_about(Vector3::UnitY(), 0.1);
  top.p = Vector3(0, 0, R) - top.R * top.shape_at;
  top.w = {0, 0, 155 * spin_off};
  const int body = scene.add(top);
  scene.start();
  const auto jellett = [&] {
    const Matrix3 turn = scene.R(body);
    const Vector3 L = turn * moments.asDiagonal() * turn.transpose() * scene.w(body);
    return -L.dot(turn * Vector3(0, 0, kOffset) - R * Vector3::UnitZ());
  };
  const double start = jellett();
  Top result;
  while (scene.t() < 4) {
    scene.step(kFineStep);
    result.jellett = std::max(result.jellett, relative(jellett(), start));
    result.lowest_cosine = std::min(result.lowest_cosine, scene.R(body)(2, 2));
  }
  return result;
}
CaseResult jellett(double off) {  // the offset of the centre of mass
  return {tippe_top(off, 1).jellett};
}
CaseResult turns_over(double off) {  // spin
  return {tippe_top(1, off).lowest_cosine < -0.9 ? 0.0 : 1.0};
}

// An ellipsoid whose principal axes of inertia lie askew to those of its shape. Rolls from a spin
// about its own z axis, leaning by half a degree.
struct Rattle {
  double reversal = INFINITY, drift = 0;  // first time at which the spin has turned round [s]
};
int add_rattleback(ContactScene& scene, double spin, double askew) {
  constexpr double kLean = 0.5 * kDegree;
  const Vector3 semi(0.2, 0.03, 0.02);
  scene.add_floor(surface(1));
  ContactScene::Body stone{Ellipsoid{semi}, surface(1), 1};
  stone.shape_at = {0, 0, 0.01};
  stone.inertia << 2e-4, -2e-5 * askew, 0, -2e-5 * askew, 1.6e-3, 0, 0, 0, 1.7e-3;
  stone.R = turn_about(Vector3::UnitX(), kLean);
  const Vector3 n = stone.R.transpose().col(2);
  const Vector3 squares = semi.cwiseProduct(semi);
  const Vector3 reach = squares.cwiseProduct(n) / std::sqrt(n.dot(squares.cwiseProduct(n)));
  const Vector3 to_contact = stone.R * (stone.shape_at - reach);
  stone.p = {0, 0, -to_contact.z()};
  stone.w = spin * stone.R.col(2);
  stone.v = -stone.w.cross(to_contact);
  const int body = scene.add(stone);
  scene.start();
  return body;
}
Rattle rattleback(double spin, double duration, double askew) {
  constexpr double kFineStep = 1e-4;
  ContactScene scene;
  const int body = add_rattleback(scene, spin, askew);
  Rattle result;
  while (scene.t() < duration && std::isinf(result.reversal)) {
    scene.step(kFineStep);
    if (scene.w(body).z() * spin < 0) result.reversal = scene.t();
  }
  result.drift = scene.drift();
  return result;
}
CaseResult reversal(double off) {  // Ixy
  const Rattle stone = rattleback(-5, 10, off);
  return {relative(stone.reversal, 4.156), stone.drift};
}
// Rolling loses nothing where events are located: the spin after it has turned round.
CaseResult spin_after(double off) {  // Ixy
  ContactScene scene;
  const int body = add_rattleback(scene, -5, off);
  scene.locate_events();
  scene.run(5, 5e-3);
  return {relative(scene.w(body).z(), 1.80929591321873), scene.drift()};
}
CaseResult no_reversal(double off) {  // Ixy: its mistake is of the other hand
  return {std::isinf(rattleback(5, 20, off).reversal) ? 0.0 : 1.0};
}

// ---- what a page draws of them ----

Values seen_jellett(Scene s) {
  return {-s.w(1).dot(0.003 * s.R(1).col(2) - 0.015 * Vector3::UnitZ())};
}

}  // namespace

CaseFamily spinning_cases() {
  return {260,
          {contact_case<coin, 20>(
               "E8", 1e-3,
               {.readings = {"off its place [m]"},
                .read = [](Scene s) { return Values{std::hypot(s.p(1).x(), s.p(1).y())}; },
                .exact = zero,
                .until = 0.2,
                .no_steps = kLocated}),
           contact_case<jellett, 10>("E9-jellett", 1e-4,
                                     {.readings = {"change of J / I [m/s]"},
                                      .read = seen_jellett,
                                      .exact = zero,
                                      .from_start = true,
                                      .step = 1e-4}),
           contact_case<turns_over, -500>("E9-over", 0,
                                          {.readings = {"cos of the lean [1]"},
                                           .read = [](Scene s) { return Values{s.R(1)(2, 2)}; },
                                           .no_steps = kCounted}),
           contact_case<reversal, 200>(
               "E10-time", 0.05,
               {.readings = {"spin [rad/s]"},
                .read = [](Scene s) { return Values{s.w(1).z()}; },
                .exact = [](std::size_t, double t) { return t == 4.156 ? 0. : NAN; },
                .known_at = 4.156,
                .step = 1e-4,
                .about_steps = "It falls from 0.1 ms on, nearly by half as the step halves. "
                               "With longer steps rolling loses so much that the stone "
                               "hardly rattles; with located events it is 7e-5 (E10-spin)."}),
           contact_case<spin_after, 1>(
               "E10-spin", 1e-7,
               {.readings = {"spin [rad/s]"},
                .read = [](Scene s) { return Values{s.w(1).z()}; },
                .exact = [](std::size_t, double t) { return t == 5 ? 1.80929591321873 : NAN; },
                .known_at = 5,
                .no_steps = kLocated}),
           contact_case<no_reversal, -2000>("E10-other", 0,
                                            {.readings = {"spin [rad/s]"},
                                             .read = [](Scene s) { return Values{s.w(1).z()}; },
                                             .until = 6,
                                             .no_steps = kCounted})}};
}

}  // namespace twinarm
