// E3: a block 0.2 m wide and 0.5 m high topples. Planar motion; depth 0.3 m.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

constexpr double kWidth = 0.2, kHeight = 0.5, kMass = 1;

ContactScene::Body block(double mu, double width = kWidth) {
  return {Box{{width, 0.3, kHeight}}, surface(mu), kMass, {0, 0, kHeight / 2}};
}
double tilt(const ContactScene& scene, int body) {
  return std::acos(std::min(1.0, scene.R(body)(2, 2)));
}
// Whether a block at rest on an incline topples within 1 s. Just above the limit the inclination
// grows as cosh(5.2 t): to 0.01 rad at an incline of 1e-4 rad beyond the limit.
bool topples(double incline, double mu, double width) {
  ContactScene scene(tilted_gravity(incline));
  const int body = scene.start_on_floor(block(mu, width));
  scene.run(1, kStep);
  return tilt(scene, body) > 0.01;
}

CaseResult tilt_limit(double scale) {  // width
  const double limit = threshold(15 * kDegree, 30 * kDegree, 1e-4, [scale](double angle) {
    return topples(angle, 1, scale * kWidth);
  });
  return {relative(limit, 21.80140948635181 * kDegree)};
}
// On 30 degrees it slides for mu < 0.577; friction topples it for mu > b/h.
CaseResult slide_or_topple(double scale) {  // width
  const double limit = threshold(
      0.3, 0.5, 1e-4, [scale](double mu) { return topples(30 * kDegree, mu, scale * kWidth); });
  return {relative(limit, 0.4)};
}

// A force along x at the centre of the upper face.
CaseResult push_limit(double scale) {  // width
  const double limit = threshold(0.1, 0.3, 1e-4, [scale](double part) {
    ContactScene scene;
    const int body = scene.start_on_floor(block(1, scale * kWidth));
    scene.apply([F = Vector3(part * kMass * kGravity, 0, 0), dof = scene.model().iv[1]](
                    const auto&, const Kinematics& k, Forces<double>& forces) {
      const Vector3 arm = k.X_WL[1].R * Vector3(0, 0, kHeight / 2);
      const Vector3 torque = k.X_WL[1].R.transpose() * arm.cross(F);  // in the body's axes
      for (std::size_t i = 0; i < 3; ++i) {
        forces.tau[dof + i] += torque[static_cast<Eigen::Index>(i)];
        forces.tau[dof + 3 + i] += F[static_cast<Eigen::Index>(i)];
      }
    });
    scene.run(1, kStep);
    return tilt(scene, body) > 0.01;
  });
  return {relative(limit, 0.2)};
}

// Slides without friction into a curb 2 mm high: it rotates about its lower edge there (plastic
// impact), and topples over it if it is fast enough.
int start_at_curb(ContactScene& scene, double speed) {
  scene.add_floor(surface(0));
  scene.add_fixed(Box{{0.1, 1, 0.004}}, surface(0), {Matrix3::Identity(), {0.2, 0, 0}});
  ContactScene::Body body = block(0);
  body.p.x() = 0.15 - kWidth / 2 - 1e-4;
  body.v.x() = speed;
  return scene.start(body);
}
CaseResult curb_rate(double scale) {  // speed
  ContactScene scene;
  const int body = start_at_curb(scene, scale);
  scene.run(2e-3, kStep);
  return {relative(scene.w(body).y(), 2.586206896551724)};
}
CaseResult curb_speed(double scale) {  // speed
  const double limit = threshold(0.5, 1.0, 1e-4, [scale](double speed) {
    ContactScene scene;
    const int body = start_at_curb(scene, scale * speed);
    scene.run(1.5, kStep);
    return tilt(scene, body) > 30 * kDegree;
  });
  return {relative(limit, 0.7644624638064581)};
}

// Housner: inclined by 0.1 rad, the block falls back and rotates about the other edge. The ratio of
// the kinetic energies after and before the impact is that of the potential energies at the
// extremes: m g R (cos(alpha - lean) - cos alpha).
CaseResult rocking(double scale) {  // width
  constexpr double kLean = 0.1;
  const double half = scale * kWidth / 2;
  ContactScene scene;
  ContactScene::Body body = block(1, 2 * half);
  body.R = rotation_about(Vector3::UnitY(), kLean);
  body.p = Vector3(half, 0, 0) - body.R * Vector3(half, 0, -kHeight / 2);
  const int number = scene.start_on_floor(body);
  scene.locate_events();
  // Largest inclination to the other side.
  const double back = scene.max_until(0.3, kStep, [&] { return -scene.R(number)(0, 2); });
  const double alpha = std::atan(kWidth / kHeight);
  const auto lift = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
  return {relative(lift(std::asin(back)) / lift(kLean), 0.629013079667063)};
}

// ---- plots ----

// After the impact at the height that the remaining kinetic energy reaches.
double exact_rocking(std::size_t, double t) {
  const double alpha = std::atan(0.4), height = std::cos(alpha);
  const double lift = 0.629013079667063 * (std::cos(alpha - 0.1) - height);
  return t < 0.2 ? NAN : std::acos(lift + height) - alpha;
}

}  // namespace

CaseFamily toppling_cases() {
  const auto read_lean = [](Scene s) { return Values{std::atan2(s.R(1)(0, 2), s.R(1)(2, 2))}; };
  const Plot lean{{"inclination [rad]"}, read_lean};
  const auto exact_rate = [](std::size_t, double) { return 2.586206896551724; };
  return {
      230,
      {contact_case<tilt_limit, 20>("E3-tilt", 0.01, lean.searching("α/rad")),
       contact_case<push_limit, 20>("E3-push", 0.01, lean.searching("F/(m g)")),
       contact_case<slide_or_topple, 20>("E3-slide", 0.01, lean.searching("μ")),
       contact_case<curb_rate, 20>(
           "E3-curb", 0.01,
           Plot{{"rate [rad/s]"}, spin<1>, exact_rate}
               .with(&Plot::known_at, 2e-3)
               .without_convergence("A plastic impact takes two steps: the rate is read after the "
                                    "second, and gravity acts in between.")),
       contact_case<curb_speed, 20>("E3-over", 0.01, lean.searching("v/(m/s)")),
       contact_case<rocking, 20>(
           "E3-rocking", 0.01,
           lean.with(&Plot::exact, exact_rocking).without_convergence(kLocated))}};
}

}  // namespace twinarm
