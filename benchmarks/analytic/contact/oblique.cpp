// An oblique impact with friction (E16).
#include <algorithm>
#include <cmath>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm {
namespace {

using namespace contact_looks;

// A sphere at (2, -3) m/s, e = 0.8: below mu = 0.1058 it slips throughout, else it ends rolling.
// T0 from where it touches; with a flight before the error is that of the step.
CaseResult oblique_from(double gap, double off) {  // e
  double error = 0;
  for (const double mu : {0.05, 0.2}) {
    ContactScene scene(Vector3::Zero());
    scene.add_floor(surface(mu, off * 0.8));
    const int ball =
        scene.add({Sphere{kBallRadius}, surface(mu, 1), 1, {0, 0, kBallRadius + gap}, {2, 0, -3}});
    scene.start();
    scene.run(0.1, kStep);
    const double vt = mu == 0.05 ? 1.73 : 10 / 7.0, rim = mu == 0.05 ? 0.675 : 10 / 7.0;
    const Vector3 wanted(vt, 2.4, rim);
    const Vector3 found(scene.v(ball).x(), scene.v(ball).z(), kBallRadius * scene.w(ball).y());
    error = std::max(error, (found - wanted).cwiseAbs().maxCoeff() / 2.4);
  }
  return {error};
}
CaseResult oblique(double off) {
  return oblique_from(0, off);
}
CaseResult oblique_flight(double off) {
  return oblique_from(0.1, off);
}

// What is left of the slip falls in proportion to mu until, at the limit, there is none.
double slip_left(double mu, double off) {  // e
  ContactScene scene(Vector3::Zero());
  scene.add_floor(surface(mu, off * 0.8));
  const int ball =
      scene.add({Sphere{kBallRadius}, surface(mu, 1), 1, {0, 0, kBallRadius}, {2, 0, -3}});
  scene.start();
  scene.run(0.01, kStep);
  return scene.v(ball).x() - kBallRadius * scene.w(ball).y();
}
CaseResult stick_limit(double off) {  // e
  const double some = slip_left(0.04, off), less = slip_left(0.08, off);
  const double limit = 0.08 + 0.04 * less / (some - less);
  return {relative(limit, 2 / 7.0 * 2 / (1.8 * 3))};
}

double known_oblique(std::size_t run, bool after) {
  return !after ? 2 : run == 0 ? 1.73 : 10 / 7.;
}

}  // namespace

CaseFamily oblique_cases() {
  const ContactCasePlot along{.readings = {"v along the floor [m/s]"},
                              .read = velocity<1, 0>,
                              .runs = {"μ = 0.05", "μ = 0.2"}};
  ContactCasePlot at_once = along, flight = along;
  at_once.exact = [](std::size_t run, double t) { return known_oblique(run, t > 0); };
  at_once.until = 0.02;
  flight.exact = [](std::size_t run, double t) { return known_oblique(run, t >= 0.1 / 3); };
  const ContactCasePlot slip{
      .readings = {"slip [m/s]"},
      .read = [](Scene s) { return Values{s.v(1).x() - 0.1 * s.w(1).y()}; },
      .exact = [](std::size_t run,
                  double t) { return t == 0 ? 2 : 2 - 3.5 * (run == 0 ? 0.04 : 0.08) * 1.8 * 3; },
      .runs = {"μ = 0.04", "μ = 0.08"},
      .no_steps = "One step is one impact, whatever its length."};
  return {200,
          {contact_case<oblique, 1>("E16", 1e-12, at_once),
           contact_case<stick_limit, 1>("E16-limit", 1e-12, slip),
           contact_case<oblique_flight, 2>("E16-flight", 1e-3, flight)}};
}

}  // namespace twinarm
