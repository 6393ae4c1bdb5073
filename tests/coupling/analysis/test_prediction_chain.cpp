// Tracking errors of the joints of a chain (coupling/analysis/multi_joint_tracking.h): against
// closed forms of one degree of freedom, and simulations behind targets that move both joints.
#include <doctest/doctest.h>

#include "coupling/analysis/prediction.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/profile_error.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kMoveTime = 0.2;

// Both joints simultaneously, by small angles: a ramp with reversal, or a quintic and then rest.
class BothJoints final : public OperatorMotion {
 public:
  BothJoints(bool ramp, Vector2d distance) : ramp_(ramp), D_(std::move(distance)) {}
  OperatorSample sample(double t, double toward) const override {
    const bool before = t + toward / 2 < kMoveTime;
    const double s = t / kMoveTime, back = 2 - s;
    double x = before ? s : back, v = before ? 1 : -1;
    if (!ramp_) {
      const double in = std::min(s, 1.0);
      x = in * in * in * (10 - 15 * in + 6 * in * in);
      v = 30 * in * in * (1 - in) * (1 - in);
    }
    OperatorSample hand;
    for (std::size_t j = 0; j < 2; ++j) {
      const double D = D_[static_cast<Eigen::Index>(j)];
      SteadyHand::mapping().set_robot_angle(hand, j, D * x, D * v / kMoveTime);
    }
    return hand;
  }
  double duration() const override { return 10; }
  std::string description() const override { return "both joints"; }

 private:
  bool ramp_;
  Vector2d D_;
};

// Maximum error of each joint from `from` to `to`, Runge-Kutta at 20 kHz.
Vector2d run_peaks(const Model<double>& model, const CouplingSpec& spec, const BothJoints& hand,
                   TargetRates rates, double from, double to) {
  TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"joint1", "joint2"}, "", 0, 0}, rates);
  const auto coupling = make_coupling(spec, model, kvr);
  Simulation simulation(model, State<double>(model));
  simulation.set_integrator(Integrator::rk4);
  simulation.add(*coupling);
  Vector2d peaks(0, 0);
  constexpr double h = 5e-5;
  for (int n = 1; n * h < to; ++n) {
    simulation.step(h);
    if (n * h < from) continue;
    for (std::size_t j = 0; j < 2; ++j) {
      double& peak = peaks[static_cast<Eigen::Index>(j)];
      const double target = SteadyHand::mapping().robot_angle(hand.sample(n * h, -h), j);
      peak = std::max(peak, std::abs(target - simulation.state().q[j]));
    }
  }
  return peaks;
}

ChainDynamics dynamics_of(const Model<double>& model, const CouplingSpec& spec, bool absolute) {
  Coupled system(model, {}, {}, spec, State<double>(model));
  const Coupling::JointSpace space = system.coupling->joint_space(system.simulation.kinematics());
  const MatrixXd none = MatrixXd::Zero(2, 2);
  return {mass_matrix(model, State<double>(model)), space.K, space.B, absolute ? space.B : none};
}

void check_near(const VectorXd& predicted, const VectorXd& run, double part) {
  CAPTURE(predicted.transpose());
  CAPTURE(run.transpose());
  for (Eigen::Index j = 0; j < run.size(); ++j)
    CHECK(predicted[j] == doctest::Approx(run[j]).epsilon(part));
}

}  // namespace

TEST_CASE(
    "the peak errors of an arm's joints behind moving targets agree with prediction to 1 percent") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const Vector2d D(0.004, -0.0025), v = D / kMoveTime;
  for (const bool points : {false, true})
    for (const bool absolute : {false, true}) {
      CAPTURE(points);
      CAPTURE(absolute);
      const auto springs =
          points ? arm.springs(22000, 400, 9000, 100) : arm.springs(600, 9, 200, 2);
      const CouplingSpec spec = points ? linear(springs) : torsional(springs, SpringSpace::world);
      const MultiJointTrackingError predicted(dynamics_of(model, spec, absolute));
      const TargetRates rates = absolute ? TargetRates::none : TargetRates::from_operator;
      check_near(predicted.behind(MotionProfile::quintic, D, kMoveTime),
                 run_peaks(model, spec, BothJoints(false, D), rates, 0, 0.6), 0.01);
      check_near(predicted.after_start(v, kMoveTime),
                 run_peaks(model, spec, BothJoints(true, D), rates, 0, kMoveTime), 0.01);
    }
}

TEST_CASE("a reversal from the steady state agrees with after_reversal, and K e = A v with it") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const Vector2d D(0.004, -0.0025), v = D / kMoveTime;
  const auto springs = arm.springs(60000, 2400, 30000, 800);  // settled at the reversal
  for (const bool absolute : {false, true}) {
    CAPTURE(absolute);
    const ChainDynamics dynamics = dynamics_of(model, linear(springs), absolute);
    const MultiJointTrackingError predicted(dynamics);
    const TargetRates rates = absolute ? TargetRates::none : TargetRates::from_operator;
    check_near(predicted.after_reversal(v, kMoveTime),
               run_peaks(model, linear(springs), BothJoints(true, D), rates, kMoveTime - 1e-4,
                         2 * kMoveTime),
               0.01);
    CHECK((dynamics.K * predicted.steady_state(v) - dynamics.absolute * v).norm() <
          1e-9 * (1 + (dynamics.absolute * v).norm()));
    CHECK((predicted.steady_state(v).norm() > 1e-4) == absolute);
  }
}

TEST_CASE("for one joint the errors of a chain are those of one degree of freedom") {
  const auto one = [](double value) { return MatrixXd::Constant(1, 1, value); };
  const double I = 0.7, D = 1.3, T = 0.9;
  for (const double omega : {4.0, 60.0, 270.0})
    for (const double zeta : {0.0, 0.5, 1.0, 2.0, 2.7})
      for (const bool absolute : {false, true}) {
        CAPTURE(omega);
        CAPTURE(zeta);
        CAPTURE(absolute);
        const double b = 2 * zeta * omega * I;
        const MultiJointTrackingError chain(
            {one(I), one(omega * omega * I), one(b), one(absolute ? b : 0)});
        const VectorXd distance = VectorXd::Constant(1, D);
        for (const MotionProfile move :
             {MotionProfile::ramp, MotionProfile::cubic, MotionProfile::quintic,
              MotionProfile::cosine, MotionProfile::bang_bang}) {
          CAPTURE(static_cast<int>(move));
          const ProfileError closed(
              move, D, T, omega, zeta,
              absolute ? ProfileError::Damper::absolute : ProfileError::Damper::relative);
          CHECK(std::abs(chain.behind(move, distance, T)[0] / closed.peak() - 1) < 2e-6);
        }
        CHECK(chain.steady_state(distance / T)[0] ==
              doctest::Approx(absolute ? absolute_damper_error(D / T, omega, zeta) : 0));
        if (absolute) continue;
        CHECK(chain.after_start(distance / T, T)[0] ==
              doctest::Approx(peak_after_jump(D / T, omega, zeta)).epsilon(1e-6));
        CHECK(chain.after_reversal(distance / T, T)[0] ==
              doctest::Approx(peak_after_jump(2 * D / T, omega, zeta)).epsilon(1e-6));
      }
}

TEST_CASE("a joint without coupling has no error, and does not affect the others") {
  const TwoLink arm;
  const Model<double> model = arm.model();
  const std::vector<Spring> inner{arm.springs(600, 9)[0]};
  const ChainDynamics dynamics = dynamics_of(model, torsional(inner, SpringSpace::joint), false);
  const MultiJointTrackingError chain(dynamics);
  CHECK(chain.is_held(0));
  CHECK_FALSE(chain.is_held(1));
  const VectorXd v = chain.after_start(Vector2d(1, 5), 1);
  CHECK(std::isnan(v[1]));
  // The outer link is free: the inner joint has the apparent inertia 1/(M^-1)_11.
  const double I = 1 / inverse_of(dynamics.M)(0, 0), omega = std::sqrt(600 / I);
  CHECK(v[0] == doctest::Approx(peak_after_jump(1, omega, 9 / (2 * I * omega))).epsilon(1e-3));
  // Negative stiffness: unbounded.
  const MultiJointTrackingError away({dynamics.M, -dynamics.K, dynamics.B, dynamics.absolute});
  CHECK(std::isnan(away.after_start(Vector2d(1, 0), 1)[0]));
}
