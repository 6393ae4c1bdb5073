// E16: oblique impact with friction.
#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_plots;

// Ball at (2, -3) m/s, at a distance from the floor; e = 0.8 scaled.
int start_ball(ContactScene& scene, double mu, double gap, double scale) {
  scene.add_floor(surface(mu, scale * 0.8));
  return scene.start(
      {Sphere{kBallRadius}, surface(mu, 1), 1, {0, 0, kBallRadius + gap}, {2, 0, -3}});
}

// Below mu = 0.1058 it slips during the whole impact, else it ends rolling.
CaseResult oblique_from(double gap, double scale) {  // e
  return {max_over({0.05, 0.2}, [&](double mu) {
    ContactScene scene(Vector3::Zero());
    const int ball = start_ball(scene, mu, gap, scale);
    scene.run(0.1, kStep);
    const double vt = mu == 0.05 ? 1.73 : 10 / 7.0, rim = mu == 0.05 ? 0.675 : 10 / 7.0;
    const Vector3 wanted(vt, 2.4, rim);
    const Vector3 found(scene.v(ball).x(), scene.v(ball).z(), kBallRadius * scene.w(ball).y());
    return (found - wanted).cwiseAbs().maxCoeff() / 2.4;
  })};
}
CaseResult oblique(double scale) {
  return oblique_from(0, scale);
}
CaseResult oblique_flight(double scale) {
  return oblique_from(0.1, scale);
}

// The remaining slip falls in proportion to mu and is zero at the limit.
double slip_left(double mu, double scale) {  // e
  ContactScene scene(Vector3::Zero());
  const int ball = start_ball(scene, mu, 0, scale);
  scene.run(0.01, kStep);
  return scene.v(ball).x() - kBallRadius * scene.w(ball).y();
}
CaseResult stick_limit(double scale) {  // e
  const double some = slip_left(0.04, scale), less = slip_left(0.08, scale);
  const double limit = 0.08 + 0.04 * less / (some - less);
  return {relative(limit, 2 / 7.0 * 2 / (1.8 * 3))};
}

double exact_oblique(std::size_t run, bool after) {
  return !after ? 2 : run == 0 ? 1.73 : 10 / 7.;
}

}  // namespace

CaseFamily oblique_cases() {
  const Plot along{{"v along the floor [m/s]"}, velocity<1, 0>, nullptr, {"μ = 0.05", "μ = 0.2"}};
  const auto at_once = [](std::size_t run, double t) { return exact_oblique(run, t > 0); };
  const auto flight = [](std::size_t run, double t) { return exact_oblique(run, t >= 0.1 / 3); };
  const auto exact_slip = [](std::size_t run, double t) {
    return t == 0 ? 2 : 2 - 3.5 * (run == 0 ? 0.04 : 0.08) * 1.8 * 3;
  };
  return {200,
          {contact_case<oblique, 1>("E16", 1e-12,
                                    along.with(&Plot::exact, at_once).with(&Plot::until, 0.02)),
           contact_case<stick_limit, 1>(
               "E16-limit", 1e-12,
               Plot{{"slip [m/s]"}, slip, exact_slip, {"μ = 0.04", "μ = 0.08"}}.without_convergence(
                   "One step is one impact at any length.")),
           contact_case<oblique_flight, 2>("E16-flight", 1e-3, along.with(&Plot::exact, flight))}};
}

}  // namespace twinarm
