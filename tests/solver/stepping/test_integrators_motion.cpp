// Prescribed motion under every integrator.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <string>

#include "solver/dynamics/model_builder.h"
#include "tests/solver/stepping/pendulum.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Rotation and translation with nonzero derivatives: R = Rz(a) Rx(b).
PrescribedMotion tumbling(double t) {
  const double a = 0.3 + 1.1 * t + 0.4 * t * t, da = 1.1 + 0.8 * t, dda = 0.8;
  const double b = 0.9 * std::sin(2 * t), db = 1.8 * std::cos(2 * t), ddb = -3.6 * std::sin(2 * t);
  const Matrix3 Rz = Eigen::AngleAxisd(a, Vector3::UnitZ()).toRotationMatrix();
  const Vector3 x_turned = Rz * Vector3::UnitX();
  PrescribedMotion motion;
  motion.X_JL.R = Rz * Eigen::AngleAxisd(b, Vector3::UnitX()).toRotationMatrix();
  motion.X_JL.p = {0.2 * std::sin(3 * t), 0.5 * t * t, 0.1 - 0.3 * t};
  motion.velocity = {0.6 * std::cos(3 * t), t, -0.3};
  motion.acceleration = {-1.8 * std::sin(3 * t), 1, 0};
  motion.angular_velocity = da * Vector3::UnitZ() + db * x_turned;
  motion.angular_acceleration =
      dda * Vector3::UnitZ() + ddb * x_turned + db * da * Vector3::UnitZ().cross(x_turned);
  return motion;
}

// A body on a prescribed carrier.
Model<double> on_carrier(JointType type, const BodyInertia& body, const Vector3& gravity) {
  ModelBuilder builder;
  builder.set_gravity(gravity);
  builder.add_body("carrier", 0, "drive", JointType::prescribed, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Matrix3::Identity()});
  builder.add_body("body", 1, "joint", type, {}, Vector3::UnitY(), body);
  return builder.build();
}

}  // namespace

TEST_CASE("a free body on a tumbling carrier moves uniformly, under every integrator") {
  const BodyInertia sphere{2, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  const Model<double> model = on_carrier(JointType::free, sphere, Vector3::Zero());
  State<double> x(model);
  x.q[model.iq[2]] = 0.4;
  x.qd = {0.5, -1, 2, 0.3, -0.2, 0.1};
  for (const IntegratorFacts& facts : all_integrators) {
    CAPTURE(std::string(facts.name));
    const auto error_of = [&](long steps) {
      Simulation simulation(model, x);
      simulation.prescribe(1, tumbling);
      simulation.set_integrator(facts.integrator, 1e-11);
      const Kinematics start = simulation.kinematics();
      const Matrix3 I = 0.1 * Matrix3::Identity();
      for (long n = 0; n < steps; ++n) CHECK(simulation.step(1.0 / double(steps)).ok());
      const Kinematics& end = simulation.kinematics();
      const Matrix3 turn =
          Eigen::AngleAxisd(start.w_WL[2].norm(), start.w_WL[2].normalized()).toRotationMatrix();
      return (end.X_WL[2].p - start.X_WL[2].p - start.v_WLo[2]).norm() +
             (end.v_WLo[2] - start.v_WLo[2]).norm() + (I * (end.w_WL[2] - start.w_WL[2])).norm() +
             (end.X_WL[2].R - turn * start.X_WL[2].R).norm();
    };
    const double fine = error_of(800);
    if (facts.integrator == Integrator::dopri5) {
      CHECK(fine < 1e-9);
    } else {
      CHECK(std::abs(std::log2(error_of(100) / fine) / 3 - facts.order) < 0.1);
    }
  }
}

TEST_CASE(
    "a law moves its link at once, takes the place of an earlier law, and fits its joint only") {
  const Model<double> model =
      on_carrier(JointType::revolute, {1, {0, 0, -1}, Matrix3::Identity()}, Vector3::Zero());
  Simulation simulation(model, State<double>(model));
  simulation.prescribe(1, tumbling);
  simulation.prescribe(1, [](double t) { return tumbling(t + 2); });
  const PrescribedMotion motion = tumbling(2);
  CHECK((simulation.kinematics().X_WL[1].p - motion.X_JL.p).norm() < 1e-15);
  CHECK((simulation.kinematics().X_WL[1].R - motion.X_JL.R).norm() < 1e-15);
  CHECK((simulation.kinematics().v_WLo[1] - motion.velocity).norm() < 1e-14);
  CHECK((simulation.kinematics().w_WL[1] - motion.angular_velocity).norm() < 1e-14);
  for (const int body : {-1, 0, 2, 3})
    CHECK_THROWS_AS(simulation.prescribe(body, tumbling), std::invalid_argument);
}
