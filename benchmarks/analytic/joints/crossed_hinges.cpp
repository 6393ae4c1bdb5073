// C8, C9: two hinges that are not parallel (Lagrange).
// C8, Furuta's pendulum, arm q1 about the vertical, pendulum q2 about the arm, 0 hanging:
//   (J0 + m L^2 + Jp sin^2 q2) q1'' + m L l cos q2 q2'' = -2 Jp s c q1' q2' + m L l s q2'^2,
//   m L l cos q2 q1'' + Jp q2'' = Jp s c q1'^2 - m g l s,  Jp = J + m l^2.
// C9, Kane's "babyboot" (Kane, Levinson, Dynamics, 1985): a rod swings about a horizontal axis, a
// plate rotates about the rod:
//   (I0 + Bx cos^2 qB + By sin^2 qB) qA'' = 2 (Bx - By) s c qA' qB' - (mA LA + mB LB) g sin qA,
//   Bz qB'' = -(Bx - By) s c qA'^2,  I0 = Ax + mA LA^2 + mB LB^2. Chaotic.
#include "benchmarks/analytic/support/smooth_parts.h"

namespace twinarm {
namespace {

// ---- C8 ----

constexpr double kArm = 0.02, kReach = 0.3, kBob = 0.2, kBobCom = 0.15, kBobInertia = 0.0015;
constexpr double kPivot = kBobInertia + kBob * kBobCom * kBobCom;  // Jp
constexpr double kMixed = kBob * kReach * kBobCom;                 // m L l
constexpr double kAbout = kArm + kBob * kReach * kReach;           // J0 + m L^2
constexpr double kWhirl = 12;                                      // [rad/s]

// The pendulum's hinge axis is x of the arm; at q2 > 0 it is inclined towards y.
CaseScene furuta(double tilt, double arm_rate, double rate) {
  ModelBuilder builder;
  builder.add_body("arm", 0, "shaft", JointType::revolute, {}, Vector3::UnitZ(),
                   {1, Vector3::Zero(), Vector3(0, 0, kArm).asDiagonal()});
  builder.add_body("pendulum", 1, "hinge", JointType::revolute,
                   {Matrix3::Identity(), {kReach, 0, 0}}, Vector3::UnitX(),
                   {kBob, {0, 0, -kBobCom}, Vector3(kBobInertia, kBobInertia, 0).asDiagonal()});
  return start_at(builder.build(), {0, tilt}, {arm_rate, rate});
}
special::Rates furuta_rates() {
  return [](Real, const special::Numbers& x, special::Numbers& dx) {
    constexpr Real J = kBobInertia + Real(kBob) * kBobCom * kBobCom;
    constexpr Real m = Real(kBob) * kReach * kBobCom;
    constexpr Real about = kArm + Real(kBob) * kReach * kReach;
    const Real s = std::sin(x[1]), c = std::cos(x[1]);
    const special::Two a =
        special::solve_two(about + J * s * s, m * c, J,
                           {-2 * J * s * c * x[2] * x[3] + m * s * x[3] * x[3],
                            J * s * c * x[2] * x[2] - Real(kBob) * 9.81L * kBobCom * s});
    dx = {x[2], x[3], a.first, a.second};
  };
}

TrajectoryCase furuta_motion() {
  return {.scene = [] { return furuta(2, 0, 0); },
          .times = {1, 2, 5},
          .readings = {"arm [rad]", "pendulum [rad]", "arm [rad/s]", "pendulum [rad/s]"},
          .observe = joint_state(),
          .reference = solution_of(furuta_rates(), {0, 2, 0, 0})};
}
// In one state, q2 = 1, rates 2 and 3.
TrajectoryCase furuta_evaluation() {
  special::Numbers dx(4);
  furuta_rates()(0, {0, 1, 2, 3}, dx);
  return evaluation(furuta(1, 2, 3), {"arm [rad/s2]", "pendulum [rad/s2]"},
                    [](ModelRef model, StateRef x) { return evaluate(model, x).qdd; },
                    {static_cast<double>(dx[2]), static_cast<double>(dx[3])});
}
// About hanging and upright w^2 = +-m g l / (Jp - (m L l)^2 / (J0 + m L^2)); with the arm at a rate
// W the pendulum is in equilibrium where the moments of weight and centrifugal force cancel.
TrajectoryCase furuta_special() {
  const double weight = kBob * kGravity * kBobCom;
  const double w = std::sqrt(weight / (kPivot - kMixed * kMixed / kAbout));
  const CaseObserver observe = [](ModelRef model, StateRef x) {
    State<double> above = x, round = x;
    above.q[1] = std::numbers::pi;
    round.qd[0] = kWhirl;
    double low = 0.5, high = 1.5;
    for (double middle = 1; low < middle && middle < high; middle = (low + high) / 2) {
      round.q[1] = middle;
      (evaluate(model, round).qdd[1] > 0 ? low : high) = middle;
    }
    return values(std::sqrt(squared_frequencies_of(model, x).back()),
                  std::sqrt(-squared_frequencies_of(model, above).front()), std::cos(low));
  };
  return evaluation(furuta(0, 0, 0), {"swinging [rad/s]", "falling [rad/s]", "cosine at 12 rad/s"},
                    observe, {w, w, weight / (kPivot * kWhirl * kWhirl)}, relative_each);
}

// ---- C9 ----

constexpr double kRodInertia = 50e-7;  // about its centre [kg m^2]
constexpr double kPlateX = 2500e-7, kPlateY = 500e-7, kPlateZ = 2000e-7;
constexpr double kRodCentre = 0.075, kPlateCentre = 0.2, kRodMass = 0.01, kPlateMass = 0.1;

CaseScene babyboot_scene() {
  ModelBuilder builder;
  builder.add_body("rod", 0, "swing", JointType::revolute, {}, Vector3::UnitX(),
                   {kRodMass, {0, 0, -kRodCentre}, Vector3(kRodInertia, 0, 0).asDiagonal()});
  builder.add_body(
      "plate", 1, "turn", JointType::revolute, {}, Vector3::UnitZ(),
      {kPlateMass, {0, 0, -kPlateCentre}, Vector3(kPlateX, kPlateY, kPlateZ).asDiagonal()});
  return start_at(builder.build(), {std::numbers::pi / 2, kDegree}, {0, 0});
}
special::Rates babyboot_rates() {
  return [](Real, const special::Numbers& x, special::Numbers& dx) {
    // Exact decimals: chaos amplifies even their rounding to 1e-10.
    constexpr Real mA = 0.01L, mB = 0.1L, LA = 0.075L, LB = 0.2L;
    constexpr Real Bx = 2500e-7L, By = 500e-7L, Bz = 2000e-7L;
    constexpr Real I0 = 50e-7L + mA * LA * LA + mB * LB * LB;
    const Real s = std::sin(x[1]), c = std::cos(x[1]);
    const Real weight = (mA * LA + mB * LB) * 9.81L * std::sin(x[0]);
    dx = {x[2], x[3],
          (2 * (Bx - By) * s * c * x[2] * x[3] - weight) / (I0 + Bx * c * c + By * s * s),
          -(Bx - By) * s * c * x[2] * x[2] / Bz};
  };
}
CaseReadings in_degrees(CaseReadings x) {
  x.resize(2);
  for (double& angle : x) angle /= kDegree;
  return x;
}

TrajectoryCase babyboot_motion() {
  const auto solved = solution_of(babyboot_rates(), {kPi / 2, kPi / 180, 0, 0});
  return {.scene = babyboot_scene,
          .times = {5, 10},
          .readings = {"rod [deg]", "plate [deg]"},
          .observe = [](ModelRef, StateRef x) { return in_degrees(x.q); },
          .reference = [solved](double t) { return in_degrees(solved(t)); }};
}
TrajectoryCase babyboot_rates_at_end() {
  TrajectoryCase c = babyboot_motion();
  c.times = {10};
  c.readings = {"rod [rad/s]", "plate [rad/s]", "rod [rad/s2]", "plate [rad/s2]"};
  c.observe = [](ModelRef model, StateRef x) {
    const std::vector<double> qdd = evaluate(model, x).qdd;
    return values(x.qd[0], x.qd[1], qdd[0], qdd[1]);
  };
  c.reference = [](double t) {
    special::Numbers dx(4);
    const special::Numbers x = special::solution(babyboot_rates(), {kPi / 2, kPi / 180, 0, 0}, t);
    babyboot_rates()(t, x, dx);
    return CaseReadings(dx.begin(), dx.end());
  };
  c.integration = dopri5_with(1e-13);
  return c;
}

}  // namespace

CaseFamily crossed_hinges_cases() {
  return {150,
          {{"C8", 1e-7, furuta_motion()},
           {"C8-start", 1e-12, furuta_evaluation()},
           {"C8-special", 1e-12, furuta_special()},
           {"C9", 1e-3, babyboot_motion()},
           {"C9-fine", 1e-5, integrated_by(rk4_with(2.5e-4), babyboot_motion())},
           {"C9-end", 1e-5, babyboot_rates_at_end()}}};
}

}  // namespace twinarm
