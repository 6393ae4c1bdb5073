// A block 0.2 m wide and 0.5 m high that topples (E3). All of it is planar: depth 0.3 m.
#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

constexpr double kWidth = 0.2, kHeight = 0.5, kMass = 1;

ContactScene::Body block(double mu, double width = kWidth) {
  return {Box{{width, 0.3, kHeight}}, surface(mu), kMass, {0, 0, kHeight / 2}};
}
double tilt(const ContactScene& scene, int body) {
  return std::acos(std::min(1.0, scene.R(body)(2, 2)));
}
// On an incline, at rest: does it tip within a second? Just above the limit the lean grows like
// cosh(5.2 t), to 0.01 rad from 1e-4 rad beyond it.
bool topples(double incline, double mu, double width) {
  ContactScene scene(tilted_gravity(incline));
  scene.add_floor(surface(mu));
  const int body = scene.add(block(mu, width));
  scene.start();
  scene.run(1, kStep);
  return tilt(scene, body) > 0.01;
}

CaseResult tilt_limit(double off) {  // width
  const double limit = threshold(15 * kDegree, 30 * kDegree, 1e-4,
                                 [off](double angle) { return topples(angle, 1, off * kWidth); });
  return {relative(limit, 21.80140948635181 * kDegree)};
}
// On 30 degrees it slides for any mu below 0.577; the friction topples it above b/h.
CaseResult slide_or_topple(double off) {  // width
  const double limit = threshold(
      0.3, 0.5, 1e-4, [off](double mu) { return topples(30 * kDegree, mu, off * kWidth); });
  return {relative(limit, 0.4)};
}

// A force along x at the middle of the upper face of a free body.
class Push final : public ForceSource {
 public:
  Push(std::size_t dof, double force) : dof_(dof), force_(force) {}
  void add_forces(const State<double>&, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    const Vector3 F(force_, 0, 0), arm = k.X_WL[1].R * Vector3(0, 0, kHeight / 2);
    const Vector3 torque = k.X_WL[1].R.transpose() * arm.cross(F);  // in the body's axes
    for (std::size_t i = 0; i < 3; ++i) {
      forces.tau[dof_ + i] += torque[static_cast<Eigen::Index>(i)];
      forces.tau[dof_ + 3 + i] += F[static_cast<Eigen::Index>(i)];
    }
  }

 private:
  std::size_t dof_;
  double force_;
};
CaseResult push_limit(double off) {  // width
  const double limit = threshold(0.1, 0.3, 1e-4, [off](double part) {
    ContactScene scene;
    scene.add_floor(surface(1));
    const int body = scene.add(block(1, off * kWidth));
    scene.start();
    Push push(scene.model().iv[1], part * kMass * kGravity);
    scene.simulation().add(push);
    scene.run(1, kStep);
    return tilt(scene, body) > 0.01;
  });
  return {relative(limit, 0.2)};
}

// Slides without friction into a curb 2 mm high, which its lower edge cannot pass: it turns about
// that edge (plastic impact), and over it if it is fast.
int start_at_curb(ContactScene& scene, double speed) {
  scene.add_floor(surface(0));
  scene.add_fixed(Box{{0.1, 1, 0.004}}, surface(0), {Matrix3::Identity(), {0.2, 0, 0}});
  ContactScene::Body body = block(0);
  body.p.x() = 0.15 - kWidth / 2 - 1e-4;
  body.v.x() = speed;
  const int number = scene.add(body);
  scene.start();
  return number;
}
CaseResult curb_rate(double off) {  // speed
  ContactScene scene;
  const int body = start_at_curb(scene, off);
  scene.run(2e-3, kStep);
  return {relative(scene.w(body).y(), 2.586206896551724)};
}
CaseResult curb_speed(double off) {  // speed
  const double limit = threshold(0.5, 1.0, 1e-4, [off](double speed) {
    ContactScene scene;
    const int body = start_at_curb(scene, off * speed);
    scene.run(1.5, kStep);
    return tilt(scene, body) > 30 * kDegree;
  });
  return {relative(limit, 0.7644624638064581)};
}

// Housner: leaning by 0.1 rad it falls back, and goes on about the other edge. What is left of the
// energy of the turn is what lifts it: m g R (cos(alpha - lean) - cos alpha), before and after.
CaseResult rocking(double off) {  // width
  constexpr double kLean = 0.1;
  const double half = off * kWidth / 2;
  ContactScene scene;
  scene.add_floor(surface(1));
  ContactScene::Body body = block(1, 2 * half);
  body.R = turn_about(Vector3::UnitY(), kLean);
  body.p = Vector3(half, 0, 0) - body.R * Vector3(half, 0, -kHeight / 2);
  const int number = scene.add(body);
  scene.start();
  scene.locate_events();
  double back = 0;  // the furthest lean to the other side
  while (scene.t() < 0.3) {
    scene.step(kStep);
    back = std::max(back, -scene.R(number)(0, 2));
  }
  const double alpha = std::atan(kWidth / kHeight);
  const auto lift = [&](double lean) { return std::cos(alpha - lean) - std::cos(alpha); };
  return {relative(lift(std::asin(back)) / lift(kLean), 0.629013079667063)};
}

// ---- what a page draws of them ----

Values seen_lean(Scene s) {
  return {std::atan2(s.R(1)(0, 2), s.R(1)(2, 2))};
}
// Housner: what is left of the turn's energy lifts it again.
double known_rocking(std::size_t, double t) {
  const double alpha = std::atan(0.4), height = std::cos(alpha);
  const double lift = 0.629013079667063 * (std::cos(alpha - 0.1) - height);
  return t < 0.2 ? NAN : std::acos(lift + height) - alpha;
}

}  // namespace

CaseFamily toppling_cases() {
  const ContactCasePlot lean{.readings = {"lean [rad]"}, .read = seen_lean};
  return {230,
          {contact_case<tilt_limit, 20>("E3-tilt", 0.01, searched(lean, "α/rad")),
           contact_case<push_limit, 20>("E3-push", 0.01, searched(lean, "F/(m g)")),
           contact_case<slide_or_topple, 20>("E3-slide", 0.01, searched(lean, "μ")),
           contact_case<curb_rate, 20>(
               "E3-curb", 0.01,
               {.readings = {"rate [rad/s]"},
                .read = [](Scene s) { return Values{s.w(1).y()}; },
                .exact = [](std::size_t, double) { return 2.586206896551724; },
                .known_at = 2e-3,
                .no_steps = "A plastic impact takes two steps: the rate is read after the "
                            "second, and weight works on it meanwhile."}),
           contact_case<curb_speed, 20>("E3-over", 0.01, searched(lean, "v/(m/s)")),
           contact_case<rocking, 20>("E3-rocking", 0.01,
                                     {.readings = lean.readings,
                                      .read = seen_lean,
                                      .exact = known_rocking,
                                      .no_steps = kLocated})}};
}

}  // namespace twinarm
