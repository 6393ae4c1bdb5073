// Properties of every coupling: rejects invalid gains, rests at zero error, is the gradient of its
// energy, is independent of the world's axes.
#include <doctest/doctest.h>

#include <limits>

#include "solver/support/diagnostics.h"
#include "tests/coupling/analysis/laws.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Energy stored in the springs, from the law's formula.
double stored(const CouplingSpec& spec, const Law& law, const Model<double>& model,
              const Vector3& q_K, const Vector3& q) {
  Kinematics K(model), D(model);
  forward_kinematics(model, three_state(model, q_K, Vector3::Zero()), K);
  forward_kinematics(model, three_state(model, q, Vector3::Zero()), D);
  double U = 0;
  for (const Spring& s : spec.springs) {
    const auto i = static_cast<std::size_t>(s.body);
    const double e = q_K[s.body - 1] - q[s.body - 1];
    const double angle = Eigen::AngleAxisd(K.X_WL[i].R * D.X_WL[i].R.transpose()).angle();
    if (law.is(CouplingType::linear) || law.in_six_dimensions())
      U += 0.5 * s.k * (K.position(s.body, s.p_L) - D.position(s.body, s.p_L)).squaredNorm();
    if (law.is(CouplingType::equivalent_torsional)) {
      const Eigen::Matrix3Xd J = point_jacobian(model, K, s.body, K.position(s.body, s.p_L));
      U += 0.5 * s.k * (J * (q_K - q)).squaredNorm();
    }
    if (law.on_orientation()) U += 0.5 * s.k * angle * angle;
    if (law.in_six_dimensions()) U += 0.5 * s.k_rotational * angle * angle;
    if (law.on_joint()) U += 0.5 * s.k * e * e;
  }
  return U;
}

}  // namespace

TEST_CASE("every coupling rejects negative and undefined gains, all springs at once") {
  const Model<double> model = chain_of_three(1);
  const SteadyHand hand;
  TargetRobot kvr(model, hand, SteadyHand::mapping(), {kThreeJoints, "", 0, 0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Law& law : all_laws()) {
    CAPTURE(law.name);
    std::vector<Spring> bad = chain_springs(10, 1);
    bad[0].k = -1;
    bad[2].k = nan;
    bad[2].b = -2;
    bad[2].k_rotational = -3;
    try {
      make_coupling(spec_of(law, bad), model, kvr);
      FAIL("not refused");
    } catch (const InputError& error) {
      CHECK(error.faults().size() == 4);
      const std::string text = error.what();
      CHECK(text.find("first") != std::string::npos);
      CHECK(text.find("second") == std::string::npos);
      CHECK(text.find("third") != std::string::npos);
      CHECK(text.find(law.name) != std::string::npos);
    }
    for (int body : {-1, 0, 4}) {
      bad = chain_springs(10, 1);
      bad[1].body = body;
      CHECK_THROWS_AS(make_coupling(spec_of(law, bad), model, kvr), InputError);
    }
    CHECK_NOTHROW(make_coupling(spec_of(law, chain_springs(0, 0)), model, kvr));
  }
}

TEST_CASE("no coupling moves a DVR at rest on a KVR at rest") {
  Random random(2);
  for (const Law& law : all_laws())
    for (unsigned seed = 0; seed < 5; ++seed) {
      CAPTURE(law.name);
      const Model<double> model = chain_of_three(seed);
      const Vector3 q = random.vector(3);
      Coupled system(model, hand_at(q), kThreeJoints, spec_of(law, chain_springs(1e4, 100)),
                     three_state(model, q, Vector3::Zero()));
      for (int n = 0; n < 5; ++n) system.simulation.step(1e-3);
      for (std::size_t j = 0; j < 3; ++j) CHECK(std::abs(system.simulation.state().qd[j]) < 1e-10);
    }
}

TEST_CASE("without damping every coupling has the force -dU/dq at the start of a step") {
  Random random(3);
  for (const Law& law : all_laws()) {
    // Over the step, the force of implicit springs is F - m* J qdd.
    if (law.discretization != Discretization::explicit_ || !law.facts.is_spring_damper) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(10, 0));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.9);
      const Vector3 force = generalised_force(spec, model, hand_at(q_K), q, Vector3::Zero());
      const auto U = [&](const Vector3& at) {
        return Vector3(stored(spec, law, model, q_K, at), 0, 0);
      };
      const Vector3 slope = derivative(U, q, 1e-5).row(0);
      CHECK(force.norm() > 0.01);
      CHECK((force + slope).norm() < 1e-7 * (1 + force.norm()));
    }
  }
}

TEST_CASE("moving base and KVR together does not change the joint motion under any coupling") {
  Random random(5);
  for (const Law& law : all_laws())
    for (unsigned seed = 0; seed < 3; ++seed) {
      CAPTURE(law.name);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.5), qd = random.vector(3);
      const SteadyHand hand = hand_at(q_K, {1, -2, 1.5});
      const auto end = [&](const Pose& X_W) {
        const Model<double> model = chain_of_three(seed, X_W);
        Coupled system(model, hand, kThreeJoints, spec_of(law, chain_springs(50, 1)),
                       three_state(model, q, qd));
        for (int n = 0; n < 50; ++n) system.simulation.step(1e-3);
        const State<double>& x = system.simulation.state();
        return Vector3(x.qd[0], x.qd[1], x.qd[2]);
      };
      const Vector3 straight = end({});
      CHECK((straight - qd).norm() > 1e-2);
      CHECK((end({random.rotation(), random.vector(5)}) - straight).norm() <
            1e-9 * straight.norm());
    }
}

TEST_CASE("joint_space is the derivative of the joint force at zero error") {
  Random random(6);
  for (const Law& law : all_laws()) {
    // The weld's damping adds inertia (test_mujoco_weld.cpp), stable PD has a position lead.
    if (law.discretization != Discretization::explicit_ || law.is(CouplingType::god_object))
      continue;
    const bool springs_alone = law.printed || law.own || law.is(CouplingType::weld);
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, chain_springs(10, springs_alone ? 0 : 0.6));
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Model<double> model = chain_of_three(seed);
      const Vector3 q_K = random.vector(2);
      const SteadyHand hand = hand_at(q_K);
      Coupled system(model, hand, kThreeJoints, spec, three_state(model, q_K, Vector3::Zero()));
      const auto space = system.coupling->joint_space(system.simulation.kinematics());
      const auto force = [&](const Vector3& q, const Vector3& qd) {
        return generalised_force(spec, model, hand, q, qd);
      };
      const auto by_q = [&](const Vector3& q) { return force(q, Vector3::Zero()); };
      const auto by_qd = [&](const Vector3& qd) { return force(q_K, qd); };
      CHECK((derivative(by_q, q_K, 1e-4) + space.K).norm() < 1e-6 * space.K.norm());
      if (springs_alone) continue;
      CHECK((derivative(by_qd, Vector3::Zero(), 1e-3) + space.B).norm() < 1e-8 * space.B.norm());
    }
  }
}
