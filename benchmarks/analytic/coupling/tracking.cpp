// F3: the arm of planar_arm.h, uniform links of 5 and 3 kg, tracks a target robot by four
// couplings, in three sweeps of 1 s: angle 1 from 90 to -90 degrees and back, angle 2 from -45
// to 45. It starts at rest in the target's pose. With e = q_K - q of a joint, e_12 = e_1 + e_2:
//   joint   tau = k e + b e'                                   of each joint
//   world   tau_2 = k e_12 + b e_12',  tau_1 = tau_2 + k e_1 + b e_1'
//   linear  tau = sum_i J_i^T (k (p_K - p)_i + b (v_K - v)_i)  at the centres of mass
// M qdd + C = tau is solved in extended precision sweep by sweep, as the target's velocity jumps at
// their ends. The maximum and mean errors come from an independent code, and so does the state at 3
// s, with which this solution agrees
// (tests/benchmarks/analytic/registry/test_reference_digits.cpp).
#include <array>
#include <cmath>
#include <complex>

#include "benchmarks/analytic/joints/planar_arm.h"
#include "coupling/analysis/tracking.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {
namespace {

enum class Law { world, joint, linear };
struct TrackedCoupling {
  Law law;
  double k, b;                              // of the coupling on each link
  std::array<double, 2> max_deg, mean_deg;  // |e| of the joints over 3 s
};
constexpr std::array<TrackedCoupling, 4> kTracked{{
    {Law::world, 1200, 40, {4.5491672, 3.5904684}, {0.23450014, 0.20688893}},
    {Law::joint, 1200, 40, {5.0608814, 1.0008448}, {0.33861819, 0.082941202}},
    {Law::linear, 22000, 400, {2.2315105, 2.147409}, {0.11838638, 0.33044263}},
    {Law::world, 300, 0, {13.51285, 11.86284}, {6.1254053, 4.6802616}},
}};
constexpr double kTrackingStep = 1e-4;  // of rk4 [s]

// ---- the reference ----

struct ArmState {
  Real q1, q2, qd1, qd2;
};
using PlanePoint = std::complex<Real>;
Real dot(const PlanePoint& a, const PlanePoint& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
// Direction of a link, and its derivative with respect to the angle.
PlanePoint along(Real angle) {
  return {std::cos(angle), std::sin(angle)};
}
PlanePoint across(Real angle) {
  return {-std::sin(angle), std::cos(angle)};
}

// State of the target in sweep 0, 1 or 2.
ArmState target(int sweep, Real t) {
  const Real direction = sweep % 2 == 0 ? 1 : -1, part = direction * (t - sweep - 0.5L);
  return {-kPi * part, kPi / 2 * part, -kPi * direction, kPi / 2 * direction};
}

special::Two linear_torques(const PlanarArm& arm, Real k, Real b, const ArmState& K,
                            const ArmState& D) {
  const Real l1 = arm.l1, c1 = arm.c1, c2 = arm.c2;
  const Real K12 = K.q1 + K.q2, D12 = D.q1 + D.q2;
  const Real Kd12 = K.qd1 + K.qd2, Dd12 = D.qd1 + D.qd2;
  const PlanePoint upper =
      k * c1 * (along(K.q1) - along(D.q1)) + b * c1 * (K.qd1 * across(K.q1) - D.qd1 * across(D.q1));
  const PlanePoint lower = k * (l1 * (along(K.q1) - along(D.q1)) + c2 * (along(K12) - along(D12))) +
                           b * (l1 * (K.qd1 * across(K.q1) - D.qd1 * across(D.q1)) +
                                c2 * (Kd12 * across(K12) - Dd12 * across(D12)));
  const Real second = c2 * dot(across(D12), lower);
  return {c1 * dot(across(D.q1), upper) + l1 * dot(across(D.q1), lower) + second, second};
}
special::Two coupling_torques(const TrackedCoupling& coupling, const PlanarArm& arm,
                              const ArmState& K, const ArmState& D) {
  const Real k = coupling.k, b = coupling.b;
  if (coupling.law == Law::linear) return linear_torques(arm, k, b, K, D);
  const Real first = k * (K.q1 - D.q1) + b * (K.qd1 - D.qd1);
  const Real second = k * (K.q2 - D.q2) + b * (K.qd2 - D.qd2);
  if (coupling.law == Law::joint) return {first, second};
  return {2 * first + second, first + second};
}

// q1, q2, qd1, qd2 at t.
CaseReadings tracking_solution(const TrackedCoupling& coupling, double t) {
  const PlanarArm arm = uniform_arm();
  const ArmState start = target(0, 0);
  special::Numbers x{start.q1, start.q2, 0, 0};
  for (int sweep = 0; sweep < t; ++sweep) {
    const special::Rates rates = [&](Real since, const special::Numbers& now,
                                     special::Numbers& dx) {
      const ArmState D{now[0], now[1], now[2], now[3]};
      const special::Two tau = coupling_torques(coupling, arm, target(sweep, sweep + since), D);
      const special::Two qdd = accelerations_of(terms_of(arm, D.q2, D.qd1, D.qd2), tau);
      dx = {D.qd1, D.qd2, qdd.first, qdd.second};
    };
    // The fastest time constant is 0.5 ms.
    x = special::solution(rates, x, std::min(1.0L, Real(t) - sweep), 1.0L / 1024);
  }
  return {x.begin(), x.end()};
}

// ---- the run ----

CouplingSpec coupling_spec(const TrackedCoupling& coupling) {
  using Type = CouplingSpec::Type;
  const PlanarArm arm;
  CouplingSpec spec;
  spec.type = coupling.law == Law::linear ? Type::linear : Type::torsional;
  spec.measure = coupling.law == Law::joint ? SpringSpace::joint : SpringSpace::world;
  spec.springs = {{"arm1", 1, {arm.c1, 0, 0}, coupling.k, coupling.b},
                  {"arm2", 2, {arm.c2, 0, 0}, coupling.k, coupling.b}};
  return spec;
}

// Target robot, its model and the coupling: functions of state and time.
struct TargetCoupling {
  explicit TargetCoupling(const TrackedCoupling& given)
      : coupling(make_coupling(coupling_spec(given), model, kvr)) {}
  Model<double> model = model_of(uniform_arm());
  AutomaticMotion hand{OperatorMapping{}};
  TargetRobot kvr{model, hand, OperatorMapping{}, {{"joint1", "joint2"}, "", 0, 0}};
  std::unique_ptr<Coupling> coupling;
};

TrajectoryCase tracking_motion(const TrackedCoupling& coupling) {
  return {.scene =
              [coupling] {
                const auto whole = std::make_shared<TargetCoupling>(coupling);
                CaseScene scene = start_at(whole->model, whole->kvr.start().x.q, {0, 0});
                scene.sources = {std::shared_ptr<ForceSource>(whole, whole->coupling.get())};
                return not_conserving(scene);
              },
          .times = {0.05, 1.05, 2.05, 3},  // soon after each velocity step, and at the end
          .readings = {"angle 1 [rad]", "angle 2 [rad]", "rate 1 [rad/s]", "rate 2 [rad/s]"},
          .observe = joint_state(),
          .reference = cached([coupling](double t) { return tracking_solution(coupling, t); }),
          .integration = rk4_with(kTrackingStep),
          .mutant = more_inertia};
}

// |e| of the joints over the run, by the system that `twinarm study` uses.
TrackingError tracked(const TrackedCoupling& coupling, bool is_mutant) {
  CaseScene dvr = at_rest(model_of(uniform_arm()));
  if (is_mutant) more_inertia(dvr);
  const Model<double> kvr = model_of(uniform_arm());
  const AutomaticMotion hand(OperatorMapping{});
  TrackingSetup setup;
  setup.kvr_model = &kvr;
  setup.dvr_model = &dvr.model;
  setup.motion = &hand;
  setup.joints.turned = {"joint1", "joint2"};
  setup.couplings = {coupling_spec(coupling)};
  setup.integrator = Integrator::rk4;
  setup.h = kTrackingStep;
  return tracking_error(TrackingSystem(setup).run());
}
double max_error(const std::vector<double>& found, const std::array<double, 2>& exact_deg) {
  return nan_max(std::abs(found[0] / kDegree - exact_deg[0]),
                 std::abs(found[1] / kDegree - exact_deg[1]));
}
// A motion, and the maximum and mean errors of its joints.
void add_coupling(const std::string& name, const TrackedCoupling& coupling,
                  std::vector<AnalyticCase>& all) {
  all.push_back({name, 1e-8, tracking_motion(coupling)});
  all.push_back({name + "-largest", 1e-4, [coupling](bool is_mutant) {
                   return CaseResult{max_error(tracked(coupling, is_mutant).max, coupling.max_deg)};
                 }});
  all.push_back({name + "-mean", 1e-5, [coupling](bool is_mutant) {
                   return CaseResult{
                       max_error(tracked(coupling, is_mutant).mean, coupling.mean_deg)};
                 }});
}

}  // namespace

CaseFamily tracking_cases() {
  std::vector<AnalyticCase> all;
  add_coupling("F3-world", kTracked[0], all);
  add_coupling("F3-joint", kTracked[1], all);
  add_coupling("F3-linear", kTracked[2], all);
  add_coupling("F3-undamped", kTracked[3], all);
  return {340, all};
}

}  // namespace twinarm
