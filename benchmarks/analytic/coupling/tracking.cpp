// F3: the arm of planar_arm.h, uniform links of 5 and 3 kg, follows a kinematic robot by four
// couplings, through three sweeps of 1 s: angle 1 from 90 to -90 degrees and back, angle 2 from -45
// to 45. It starts at rest on the target's pose. With e = q_K - q of a joint, e_12 = e_1 + e_2:
//   joint   tau = k e + b e'                                   of each joint
//   world   tau_2 = k e_12 + b e_12',  tau_1 = tau_2 + k e_1 + b e_1'
//   linear  tau = sum_i J_i^T (k (p_K - p)_i + b (v_K - v)_i)  at the centres of mass
// The motion: M qdd + C = tau, solved in extended precision sweep by sweep, as the target's speed
// jumps at their ends. The largest and the mean errors come from an independent code, and so does
// the state at 3 s, which this solution meets
// (tests/benchmarks/analytic/registry/test_reference_digits.cpp).
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <mutex>
#include <numbers>

#include "benchmarks/analytic/joints/planar_arm.h"
#include "coupling/analysis/tracking.h"
#include "coupling/target/operator_motion.h"

namespace twinarm {
namespace {

using namespace smooth_parts;

enum class Law { world, joint, linear };
struct TrackedCoupling {
  Law law;
  double k, b;                              // of the spring on each link
  std::array<double, 2> max_deg, mean_deg;  // |e| of the joints over the 3 s
};
constexpr std::array<TrackedCoupling, 4> kTracked{{
    {Law::world, 1200, 40, {4.5491672, 3.5904684}, {0.23450014, 0.20688893}},
    {Law::joint, 1200, 40, {5.0608814, 1.0008448}, {0.33861819, 0.082941202}},
    {Law::linear, 22000, 400, {2.2315105, 2.147409}, {0.11838638, 0.33044263}},
    {Law::world, 300, 0, {13.51285, 11.86284}, {6.1254053, 4.6802616}},
}};
constexpr double kTrackingStep = 1e-4;  // of rk4 [s]

// ---- the reference ----

// q, and positions and velocities of the two centres of mass.
struct ArmPlace {
  long double q1, q2, qd1, qd2;
};
using PlanePoint = std::complex<long double>;
long double dot(const PlanePoint& a, const PlanePoint& b) {
  return a.real() * b.real() + a.imag() * b.imag();
}
// A link's direction, and what it turns into at a rate of 1.
PlanePoint along(long double angle) {
  return {std::cos(angle), std::sin(angle)};
}
PlanePoint across(long double angle) {
  return {-std::sin(angle), std::cos(angle)};
}

// The target in the sweep (0, 1, 2).
ArmPlace target(int sweep, long double t) {
  constexpr long double pi = std::numbers::pi_v<long double>;
  const long double direction = sweep % 2 == 0 ? 1 : -1, part = direction * (t - sweep - 0.5L);
  return {-pi * part, pi / 2 * part, -pi * direction, pi / 2 * direction};
}

special::Two linear_torques(const PlanarArm& arm, long double k, long double b, const ArmPlace& K,
                            const ArmPlace& D) {
  const long double l1 = arm.l1, c1 = arm.c1, c2 = arm.c2;
  const long double K12 = K.q1 + K.q2, D12 = D.q1 + D.q2;
  const long double Kd12 = K.qd1 + K.qd2, Dd12 = D.qd1 + D.qd2;
  const PlanePoint upper =
      k * c1 * (along(K.q1) - along(D.q1)) + b * c1 * (K.qd1 * across(K.q1) - D.qd1 * across(D.q1));
  const PlanePoint lower = k * (l1 * (along(K.q1) - along(D.q1)) + c2 * (along(K12) - along(D12))) +
                           b * (l1 * (K.qd1 * across(K.q1) - D.qd1 * across(D.q1)) +
                                c2 * (Kd12 * across(K12) - Dd12 * across(D12)));
  const long double second = c2 * dot(across(D12), lower);
  return {c1 * dot(across(D.q1), upper) + l1 * dot(across(D.q1), lower) + second, second};
}
special::Two coupling_torques(const TrackedCoupling& coupling, const PlanarArm& arm,
                              const ArmPlace& K, const ArmPlace& D) {
  const long double k = coupling.k, b = coupling.b;
  if (coupling.law == Law::linear) return linear_torques(arm, k, b, K, D);
  const long double first = k * (K.q1 - D.q1) + b * (K.qd1 - D.qd1);
  const long double second = k * (K.q2 - D.q2) + b * (K.qd2 - D.qd2);
  if (coupling.law == Law::joint) return {first, second};
  return {2 * first + second, first + second};
}

// q1, q2, qd1, qd2 after a time.
CaseReadings followed(const TrackedCoupling& coupling, double t) {
  const PlanarArm arm = uniform_arm();
  const ArmPlace start = target(0, 0);
  special::Numbers x{start.q1, start.q2, 0, 0};
  for (int sweep = 0; sweep < t; ++sweep) {
    const special::Rates rates = [&](long double since, const special::Numbers& now,
                                     special::Numbers& dx) {
      const ArmPlace D{now[0], now[1], now[2], now[3]};
      const special::Two tau = coupling_torques(coupling, arm, target(sweep, sweep + since), D);
      const special::Two qdd = accelerations_of(terms_of(arm, D.q2, D.qd1, D.qd2), tau);
      dx = {D.qd1, D.qd2, qdd.first, qdd.second};
    };
    // The fastest of the dampers takes a link along within 0.5 ms.
    x = special::solution(rates, x, std::min(1.0L, static_cast<long double>(t) - sweep),
                          1.0L / 1024);
  }
  return {x.begin(), x.end()};
}

// Kept, for it takes as long as a run and is asked for in every lane.
std::function<CaseReadings(double)> followed_once(const TrackedCoupling& coupling) {
  struct Known {
    std::mutex lock;
    std::map<double, CaseReadings> at;
  };
  return [coupling, known = std::make_shared<Known>()](double t) {
    const std::lock_guard held(known->lock);
    const auto found = known->at.find(t);
    return found != known->at.end() ? found->second : known->at[t] = followed(coupling, t);
  };
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

// Target and coupling, which keep the model of the target. They are functions of state and time.
class Leader final : public ForceSource, public Checkpointable {
 public:
  explicit Leader(const TrackedCoupling& coupling)
      : model_(model_of(uniform_arm())),
        hand_(HandMapping{}),
        kvr_(model_, hand_, HandMapping{}, {{"joint1", "joint2"}, "", 0, 0}),
        coupling_(make_coupling(coupling_spec(coupling), model_, kvr_)) {}
  void begin_step(const Kinematics& k, double t, double h) noexcept override {
    coupling_->begin_step(k, t, h);
  }
  void add_forces(const State<double>& x, const Kinematics& k,
                  Forces<double>& forces) noexcept override {
    coupling_->add_forces(x, k, forces);
  }
  std::vector<double> start() const { return kvr_.start().x.q; }

 private:
  Model<double> model_;
  AutomaticMotion hand_;
  TargetRobot kvr_;
  std::unique_ptr<Coupling> coupling_;
};

TrajectoryCase following(const TrackedCoupling& coupling) {
  return {.scene =
              [coupling] {
                const auto leader = std::make_shared<Leader>(coupling);
                CaseScene scene = start_at(model_of(uniform_arm()), leader->start(), {0, 0});
                scene.sources = {leader};
                scene.conserves = false;
                return scene;
              },
          .times = {0.05, 1.05, 2.05, 3},  // soon after its speed jumps, and at the end
          .readings = {"angle 1 [rad]", "angle 2 [rad]", "rate 1 [rad/s]", "rate 2 [rad/s]"},
          .observe = joint_state(),
          .reference = followed_once(coupling),
          .lane = rk4_lane(kTrackingStep),
          .mutant = more_inertia};
}

// |e| of the joints over the run, by the system that the study runs.
TrackingError tracked(const TrackedCoupling& coupling, bool mistaken) {
  CaseScene dvr = at_rest(model_of(uniform_arm()));
  if (mistaken) more_inertia(dvr);
  const Model<double> kvr = model_of(uniform_arm());
  const AutomaticMotion hand(HandMapping{});
  TrackingSetup setup;
  setup.kvr_model = &kvr;
  setup.dvr_model = &dvr.model;
  setup.hand = &hand;
  setup.joints.turned = {"joint1", "joint2"};
  setup.couplings = {coupling_spec(coupling)};
  setup.integrator = Integrator::rk4;
  setup.h = kTrackingStep;
  return tracking_error(TrackingSystem(setup).run());
}
double max_miss(const std::vector<double>& found, const std::array<double, 2>& wanted_deg) {
  return nan_max(std::abs(found[0] / kDegree - wanted_deg[0]),
                 std::abs(found[1] / kDegree - wanted_deg[1]));
}
// A motion, and the largest and the mean errors of its joints.
void add_coupling(const char* motion, const char* largest, const char* mean,
                  const TrackedCoupling& coupling, std::vector<AnalyticCase>& all) {
  all.push_back({motion, 1e-8, following(coupling)});
  all.push_back({largest, 1e-4, [coupling](bool mistaken) {
                   return CaseResult{max_miss(tracked(coupling, mistaken).max, coupling.max_deg)};
                 }});
  all.push_back({mean, 1e-5, [coupling](bool mistaken) {
                   return CaseResult{max_miss(tracked(coupling, mistaken).mean, coupling.mean_deg)};
                 }});
}

}  // namespace

CaseFamily tracking_cases() {
  std::vector<AnalyticCase> all;
  add_coupling("F3-world", "F3-world-largest", "F3-world-mean", kTracked[0], all);
  add_coupling("F3-joint", "F3-joint-largest", "F3-joint-mean", kTracked[1], all);
  add_coupling("F3-linear", "F3-linear-largest", "F3-linear-mean", kTracked[2], all);
  add_coupling("F3-undamped", "F3-undamped-largest", "F3-undamped-mean", kTracked[3], all);
  return {340, all};
}

}  // namespace twinarm
