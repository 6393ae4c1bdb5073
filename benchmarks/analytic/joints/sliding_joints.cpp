// B4, a screw joint on a vertical axis, p = 0.1 m / 2 pi, 2 kg, 0.05 kg m^2: q'' = m g p / (I + m
// p^2), holding torque m g p; with damping b the rate tends to m g p / b. B5, 2 kg on an incline of
// 30 degrees with damping c: x = v (t - T (1 - exp(-t/T))), T = m / c, v = m g sin 30 / c. B9,
// cylindrical, planar and free joints: uncoupled coordinates, parabolas in time, for which every
// second-order scheme is exact.
#include <array>

#include "benchmarks/analytic/support/smooth_parts.h"
#include "solver/dynamics/world_kinematics.h"

namespace twinarm {
namespace {

constexpr double kPitch = 0.1 / (2 * std::numbers::pi), kSlidingMass = 2, kScrewInertia = 0.05;

// The axis points down: gravity drives it forward.
CaseScene screw(double damping) {
  return at_rest(one_body(JointType::screw, -Vector3::UnitZ(),
                          {kSlidingMass, Vector3::Zero(), kScrewInertia * Matrix3::Identity()},
                          {kPitch, 0, damping}));
}

TrajectoryCase screw_at_rest() {
  const double qdd =
      kSlidingMass * kGravity * kPitch / (kScrewInertia + kSlidingMass * kPitch * kPitch);
  return evaluation(
      screw(0), {"rotation [rad/s2]", "translation [m/s2]", "holding torque [N m]"},
      [](ModelRef model, StateRef x) {
        const Workspace<double> w = evaluate(model, x);
        return values(w.qdd[0], -point_acceleration(model, w, 1, {}).z,
                      -inverse_dynamics(model, x, {0})[0]);
      },
      {qdd, kPitch * qdd, kSlidingMass * kGravity * kPitch}, relative_each);
}
// Accelerations at rest and at a rate, of which they are a linear function.
std::array<double, 2> accelerations(const Model<double>& model, const State<double>& x,
                                    double rate) {
  State<double> moving = x;
  moving.qd[0] = rate;
  return {evaluate(model, x).qdd[0], evaluate(model, moving).qdd[0]};
}

// Damped: terminal rate, and the approach to it.
TrajectoryCase screw_terminal() {
  return evaluation(
      screw(0.01), {"terminal rate [rad/s]"},
      [](ModelRef model, StateRef x) {
        const auto [rest, fast] = accelerations(model, x, 32);
        return values(32 * rest / (rest - fast));
      },
      {kSlidingMass * kGravity * kPitch / 0.01}, relative_each);
}
TrajectoryCase screw_motion() {
  TrajectoryCase c = screw_terminal();
  c.scene = [] { return not_conserving(screw(0.01)); };
  c.times = {1, 10, 30};
  c.readings = {"rate [rad/s]"};
  c.observe = observe(velocity(0));
  c.reference = [](double t) {
    const double T = (kScrewInertia + kSlidingMass * kPitch * kPitch) / 0.01;
    return values(kSlidingMass * kGravity * kPitch / 0.01 * -std::expm1(-t / T));
  };
  c.measure = max_difference;
  return c;
}

TrajectoryCase incline() {
  const BodyInertia body{2, Vector3::Zero(), Matrix3::Identity()};
  const Vector3 downhill(std::sqrt(3.0) / 2, 0, -0.5);
  return {.scene = fixed(
              not_conserving(at_rest(one_body(JointType::prismatic, downhill, body, {0, 0, 0.8})))),
          .times = {0.5, 2, 10},
          .readings = {"x [m]", "v [m/s]"},
          .observe = joint_state(),
          .reference = [](double t) {
            const double T = 2 / 0.8, v = kGravity / 2 * T, part = -std::expm1(-t / T);
            return values(v * (t - T * part), v * part);
          }};
}
TrajectoryCase incline_start() {
  return evaluation(
      incline().scene(), {"start [m/s2]", "terminal speed [m/s]"},
      [](ModelRef model, StateRef x) {
        const auto [rest, fast] = accelerations(model, x, 10);
        return values(rest, 10 * rest / (rest - fast));
      },
      {4.905, 12.2625}, relative_each);
}

// ---- B9 ----

TrajectoryCase cylindrical() {
  CaseScene scene =
      not_conserving(at_rest(one_body(JointType::cylindrical, Vector3::UnitZ(),
                                      {1.5, Vector3::Zero(), 0.02 * Matrix3::Identity()})));
  scene.sources = {joint_effort([](double, double) { return 0.3; })};
  return {.scene = fixed(scene),
          .times = {1},
          .readings = {"angle [rad]", "z [m]", "rate [rad/s]", "speed [m/s]"},
          .observe = joint_state(),
          .reference =
              [](double t) {
                return values(7.5 * t * t, -kGravity / 2 * t * t, 15 * t, -kGravity * t);
              },
          .measure = relative_to_largest};
}

TrajectoryCase planar() {
  const double slope = 20 * kDegree;
  const Vector3 normal(std::sin(slope), 0, std::cos(slope));
  const BodyInertia body{1, Vector3::Zero(), 0.1 * Matrix3::Identity()};
  return {.scene = fixed(start_at(one_body(JointType::planar, normal, body), {0, 0, 0}, {1, 2, 3})),
          .times = {3},
          .readings = {"x [m]", "y [m]", "angle [rad]"},
          .observe = [](ModelRef, StateRef x) { return x.q; },
          .reference =
              [](double t) {
                return values(t + kGravity * std::sin(20 * kDegree) / 2 * t * t, 2 * t, 3 * t);
              },
          .measure = relative_to_largest};
}

TrajectoryCase thrown() {
  const BodyInertia body{1, Vector3::Zero(), Vector3(0.1, 0.2, 0.25).asDiagonal()};
  return {.scene = fixed(start_at(one_body(JointType::free, Vector3::UnitZ(), body),
                                  {0, 0, 1, 1, 0, 0, 0}, {0, 0, 0, 3, 0, 4})),
          .times = {1.5},
          .readings = {"x [m]", "y [m]", "z [m]"},
          .observe = [](ModelRef, StateRef x) { return values(x.q[0], x.q[1], x.q[2]); },
          .reference = [](double t) { return values(3 * t, 0, 1 + 4 * t - kGravity / 2 * t * t); },
          .measure = relative_to_largest};
}

}  // namespace

CaseFamily sliding_joints_cases() {
  return {70,
          {{"B4", 1e-12, screw_at_rest()},
           {"B4-terminal", 1e-12, screw_terminal()},
           {"B4-motion", 1e-8, screw_motion()},
           {"B5", 1e-8, incline()},
           {"B5-start", 1e-12, incline_start()},
           {"B9-cylindrical", 1e-12, cylindrical()},
           {"B9-planar", 1e-12, planar()},
           {"B9-free", 1e-12, thrown()},
           {"B9-verlet", 1e-12, integrated_by({Integrator::verlet, 1e-2}, planar())}}};
}

}  // namespace twinarm
