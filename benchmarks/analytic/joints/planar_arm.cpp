// F2: mass matrix, velocity terms and accelerations of a planar two-link arm in ten states, against
// the closed form of planar_arm.h.
#include "benchmarks/analytic/joints/planar_arm.h"

#include "solver/dynamics/dynamics.h"

namespace twinarm {

Model<double> model_of(const PlanarArm& arm) {
  const auto link = [](double mass, double com, double inertia) {
    return BodyInertia{mass, {com, 0, 0}, Vector3(0.01 * inertia, inertia, inertia).asDiagonal()};
  };
  ModelBuilder builder;
  const int upper = builder.add_body("arm1", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(),
                                     link(arm.m1, arm.c1, arm.I1));
  builder.add_body("arm2", upper, "joint2", JointType::revolute,
                   {Matrix3::Identity(), {arm.l1, 0, 0}}, Vector3::UnitZ(),
                   link(arm.m2, arm.c2, arm.I2));
  return builder.build();
}

PlanarArmTerms terms_of(const PlanarArm& arm, Real q2, Real qd1, Real qd2) {
  const Real m1 = arm.m1, m2 = arm.m2, l1 = arm.l1, c1 = arm.c1, c2 = arm.c2;
  const Real cosine = std::cos(q2), h = m2 * l1 * c2 * std::sin(q2);
  return {.M11 = arm.I1 + m1 * c1 * c1 + arm.I2 + m2 * (l1 * l1 + c2 * c2 + 2 * l1 * c2 * cosine),
          .M12 = arm.I2 + m2 * (c2 * c2 + l1 * c2 * cosine),
          .M22 = arm.I2 + m2 * c2 * c2,
          .C1 = -h * (2 * qd1 * qd2 + qd2 * qd2),
          .C2 = h * qd1 * qd1};
}

namespace {

constexpr int kArmStates = 10;

struct ArmState {
  double q1, q2, qd1, qd2, tau1, tau2;
};
ArmState arm_state(int n) {  // well distributed
  return {3 * std::sin(3. * n + 1), 3 * std::sin(5. * n + 2),   4 * std::sin(7. * n + 3),
          6 * std::sin(11. * n),    20 * std::sin(13. * n + 5), 10 * std::sin(17. * n + 6)};
}

// Readings of all states, concatenated.
template <class F>
CaseReadings in_all_states(F&& readings) {
  CaseReadings all;
  for (int n = 0; n < kArmStates; ++n)
    for (const double value : readings(arm_state(n))) all.push_back(value);
  return all;
}
std::vector<std::string> names_in_all_states(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (int n = 1; n <= kArmStates; ++n)
    for (const std::string& name : names) all.push_back(name + " in state " + std::to_string(n));
  return all;
}
State<double> state_of(const Model<double>& model, const ArmState& s) {
  State<double> x(model);
  x.q = {s.q1, s.q2};
  x.qd = {s.qd1, s.qd2};
  return x;
}

// Mutant: the centre of mass of link 2 0.1 % further out.
void shift_com(CaseScene& scene) {
  scene.model.I.back().h = 1.001 * scene.model.I.back().h;
}

using ArmReadings = CaseReadings (*)(const Model<double>& model, const ArmState& s);
TrajectoryCase arm_case(const std::vector<std::string>& readings, ArmReadings seen,
                        CaseReadings (*exact)(const ArmState& s, const PlanarArmTerms& terms)) {
  TrajectoryCase c = evaluation(
      at_rest(model_of({})), names_in_all_states(readings),
      [seen](ModelRef model, StateRef) {
        return in_all_states([&](const ArmState& s) { return seen(model, s); });
      },
      in_all_states(
          [exact](const ArmState& s) { return exact(s, terms_of({}, s.q2, s.qd1, s.qd2)); }));
  c.mutant = shift_com;
  return c;
}
CaseReadings torques_at_rate(const Model<double>& model, const ArmState& s) {
  return inverse_dynamics(model, state_of(model, s), {0, 0});
}

TrajectoryCase arm_mass_matrix() {
  return arm_case(
      {"M11 [kg m^2]", "M12 [kg m^2]", "M22 [kg m^2]"},
      [](const Model<double>& model, const ArmState& s) {
        const Eigen::MatrixXd M = mass_matrix(model, state_of(model, s));
        return values(M(0, 0), M(0, 1), M(1, 1));
      },
      [](const ArmState&, const PlanarArmTerms& terms) {
        return values(terms.M11, terms.M12, terms.M22);
      });
}

TrajectoryCase velocity_terms() {
  return arm_case(
      {"C1 [N m]", "C2 [N m]"}, torques_at_rate,
      [](const ArmState&, const PlanarArmTerms& terms) { return values(terms.C1, terms.C2); });
}

TrajectoryCase arm_accelerations() {
  return arm_case(
      {"q1'' [rad/s^2]", "q2'' [rad/s^2]"},
      [](const Model<double>& model, const ArmState& s) {
        return evaluate(model, state_of(model, s), {s.tau1, s.tau2}).qdd;
      },
      [](const ArmState& s, const PlanarArmTerms& terms) {
        const special::Two qdd = accelerations_of(terms, {s.tau1, s.tau2});
        return values(qdd.first, qdd.second);
      });
}

TrajectoryCase no_weight() {
  TrajectoryCase c = arm_case(
      {"G1 [N m]", "G2 [N m]"},
      [](const Model<double>& model, const ArmState& s) {
        return torques_at_rate(model, {s.q1, s.q2, 0, 0, 0, 0});
      },
      [](const ArmState&, const PlanarArmTerms&) { return values(0, 0); });
  c.measure = max_difference;
  c.mutant = [](CaseScene& scene) { scene.model.gravity.x = 1e-3 * kGravity; };
  return c;
}

}  // namespace

CaseFamily planar_arm_cases() {
  return {330,
          {{"F2", 1e-12, arm_mass_matrix()},
           {"F2-velocity", 1e-12, velocity_terms()},
           {"F2-forward", 1e-12, arm_accelerations()},
           {"F2-weight", 1e-12, no_weight()}}};
}

}  // namespace twinarm
