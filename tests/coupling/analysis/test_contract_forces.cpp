// Force properties: consistent laws agree with their definition, action equals reaction, dampers
// dissipate, implicit discretizations converge to explicit ones as h -> 0. Exceptions by law are
// listed with their behaviour (docs/understand/coupling_laws.md).
#include <doctest/doctest.h>

#include "tests/coupling/analysis/laws.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// External wrench on the DVR about the world's origin, and joint forces.
struct Action {
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero(), joints = Vector3::Zero();
};
Action action_of(const Evaluated& all) {
  Action sum;
  for (std::size_t i = 1; i < all.forces.f_ext.size(); ++i) {
    const Vector3 f = all.D.R_WB[i] * to_eigen(all.forces.f_ext[i].f);
    sum.force += f;
    sum.moment += all.D.X_WL[i].p.cross(f) + all.D.R_WB[i] * to_eigen(all.forces.f_ext[i].n);
  }
  sum.joints = {all.forces.tau[0], all.forces.tau[1], all.forces.tau[2]};
  return sum;
}
// On the DVR, and on the KVR: the same law with exchanged robots.
std::pair<Action, Action> action_and_reaction(const CouplingSpec& spec, const Model<double>& model,
                                              const Vector3& q_K, const Vector3& qd_K,
                                              const Vector3& q, const Vector3& qd) {
  return {action_of(evaluated(spec, model, hand_at(q_K, qd_K), q, qd)),
          action_of(evaluated(spec, model, hand_at(q, qd), q_K, qd_K))};
}

// v_D - v_K of spring s.
Vector3 relative_velocity(const Law& law, const Model<double>& model, const Evaluated& all,
                          const Spring& s, const Vector3& qd_K, const Vector3& qd, bool turn) {
  const auto i = static_cast<std::size_t>(s.body);
  if (law.on_joint()) return {qd[s.body - 1] - qd_K[s.body - 1], 0, 0};
  if (law.is(CouplingType::equivalent_torsional))
    return point_jacobian(model, all.K, s.body, all.K.position(s.body, s.p_L)) * (qd - qd_K);
  if (turn) return all.D.w_WL[i] - all.K.w_WL[i];
  return all.D.velocity(s.body, all.D.position(s.body, s.p_L)) -
         all.K.velocity(s.body, all.K.position(s.body, s.p_L));
}
bool is_consistent(const Law& law) {
  return !law.printed && law.facts.is_spring_damper;
}

}  // namespace

TEST_CASE("the consistent couplings have the force J^T (k e + b e'), with the KVR moving or not") {
  Random random(7);
  for (const Law& law : all_laws()) {
    if (!is_consistent(law) || law.own || law.is(CouplingType::equivalent_torsional) ||
        law.is(CouplingType::weld) || law.discretization != Discretization::explicit_)
      continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(10, 2));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.9), qd = random.vector(3);
      const Vector3 qd_K = random.vector(3);
      const SteadyHand hand = hand_at(q_K, qd_K);
      Kinematics K(model), D(model);
      forward_kinematics(model, three_state(model, q_K, qd_K), K);
      forward_kinematics(model, three_state(model, q, qd), D);
      Vector3 expected = Vector3::Zero();
      const auto add_turn = [&](const Spring& s, double k, double b) {
        const auto i = static_cast<std::size_t>(s.body);
        const Eigen::AngleAxisd turn(K.X_WL[i].R * D.X_WL[i].R.transpose());
        const Vector3 T = k * turn.angle() * turn.axis() + b * (K.w_WL[i] - D.w_WL[i]);
        expected += rotation_jacobian(model, D, s.body).transpose() * T;
      };
      for (const Spring& s : spec.springs) {
        const Eigen::Index j = s.body - 1;
        if (law.is(CouplingType::linear) || law.in_six_dimensions()) {
          const Vector3 p_K = K.position(s.body, s.p_L), p_D = D.position(s.body, s.p_L);
          const Vector3 F =
              s.k * (p_K - p_D) + s.b * (K.velocity(s.body, p_K) - D.velocity(s.body, p_D));
          expected += point_jacobian(model, D, s.body, p_D).transpose() * F;
        }
        if (law.in_six_dimensions()) add_turn(s, s.k_rotational, s.b_rotational);
        if (law.on_orientation()) add_turn(s, s.k, s.b);
        if (law.on_joint()) expected[j] += s.k * (q_K[j] - q[j]) + s.b * (qd_K[j] - qd[j]);
      }
      CHECK((generalised_force(spec, model, hand, q, qd) - expected).norm() <
            1e-10 * expected.norm());
    }
  }
}

TEST_CASE("action equals reaction: springs of all laws except the equivalent torsional one") {
  Random random(8);
  const Vector3 rest = Vector3::Zero();
  for (const Law& law : all_laws()) {
    if (law.is(CouplingType::god_object)) continue;  // not a force between two bodies
    CAPTURE(law.name);
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.5);
      const auto [on, back] =
          action_and_reaction(spec_of(law, chain_springs(10, 2)), model, q_K, rest, q, rest);
      const double size = on.force.norm() + on.moment.norm() + on.joints.norm();
      CHECK(size > 0.01);
      CHECK((on.force + back.force).norm() < 1e-12 * size);
      CHECK((on.moment + back.moment).norm() < 1e-12 * size);
      // The equivalent torsional law has its stiffness from the KVR's pose.
      if (law.is(CouplingType::equivalent_torsional))
        CHECK((on.joints + back.joints).norm() > 1e-3 * size);
      else
        CHECK((on.joints + back.joints).norm() < 1e-12 * size);
    }
  }
}

TEST_CASE("action equals reaction of a relative damper; between two points except for e x F") {
  Random random(9);
  for (const Law& law : all_laws()) {
    if (!is_consistent(law) || law.is(CouplingType::equivalent_torsional) ||
        law.discretization != Discretization::explicit_)
      continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(0, 2));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.5);
      const Vector3 qd_K = random.vector(3), qd = random.vector(3);
      const auto [on, back] = action_and_reaction(spec, model, q_K, qd_K, q, qd);
      const double size = on.force.norm() + on.moment.norm() + on.joints.norm();
      if (law.is(CouplingType::weld)) {  // absolute damper
        CHECK((on.force + back.force).norm() > 1e-3 * size);
        continue;
      }
      // F at p_D and -F at p_K are a torque if F is not along p_K - p_D, without reaction.
      Vector3 left = Vector3::Zero();
      if (law.is(CouplingType::linear) || law.in_six_dimensions()) {
        const Evaluated all = evaluated(spec, model, hand_at(q_K, qd_K), q, qd);
        for (std::size_t s = 0; s < 3; ++s)
          left += (all.readings[s].p_D - all.readings[s].p_K).cross(all.readings[s].force_W);
        CHECK(left.norm() > 1e-4 * size);
      }
      CHECK((on.force + back.force).norm() < 1e-12 * size);
      CHECK((on.moment + back.moment - left).norm() < 1e-12 * size);
      CHECK((on.joints + back.joints).norm() < 1e-12 * size);
    }
  }
}

TEST_CASE("a damper alone, with the KVR at rest, never does positive work on the DVR") {
  Random random(4);
  for (const Law& law : all_laws()) {
    if (!is_consistent(law) || law.is(CouplingType::weld)) continue;  // test_mujoco_weld.cpp
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(0, 5));
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q = random.vector(3), qd = random.vector(10);
      const SteadyHand hand = hand_at(q + random.vector(0.5));
      CHECK(qd.dot(generalised_force(spec, model, hand, q, qd)) < 0);  // power
    }
  }
}

TEST_CASE("a relative damper dissipates energy of the relative motion, whatever the KVR's motion") {
  Random random(10);
  for (const Law& law : all_laws()) {
    if (!is_consistent(law) || law.is(CouplingType::weld)) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(0, 5));
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q = random.vector(3), qd = random.vector(10), qd_K = random.vector(10);
      const Evaluated all = evaluated(spec, model, hand_at(q + random.vector(0.5), qd_K), q, qd);
      for (std::size_t r = 0; r < all.readings.size(); ++r) {
        const SpringState& reading = all.readings[r];
        const bool turn = r >= 3 || law.on_orientation();
        const Vector3 force = law.on_joint() ? Vector3(reading.size, 0, 0) : reading.force_W;
        const Vector3 v = relative_velocity(law, model, all, spec.springs[r % 3], qd_K, qd, turn);
        // Targets at the end of the step have rotated by h.
        CHECK(force.dot(v) < 1e-2 * force.norm() * v.norm());
        if (law.discretization == Discretization::explicit_ && !law.own)
          CHECK(force.dot(v) == doctest::Approx(-force.norm() * v.norm()).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("the as-published torsional damper accelerates a DVR that is too fast: power > 0") {
  // A revolute joint rotates faster than its KVR in the same direction. The damper's torque does
  // not depend on which is faster.
  const Model<double> model = one_joint(JointType::revolute, 0.7);
  for (const double sign : {1.0, -1.0}) {
    CouplingSpec spec;
    spec.printed = true;
    spec.options.damping_sign = sign;
    spec.springs = {{"spring", 1, Vector3::Zero(), 0, 2}};
    SteadyHand hand;
    hand.rate[0] = 0.5;
    Coupled system(model, hand, {"joint1"}, spec, state_of(model, {0}, {sign > 0 ? 1.0 : 0.2}));
    for (int n = 0; n < 2; ++n) system.simulation.step(1e-4);  // velocities are differences
    const double relative = system.simulation.state().qd[0] - 0.5;
    const double force = system.coupling->readings()[0].force_W.z();
    CHECK(force * relative > 0.1);
  }
}

TEST_CASE("implicit discretizations converge to the explicit one with order 1 as h -> 0") {
  Random random(11);
  for (const Law& law : all_laws()) {
    if (law.discretization == Discretization::explicit_ && !law.is(CouplingType::stable_pd))
      continue;
    CAPTURE(law.name);
    Law plain = law;
    plain.discretization = Discretization::explicit_;
    if (law.own) plain.type = CouplingType::torsional, plain.measure = SpringSpace::joint;
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(1), q = q_K + random.vector(0.3), qd = random.vector(2);
      const SteadyHand hand = hand_at(q_K, {1, -2, 1.5});
      const auto end = [&](const Law& of, int steps) {
        Coupled system(model, hand, kThreeJoints, spec_of(of, chain_springs(20, 1)),
                       three_state(model, q, qd));
        for (int n = 0; n < steps; ++n) system.simulation.step(0.08 / steps);
        const State<double>& x = system.simulation.state();
        return Vector3(x.q[0], x.q[1], x.q[2]);
      };
      const double coarse = (end(law, 800) - end(plain, 800)).norm();
      const double fine = (end(law, 1600) - end(plain, 1600)).norm();
      CHECK(coarse > 1e-9);
      CHECK(coarse < 1e-2);
      CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));
    }
  }
}
