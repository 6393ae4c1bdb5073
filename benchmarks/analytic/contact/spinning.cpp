// Bodies that spin on a floor: coin (E8), tippe-top (E9), rattleback (E10).
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

// A thin disc rolls on its rim, inclined by a = 10 degrees, with its centre at rest:
// W^2 = 4 g / (R sin a); its angular velocity W sin a points from the contact to the centre. A
// fixed step loses energy at first order in such rolling; so events are located.
CaseResult coin(double scale) {  // gravity
  constexpr double R = 0.0375, kThick = 1e-5, kLean = 10 * kDegree;
  const double rate = std::sqrt(4 * kGravity * std::sin(kLean) / R);
  ContactScene scene(scale);
  ContactScene::Body disc{Cylinder{R, kThick}, surface(1), 0.01};
  disc.R = rotation_about(Vector3::UnitY(), kLean);
  disc.p = {0, 0, R * std::sin(kLean) + 0.5 * kThick * std::cos(kLean)};
  disc.w = -rate * disc.R.col(0);
  disc.inertia = 0.01 * R * R * Vector3(0.25, 0.25, 0.5).asDiagonal().toDenseMatrix();
  const int body = scene.start_on_floor(disc);
  scene.locate_events();
  const double error =
      scene.max_until(1, kStep, [&] { return (scene.p(body) - disc.p).norm() / R; });
  return {error, scene.drift()};
}
// A sphere whose centre of mass lies 3 mm below its middle, inclined by 0.1 rad. A spin about the
// vertical inverts it.
struct Top {
  double jellett = 0, min_cosine = 1;
};
// Mutants: the simulated top has another offset, or another spin.
Top tippe_top(double offset_scale, double spin_scale) {
  constexpr double R = 0.015, kOffset = 0.003, kMass = 0.006, kFineStep = 1e-4;
  ContactScene scene;
  ContactScene::Body top{Sphere{R}, surface(0.1), kMass};
  top.shape_at = {0, 0, offset_scale * kOffset};
  const Vector3 moments = 0.4 * kMass * R * R * Vector3(1, 1, 1);
  top.inertia = moments.asDiagonal();
  top.R = rotation_about(Vector3::UnitY(), 0.1);
  top.p = Vector3(0, 0, R) - top.R * top.shape_at;
  top.w = {0, 0, 155 * spin_scale};
  const int body = scene.start_on_floor(top);
  const auto jellett = [&] {
    const Matrix3 R_WL = scene.R(body);
    const Vector3 L = R_WL * moments.asDiagonal() * R_WL.transpose() * scene.w(body);
    return -L.dot(R_WL * Vector3(0, 0, kOffset) - R * Vector3::UnitZ());
  };
  const double start = jellett();
  Top result;
  while (scene.t() < 4) {
    scene.step(kFineStep);
    result.jellett = std::max(result.jellett, relative(jellett(), start));
    result.min_cosine = std::min(result.min_cosine, scene.R(body)(2, 2));
  }
  return result;
}
CaseResult jellett(double scale) {  // offset of the centre of mass
  return {tippe_top(scale, 1).jellett};
}
CaseResult inversion(double scale) {  // spin
  return {tippe_top(1, scale).min_cosine < -0.9 ? 0.0 : 1.0};
}

// An ellipsoid whose principal axes of inertia are rotated against those of its shape. Rolls from a
// spin about its own z axis, inclined by half a degree.
struct Rattle {
  double reversal = INFINITY, drift = 0;  // time at which the spin changes its sign [s]
};
int add_rattleback(ContactScene& scene, double spin, double Ixy_scale) {
  constexpr double kLean = 0.5 * kDegree;
  const Vector3 semi(0.2, 0.03, 0.02);
  ContactScene::Body stone{Ellipsoid{semi}, surface(1), 1};
  stone.shape_at = {0, 0, 0.01};
  const double Ixy = -2e-5 * Ixy_scale;
  stone.inertia << 2e-4, Ixy, 0, Ixy, 1.6e-3, 0, 0, 0, 1.7e-3;
  stone.R = rotation_about(Vector3::UnitX(), kLean);
  const Vector3 n = stone.R.transpose().col(2);
  const Vector3 squares = semi.cwiseProduct(semi);
  const Vector3 reach = squares.cwiseProduct(n) / std::sqrt(n.dot(squares.cwiseProduct(n)));
  const Vector3 to_contact = stone.R * (stone.shape_at - reach);
  stone.p = {0, 0, -to_contact.z()};
  stone.w = spin * stone.R.col(2);
  stone.v = -stone.w.cross(to_contact);
  return scene.start_on_floor(stone);
}
Rattle rattleback(double spin, double duration, double Ixy_scale) {
  constexpr double kFineStep = 1e-4;
  ContactScene scene;
  const int body = add_rattleback(scene, spin, Ixy_scale);
  Rattle result;
  while (scene.t() < duration && std::isinf(result.reversal)) {
    scene.step(kFineStep);
    if (scene.w(body).z() * spin < 0) result.reversal = scene.t();
  }
  result.drift = scene.drift();
  return result;
}
CaseResult reversal(double scale) {  // Ixy
  const Rattle stone = rattleback(-5, 10, scale);
  return {relative(stone.reversal, 4.156), stone.drift};
}
// With located events rolling loses no energy: the spin after the reversal.
CaseResult spin_after(double scale) {  // Ixy
  ContactScene scene;
  const int body = add_rattleback(scene, -5, scale);
  scene.locate_events();
  scene.run(5, 5e-3);
  return {relative(scene.w(body).z(), 1.80929591321873), scene.drift()};
}
CaseResult no_reversal(double scale) {  // Ixy: the mutant has the opposite chirality
  return {std::isinf(rattleback(5, 20, scale).reversal) ? 0.0 : 1.0};
}

}  // namespace

CaseFamily spinning_cases() {
  const auto read_jellett = [](Scene s) {
    return Values{-s.w(1).dot(0.003 * s.R(1).col(2) - 0.015 * Vector3::UnitZ())};
  };
  const auto read_cosine = [](Scene s) { return Values{s.R(1)(2, 2)}; };
  const Plot stone{{"spin [rad/s]"}, spin<2>};
  const auto at_reversal = [](std::size_t, double t) { return t == 4.156 ? 0. : NAN; };
  const auto at_end = [](std::size_t, double t) { return t == 5 ? 1.80929591321873 : NAN; };
  return {
      260,
      {contact_case<coin, 20>("E8", 1e-3,
                              Plot{{"distance from the start [m]"}, horizontal_distance, zero}
                                  .with(&Plot::until, 0.2)
                                  .without_convergence(kLocated)),
       contact_case<jellett, 10>("E9-jellett", 1e-4,
                                 Plot{{"change of J / I [m/s]"}, read_jellett, zero}
                                     .with(&Plot::from_start, true)
                                     .with(&Plot::step, 1e-4)),
       contact_case<inversion, -500>(
           "E9-over", 0,
           Plot{{"cos of the inclination [1]"}, read_cosine}.without_convergence(kCounted)),
       contact_case<reversal, 200>(
           "E10-time", 0.05,
           stone.with(&Plot::exact, at_reversal)
               .with(&Plot::known_at, 4.156)
               .with(&Plot::step, 1e-4)
               .with(&Plot::convergence_note,
                     "The error falls below 0.1 ms, nearly by half as the step halves. With "
                     "longer steps rolling loses so much energy that the stone hardly rattles; "
                     "with located events it is 7e-5 (E10-spin).")),
       contact_case<spin_after, 1>(
           "E10-spin", 1e-7,
           stone.with(&Plot::exact, at_end).with(&Plot::known_at, 5).without_convergence(kLocated)),
       contact_case<no_reversal, -2000>(
           "E10-other", 0, stone.with(&Plot::until, 6).without_convergence(kCounted))}};
}

}  // namespace twinarm
