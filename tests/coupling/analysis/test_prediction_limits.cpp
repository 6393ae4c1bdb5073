// The limits of coupling/analysis/stability_limits.h and step_matrix.h: against the closed forms of
// docs/coupling.md, and against where runs of the real stepper begin to grow, by bisection.
#include <doctest/doctest.h>

#include <optional>

#include "collision/import/robot/robot_model.h"
#include "collision/import/urdf/urdf.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/growth.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// The table's limit on w h at z = 0, 0.7 and 1, worked out by hand from each characteristic
// polynomial; nothing where the formula has an edge of its own at z = 0.
std::optional<double> table_limit(Scheme scheme, double z) {
  const double root = std::sqrt(1 + z * z);
  switch (scheme) {
    case Scheme::euler:
      return z <= 1 ? 2 * z : 2 * (z - std::sqrt(z * z - 1));
    case Scheme::semi_implicit:
    case Scheme::semi_implicit_difference:
      return 2 * (root - z);
    case Scheme::euler_difference:
      return 2 * z / (1 + 4 * z * z);
    case Scheme::semi_implicit_older:
      return z > 0 ? std::optional<double>(root - z) : std::nullopt;
    case Scheme::hold:
      return z > 0 ? std::min(4 * z, 1 / z) : 0;
    case Scheme::hold_difference: {  // z x^2 + (1 + 4 z^2) x - 4 z = 0
      const double p = 1 + 4 * z * z;
      return z > 0 ? (std::sqrt(p * p + 16 * z * z) - p) / (2 * z) : 0;
    }
    case Scheme::rk4:
      return z == 0 ? 2 * std::sqrt(2.0) : z == 1 ? 2.785293563405282 : 2.6979576034;
    case Scheme::implicit_damper:
      return 2 * (root + z);
    case Scheme::implicit:
      break;
  }
  return kNoLimit;
}

}  // namespace

TEST_CASE(
    "on one hinge a run grows at the table's w h, bisected, to 0.5 percent, for all schemes") {
  for (const Scheme scheme : all_schemes)
    for (const double z : {0.0, 0.7, 1.0}) {
      const std::optional<double> limit = table_limit(scheme, z);
      if (!limit) continue;
      CAPTURE(name_of(scheme));
      CAPTURE(z);
      const auto stable = [&](double wh) {
        return !grows(scheme, CouplingSpec::Type::torsional, wh * wh, 2 * z * wh);
      };
      const double predicted = largest_omega_h(scheme, z);
      if (*limit == kNoLimit) {
        CHECK(predicted == kNoLimit);
        for (const double wh : {1.0, 10.0, 1000.0}) CHECK(stable(wh));
      } else if (*limit == 0) {
        CHECK(predicted == 0);
        CHECK_FALSE(stable(0.05));
      } else {
        CHECK(predicted == doctest::Approx(*limit).epsilon(1e-7));
        CHECK(measured_limit(stable, *limit) == doctest::Approx(*limit).epsilon(0.005));
      }
    }
}

TEST_CASE("largest_omega_h is the edge of is_stable at every damping ratio") {
  for (const Scheme scheme : all_schemes)
    for (const double z : {0.05, 0.2, 0.5, 0.9, 1.3, 2.0}) {
      const double limit = largest_omega_h(scheme, z);
      CAPTURE(name_of(scheme));
      CAPTURE(z);
      const auto at = [&](double wh) { return is_stable(scheme, wh * wh, 2 * z * wh); };
      if (limit == kNoLimit) {
        CHECK(at(1e4));
        continue;
      }
      CHECK(at(0.999999 * limit));
      CHECK_FALSE(at(1.000001 * limit));
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
  options.friction = false;  // joints have dampers of their own
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

TEST_CASE("for the S-103 and the PUMA a run grows at the eigenvalues' step, to 1 percent") {
  for (const HeldRobot& robot : held_robots())
    for (const Scheme scheme :
         {Scheme::euler, Scheme::semi_implicit, Scheme::rk4, Scheme::implicit_damper}) {
      Stepper stepper = stepper_of(scheme, robot.type, robot.springs);
      stepper.spec.measure = Measure::joint;
      Kinematics k(robot.model);
      forward_kinematics(robot.model, robot.pose, k);
      Coupled system(robot.model, {}, {}, stepper.spec, robot.pose);
      const Coupling::JointSpace space = system.coupling->joint_space(k);
      const double predicted =
          largest_stable_step(mass_matrix(robot.model, robot.pose), space.K, space.B, scheme);
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

TEST_CASE("how much stiffer a hinge may be: alpha + 2 beta = 4 with b/k or with z kept") {
  const double I = 0.7, h = 0.002, k = 400, b = 3;
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  const double alpha = k * h * h / I, beta = b * h / I;
  const double by_ratio = largest_stiffness_factor(one(I), one(k), one(b), Scheme::semi_implicit, h,
                                                   Keep::damping_per_stiffness);
  CHECK(by_ratio * (alpha + 2 * beta) == doctest::Approx(4).epsilon(1e-7));
  const double by_zeta = largest_stiffness_factor(one(I), one(k), one(b), Scheme::semi_implicit, h,
                                                  Keep::damping_ratio);
  CHECK(by_zeta * alpha + 2 * std::sqrt(by_zeta) * beta == doctest::Approx(4).epsilon(1e-7));
  CHECK(largest_stiffness_factor(one(I), one(k), one(b), Scheme::implicit, h,
                                 Keep::damping_ratio) == kNoLimit);
  // An implicit damper that grows with the spring outruns it.
  CHECK(largest_stiffness_factor(one(I), one(k), one(100 * b), Scheme::implicit_damper, h,
                                 Keep::damping_per_stiffness) == kNoLimit);
}
