// Stable PD as published, against its recurrence and stability limit.
#include <doctest/doctest.h>

#include "tests/coupling/analysis/growth.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kI = 0.7, kH = 0.01;

CouplingSpec stable_pd(double k, double b) {
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::stable_pd;
  spec.springs = {{"spring", 1, Vector3::Zero(), k, b}};
  return spec;
}

bool pd_grows(double alpha, double beta) {
  const Model<double> model = one_joint(JointType::revolute, kI);
  return grows(Stepper{stable_pd(alpha * kI / (kH * kH), beta * kI / kH)}, model,
               State<double>(model), kH, 4000);
}

}  // namespace

TEST_CASE("stable PD: one degree of freedom follows the published recurrence to 1e-12") {
  for (const JointType joint : {JointType::revolute, JointType::prismatic}) {
    const double k = 3e3, b = 40, h = kH;
    const Model<double> model = one_joint(joint, kI);
    SteadyHand hand;
    hand.angle[0] = 0.4;
    hand.rate[0] = -0.6;
    Coupled system(model, hand, {"joint1"}, stable_pd(k, b), state_of(model, {-0.3}, {0.8}));
    double x = -0.3, v = 0.8, worst = 0;
    for (int n = 1; n <= 200; ++n) {
      // tau = -k (x + h v - x_K') - b (v + h a - v_K') = I a, solved for a
      const double x_K = 0.4 - 0.6 * h * n, v_K = -0.6;
      const double a = (-k * (x + h * v - x_K) - b * (v - v_K)) / (kI + h * b);
      v += h * a;
      x += h * v;
      system.simulation.step(h);
      worst = std::max(worst, std::abs(system.simulation.state().q[0] - x));
    }
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("stable PD: a simulation begins to grow at (4 + 2 beta)/3, to 0.5 percent") {
  for (double beta : {0.05, 0.5, 2.0, 20.0, 400.0}) {
    CAPTURE(beta);
    const double limit = (4 + 2 * beta) / 3;
    CHECK_FALSE(pd_grows(0.995 * limit, beta));
    CHECK(pd_grows(1.005 * limit, beta));
  }
}
