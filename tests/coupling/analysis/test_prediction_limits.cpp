// Stability limits of coupling/analysis/gains.h and step_matrix.h: against closed forms of
// docs/understand/stability_of_spring_dampers.md, and against simulations, by bisection.
#include <doctest/doctest.h>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/growth.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

TEST_CASE("max_omega_h is the limit of is_stable at every damping ratio") {
  for (const SteppingScheme scheme : all_schemes)
    for (const double z : {0.0, 0.05, 0.2, 0.5, 0.9, 1.3, 2.0}) {
      if (z == 0 && scheme == SteppingScheme::semi_implicit_older)
        continue;  // its formula has a limit there
      const double limit = max_omega_h(scheme, z);
      CAPTURE(name_of(scheme));
      CAPTURE(z);
      const auto at = [&](double wh) { return is_stable(scheme, wh * wh, 2 * z * wh); };
      if (limit == kNoLimit) {
        CHECK(at(1e4));
        continue;
      }
      if (limit > 0) CHECK(at(0.999999 * limit));
      CHECK_FALSE(at(1.000001 * limit + 1e-9));
    }
}

TEST_CASE("gains beyond all measure have no stable factor, and the search for it ends") {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  for (const double gain : {1e100, 1e200, 1e300}) {
    CAPTURE(gain);
    CHECK(max_stiffness_factor(one, gain * one, gain * one, SteppingScheme::semi_implicit, 1e-3,
                               HoldConstant::damping_per_stiffness) <= 4e6 / gain);
  }
}

namespace {

struct HeldRobot {
  const char* name;
  Model<double> model;
  State<double> pose;
  std::vector<Spring> springs;
  CouplingSpec::Type type;
};

Model<double> model_of(const char* file) {
  ModelOptions options;
  options.friction = false;  // joint damping would add to the couplings
  Model<double> model =
      build_model(read_urdf(std::string(TWINARM_SOURCE_DIR "/assets/robots/") + file), options);
  model.gravity = {0, 0, 0};
  return model;
}

// Springs on every link: torsional at the joints (the S-103's lift: along it), or at points.
std::vector<HeldRobot> held_robots() {
  std::vector<HeldRobot> robots;
  for (const char* file : {"s103/s103.urdf", "puma560/puma560.urdf"}) {
    HeldRobot robot{file, model_of(file), {}, {}, CouplingSpec::Type::torsional};
    robot.pose = State<double>(robot.model);
    const double angles[] = {0.4, -0.7, 0.9, 0.02, -0.8, 0.6};
    for (std::size_t j = 0; j < robot.model.nq; ++j)
      robot.pose.q[j] = angles[j % 6] * (robot.model.nq == 4 && j == 3 ? 0.1 : 1);
    for (std::size_t i = 1; i < robot.model.parent.size(); ++i) {
      if (robot.model.dofs(i) == 0) continue;
      const auto s = static_cast<double>(i);
      robot.springs.push_back({robot.model.body_name[i], static_cast<int>(i),
                               Vector3(0.11, 0.05 * s, -0.07), 300 / s, 4 / s});
    }
    robots.push_back(robot);
    robot.type = CouplingSpec::Type::linear;
    for (Spring& spring : robot.springs) spring.k *= 20;
    robots.push_back(robot);
  }
  return robots;
}

}  // namespace

TEST_CASE("for the S-103 and the PUMA simulations diverge at the predicted step, to 1 percent") {
  for (const HeldRobot& robot : held_robots())
    for (const SteppingScheme scheme : {SteppingScheme::euler, SteppingScheme::semi_implicit,
                                        SteppingScheme::rk4, SteppingScheme::implicit_damper}) {
      Stepper stepper = stepper_of(scheme, robot.type, robot.springs);
      stepper.spec.measure = SpringSpace::joint;
      Kinematics k(robot.model);
      forward_kinematics(robot.model, robot.pose, k);
      Coupled system(robot.model, {}, {}, stepper.spec, robot.pose);
      const Coupling::JointSpace space = system.coupling->joint_space(k);
      const double predicted =
          max_stable_step(mass_matrix(robot.model, robot.pose), space.K, space.B, scheme);
      CAPTURE(robot.name);
      CAPTURE(name_of(scheme));
      CAPTURE(predicted);
      REQUIRE(std::isfinite(predicted));
      const auto stable = [&](double h) {
        return !grows(stepper, robot.model, robot.pose, h, 4000);
      };
      CHECK(measured_limit(stable, predicted) == doctest::Approx(predicted).epsilon(0.01));
    }
}

TEST_CASE("stiffness factor of a revolute joint: alpha + 2 beta = 4 with constant b/k or z") {
  const double I = 0.7, h = 0.002, k = 400, b = 3;
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const double alpha = k * h * h / I, beta = b * h / I;
  const double by_ratio =
      max_stiffness_factor(one(I), one(k), one(b), SteppingScheme::semi_implicit, h,
                           HoldConstant::damping_per_stiffness);
  CHECK(by_ratio * (alpha + 2 * beta) == doctest::Approx(4).epsilon(1e-7));
  const double by_zeta = max_stiffness_factor(one(I), one(k), one(b), SteppingScheme::semi_implicit,
                                              h, HoldConstant::damping_ratio);
  CHECK(by_zeta * alpha + 2 * std::sqrt(by_zeta) * beta == doctest::Approx(4).epsilon(1e-7));
  CHECK(max_stiffness_factor(one(I), one(k), one(b), SteppingScheme::implicit, h,
                             HoldConstant::damping_ratio) == kNoLimit);
  // An implicit damper proportional to the spring outgrows it.
  CHECK(max_stiffness_factor(one(I), one(k), one(100 * b), SteppingScheme::implicit_damper, h,
                             HoldConstant::damping_per_stiffness) == kNoLimit);
}
