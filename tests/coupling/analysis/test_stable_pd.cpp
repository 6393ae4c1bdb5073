// Stable PD as printed, against its own recurrence and the limits that follow from it.
#include <doctest/doctest.h>

#include "solver/linear_algebra/dense_algebra.h"
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

// One step in (x, h v): (1 + beta) h^2 a = -alpha (x + h v) - beta h v.
double spectral_radius(double alpha, double beta, bool semi_implicit) {
  const double by_x = -alpha / (1 + beta), by_u = 1 - (alpha + beta) / (1 + beta);
  Eigen::Matrix2d A;
  if (semi_implicit)
    A << 1 + by_x, by_u, by_x, by_u;
  else
    A << 1, 1, by_x, by_u;
  return eigenvalues_of(A).cwiseAbs().maxCoeff();
}

bool pd_grows(double alpha, double beta) {
  const Model<double> model = one_joint(JointType::revolute, kI);
  return grows(Stepper{stable_pd(alpha * kI / (kH * kH), beta * kI / kH)}, model,
               State<double>(model), kH, 4000);
}

}  // namespace

TEST_CASE("stable PD: one degree of freedom follows the printed recurrence to 1e-12") {
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

TEST_CASE("stable PD: stable iff alpha < (4 + 2 beta)/3, with explicit Euler alpha < 4 + 2 beta") {
  for (double beta : {0.0, 0.01, 0.3, 1.0, 4.0, 50.0, 1e4})
    for (double part : {0.01, 0.5, 0.999, 1.001, 2.0, 100.0}) {
      const double alpha = part * (4 + 2 * beta) / 3;
      CAPTURE(beta);
      CAPTURE(part);
      CHECK((spectral_radius(alpha, beta, true) < 1) == (part < 1));
      if (beta > 0)  // else neutral
        CHECK((spectral_radius(3 * alpha, beta, false) < 1) == (part < 1));
    }
}

TEST_CASE("stable PD: a run of the stepper begins to grow at (4 + 2 beta)/3, to 0.5 percent") {
  for (double beta : {0.05, 0.5, 2.0, 20.0, 400.0}) {
    CAPTURE(beta);
    const double limit = (4 + 2 * beta) / 3;
    CHECK_FALSE(pd_grows(0.995 * limit, beta));
    CHECK(pd_grows(1.005 * limit, beta));
  }
}
