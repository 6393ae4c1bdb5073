// The coupled two-link arm against the claims about the paper (docs/understand/paper_analysis.md).
// In continuous time it is benchmarks/analytic/coupling/tracking.cpp, F3.
#include <doctest/doctest.h>

#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {
using Type = CouplingSpec::Type;

// The search protocol of the findings: five sweep times T, errors weighted by T so that resonance
// at one T is not exploited.
struct Protocol {
  double max1 = 0, max2 = 0, mean1 = 0, mean2 = 0;
};
Protocol protocol(const TwoLink& arm, const CouplingSpec& spec, double rate) {
  Protocol row;
  for (double T : {0.87, 0.95, 1.0, 1.06, 1.17}) {
    const Tracking run =
        track(arm, spec, 1 / rate, Integrator::semi_implicit, TargetRates::backward_difference, T);
    row.max1 = std::max(row.max1, T * run.error.max[0]);
    row.max2 = std::max(row.max2, T * run.error.max[1]);
    row.mean1 += T * run.error.mean[0] / 5;
    row.mean2 += T * run.error.mean[1] / 5;
  }
  return row;
}
}  // namespace

TEST_CASE("60 Hz, best gains: torsional 17.2/14.6 deg, linear 4.8/4.4, k2 = 0.2 k1 7.4/2.8") {
  const TwoLink arm;
  const Protocol world =
      protocol(arm, torsional(arm.springs(295.1, 3.541), SpringSpace::world), 60);
  CHECK(world.max1 == doctest::Approx(17.24).epsilon(0.002));
  CHECK(world.max2 == doctest::Approx(14.58).epsilon(0.002));
  CHECK(world.mean1 == doctest::Approx(3.97).epsilon(0.005));
  CHECK(world.mean2 == doctest::Approx(3.23).epsilon(0.005));
  const Protocol points = protocol(arm, linear(arm.springs(475.8, 339.2)), 60);
  CHECK(points.max1 == doctest::Approx(4.77).epsilon(0.002));
  CHECK(points.max2 == doctest::Approx(4.46).epsilon(0.002));
  CHECK(points.mean1 == doctest::Approx(1.735).epsilon(0.005));
  CHECK(points.mean2 == doctest::Approx(2.28).epsilon(0.005));
  const Protocol ratio = protocol(
      arm, torsional(arm.springs(768.4, 17.41, 0.2 * 768.4, 0.2 * 17.41), SpringSpace::world), 60);
  CHECK(ratio.max1 == doctest::Approx(7.44).epsilon(0.002));
  CHECK(ratio.max2 == doctest::Approx(2.75).epsilon(0.02));
  CHECK(ratio.mean1 == doctest::Approx(0.625).epsilon(0.005));
  CHECK(ratio.mean2 == doctest::Approx(0.460).epsilon(0.005));
}

TEST_CASE("the as-published unfolded damper diverges at 1 kHz, the folded one stays bounded") {
  const TwoLink arm;
  AsPublishedOptions options;
  options.damping_sign = 1;
  const Tracking folded =
      track(arm, printed(Type::torsional, arm.springs(1200, 40), options), 1e-3);
  CHECK(folded.finite);
  CHECK(folded.error.max[0] == doctest::Approx(14.6).epsilon(0.01));
  CHECK(folded.error.max[1] == doctest::Approx(24.2).epsilon(0.01));
  options.damper = Damper::unsigned_;
  for (double sign : {-1.0, 1.0}) {
    options.damping_sign = sign;
    CHECK_FALSE(track(arm, printed(Type::torsional, arm.springs(1200, 40), options), 1e-3).finite);
  }
}

TEST_CASE("an angle difference per frame, not divided by h, is almost undamped") {
  const TwoLink arm;
  AsPublishedOptions options;
  options.damper = Damper::vector_;
  options.difference = Difference::per_frame;
  const Tracking run = track(arm, printed(Type::torsional, arm.springs(1200, 40), options), 1e-3);
  CHECK(run.error.max[0] == doctest::Approx(10.07).epsilon(0.002));
  CHECK(run.error.max[1] == doctest::Approx(8.74).epsilon(0.002));
  CHECK(run.error.mean[0] == doctest::Approx(4.81).epsilon(0.005));
}

TEST_CASE("10 : 14 arms: the as-published torsional law is close to E3, the linear law meets E4") {
  const TwoLink arm{5, 3, 0.25, 0.35};
  const Tracking e3 =
      track(arm, printed(Type::torsional, arm.springs(195.137, 2.7316), {}), 1.0 / 60);
  CHECK(e3.error.max[0] == doctest::Approx(18.49).epsilon(0.02));
  CHECK(e3.error.mean[0] == doctest::Approx(8.29).epsilon(0.02));
  const Tracking e4 =
      track(arm, printed(Type::linear, arm.springs(87140, 96.6, 22130, 63.0), {}), 1.0 / 125);
  CHECK(e4.error.max[0] == doctest::Approx(3.389).epsilon(0.001));
  CHECK(e4.error.max[1] == doctest::Approx(6.011).epsilon(0.001));
  CHECK(e4.error.mean[0] == doctest::Approx(0.298).epsilon(0.005));
  CHECK(e4.error.mean[1] == doctest::Approx(0.598).epsilon(0.005));
}
