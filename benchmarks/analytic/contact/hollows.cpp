// E12: rolling in a bowl, in a trough, on a turntable and in an upright tube.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

// Angular frequency of swings, from the values of `along`, time or an angle, at which `reading`
// passes zero.
template <class Reading, class Along>
double frequency(ContactScene& scene, double duration, Reading&& reading, Along&& along) {
  double before = reading(), at = along(), first = 0, last = 0;
  int passes = 0;
  while (scene.t() < duration) {
    scene.step(kStep);
    const double now = reading(), here = along();
    if (before * now < 0) {
      last = here - (here - at) * now / (now - before);
      if (passes++ == 0) first = last;
    }
    before = now, at = here;
  }
  return (passes - 1) * std::numbers::pi / (last - first);
}

double angle_between(const Vector3& a, const Vector3& b) {  // about z
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

CaseResult bowl(const Shape& hollow, const Shape& shape, double reference, double gravity) {
  constexpr double kAngle = 0.02, kArm = 1 - kBallRadius;
  const Matrix3 R = std::holds_alternative<CylindricalCavity>(hollow)
                        ? axis_along_y()
                        : Matrix3(Matrix3::Identity());
  ContactScene scene(gravity);
  scene.add_fixed(hollow, surface(1), {R, Vector3::Zero()});
  const int body = scene.start(
      {shape, surface(1), 1, {kArm * std::sin(kAngle), 0, -kArm * std::cos(kAngle)}, {}, {}, R});
  const double found = frequency(
      scene, 12, [&] { return scene.p(body).x(); }, [&] { return scene.t(); });
  return {relative(found, reference), scene.drift()};
}
CaseResult sphere_in_bowl(double scale) {  // gravity
  return bowl(SphericalCavity{1}, Sphere{kBallRadius}, 2.79028928352, scale);
}
CaseResult sphere_in_trough(double scale) {  // gravity
  return bowl(CylindricalCavity{1, 1}, Sphere{kBallRadius}, 2.79028928352, scale);
}
CaseResult cylinder_in_trough(double scale) {  // gravity
  return bowl(CylindricalCavity{1, 1}, Cylinder{kBallRadius, 0.3}, 2.69567554922, scale);
}

// Starts at r_0 with the table's velocity there, W x r_0, and without spin. From v' = (2/7) W x v
// the centre moves on a circle at 2/7 of the table's rate, about r_0 - (7/2) r_0.
struct Circle {
  double period, error;  // [s], [of the radius]
};
Circle turntable(double h, double scale, Steps steps = Steps::fixed) {
  constexpr double W = 2, kStart = 0.2;
  ContactScene scene;
  scene.add_rotating(Cylinder{3, 0.2}, surface(1), {Matrix3::Identity(), {0, 0, -0.1}}, scale * W);
  ContactScene::Body ball{Sphere{kBallRadius}, surface(1), 1, {kStart, 0, kBallRadius}};
  ball.v = {0, W * kStart, 0};
  const int body = scene.start(ball);
  if (steps == Steps::located) scene.locate_events();
  double angle_of_v = 0, error = 0;
  Vector3 last = ball.v;
  while (angle_of_v < 2 * std::numbers::pi && scene.t() < 15) {
    scene.step(h);
    const Vector3 v = scene.v(body);
    angle_of_v += angle_between(last, v);
    last = v;
    const double angle = 2 / 7.0 * W * scene.t();
    const Vector3 wanted(kStart * (3.5 * std::cos(angle) - 2.5), kStart * 3.5 * std::sin(angle),
                         kBallRadius);
    error = std::max(error, (scene.p(body) - wanted).norm() / (3.5 * kStart));
  }
  return {scene.t() * 2 * std::numbers::pi / angle_of_v, error};
}
CaseResult turntable_period(double scale) {  // rate of the table
  return with_order(
      [scale](double h) { return relative(turntable(h, scale).period, 3.5 * std::numbers::pi); },
      kStep);
}
CaseResult turntable_circle(double scale) {  // rate of the table
  return {turntable(0.01, scale, Steps::located).error};
}

// Rolls round in an upright tube, fast enough not to slip: its height oscillates at sqrt(2/7) of
// the rate at which it circles. Fixed steps lose a fifth of that rate in 6 s; so events are
// located.
CaseResult upright_tube(double scale) {  // inertia
  constexpr double kArm = 0.5 - kBallRadius, kRate = 12;
  ContactScene scene;
  scene.add_fixed(CylindricalCavity{0.5, 4}, surface(2));
  ContactScene::Body ball{Sphere{kBallRadius}, surface(2), 1, {kArm, 0, 0}};
  ball.inertia = scale * 0.4 * kBallRadius * kBallRadius * Matrix3::Identity();
  ball.v = {0, kArm * kRate, 0};
  ball.w = {0, 0, -kArm * kRate / kBallRadius};
  const int body = scene.start(ball);
  scene.locate_events();
  double azimuth = 0;
  Vector3 p = scene.p(body);
  const auto circled = [&] {
    azimuth += angle_between(std::exchange(p, scene.p(body)), scene.p(body));
    return azimuth;
  };
  const double found = frequency(
      scene, 3, [&] { return scene.v(body).z(); }, circled);
  return {relative(found, std::sqrt(2 / 7.0)), scene.drift()};
}

// ---- plots ----

constexpr const char* kSmallSwings =
    "The error does not fall: the formula holds for small swings; swings of 0.02 rad are slower by "
    "0.02²/16 = 2.5e-5.";
double exact_circle(std::size_t k, double t) {
  const double angle = 4 / 7.0 * t;
  return 0.2 * (k == 0 ? 3.5 * std::cos(angle) - 2.5 : 3.5 * std::sin(angle));
}
double exact_swing(double rate, double t) {
  return 0.9 * std::sin(0.02 * std::cos(rate * t));
}
double exact_sphere_swing(std::size_t, double t) {
  return exact_swing(std::sqrt(5 * kGravity / (7 * 0.9)), t);
}
// From v_z'' = -(2/7) W^2 v_z with v_z'(0) = -(5/7) g.
double exact_tube(std::size_t, double t) {
  const double rate = std::sqrt(2 / 7.) * 12;
  return -5 / 7. * kGravity / (rate * rate) * (1 - std::cos(rate * t));
}
double exact_cylinder_swing(std::size_t, double t) {
  return exact_swing(std::sqrt(2 * kGravity / (3 * 0.9)), t);
}

}  // namespace

CaseFamily hollows_cases() {
  const Plot sphere = Plot{{"x [m]"}, place<1, 0>, exact_sphere_swing}
                          .with(&Plot::until, 6)
                          .with(&Plot::convergence_note, kSmallSwings);
  const Plot cylinder = sphere.with(&Plot::exact, exact_cylinder_swing);
  const auto read_ball = [](Scene s) { return Values{s.p(2).x(), s.p(2).y()}; };
  const Plot circle{{"x [m]", "y [m]"}, read_ball, exact_circle};
  const Plot located = circle.with(&Plot::until, 5.5).without_convergence(kLocated);
  return {280,
          {contact_case<sphere_in_bowl, 5>("E12-bowl", 1e-3, sphere),
           contact_case<sphere_in_trough, 5>("E12-trough", 1e-3, sphere),
           contact_case<cylinder_in_trough, 5>("E12-cylinder", 1e-3, cylinder),
           contact_case<turntable_period, 2>("E12-turntable", 1e-3, circle),
           contact_case<turntable_circle, 1>("E12-circle", 1e-9, located),
           contact_case<upright_tube, 10>(
               "E12-tube", 1e-9,
               Plot{{"height [m]"}, place<1, 2>, exact_tube}.without_convergence(kLocated))}};
}

}  // namespace twinarm
