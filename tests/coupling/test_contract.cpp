// What every coupling owes, whatever its law. The list at the top is what exists; a new coupling
// is tested by being added to it.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <functional>
#include <limits>

#include "coupling/prediction.h"
#include "solver/dynamics.h"
#include "solver/fault.h"
#include "tests/coupling/one_joint.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

using Type = CouplingSpec::Type;

const std::vector<std::string> kJoints{"joint1", "joint2", "joint3"};

struct Law {
  const char* name;
  Type type;
  Measure measure;
  bool printed;
  Treatment treatment;
};
constexpr Law kLaws[] = {
    {"torsional world", Type::torsional, Measure::world, false, Treatment::explicit_},
    {"torsional joint", Type::torsional, Measure::joint, false, Treatment::explicit_},
    {"linear", Type::linear, Measure::world, false, Treatment::explicit_},
    {"matched", Type::matched, Measure::joint, false, Treatment::explicit_},
    {"printed torsional world", Type::torsional, Measure::world, true, Treatment::explicit_},
    {"printed torsional joint", Type::torsional, Measure::joint, true, Treatment::explicit_},
    {"printed linear", Type::linear, Measure::world, true, Treatment::explicit_},
    {"semi-implicit world", Type::torsional, Measure::world, false, Treatment::semi_implicit},
    {"semi-implicit linear", Type::linear, Measure::world, false, Treatment::semi_implicit},
    {"implicit world", Type::torsional, Measure::world, false, Treatment::implicit},
    {"implicit joint", Type::torsional, Measure::joint, false, Treatment::implicit},
    {"implicit linear", Type::linear, Measure::world, false, Treatment::implicit},
};

CouplingSpec spec_of(const Law& law, std::vector<Spring> springs) {
  CouplingSpec spec;
  spec.name = law.name;
  spec.type = law.type;
  spec.printed = law.printed;
  spec.measure = spec.options.measure = law.measure;
  spec.treatment = law.treatment;
  spec.springs = std::move(springs);
  return spec;
}
std::vector<Spring> springs(double k, double b) {
  return {{"first", 1, {0.2, 0.1, -0.1}, k, b},
          {"second", 2, {-0.1, 0.2, 0.1}, 0.5 * k, 2 * b},
          {"third", 3, {0.1, 0, 0.2}, 0.3 * k, 0.7 * b}};
}

// Three hinges in random directions, the whole of it turned by `turn` about the world's origin.
Model<double> chain(unsigned seed, const Matrix3& turn = Matrix3::Identity()) {
  Random random(seed);
  ModelBuilder builder;
  builder.set_gravity(Vector3::Zero());
  for (int i = 1; i <= 3; ++i) {
    Pose X{random.rotation(), random.vector(0.4)};
    if (i == 1) X = Pose{turn, Vector3::Zero()} * X;
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, X, random.vector(1), random.inertia());
  }
  return builder.build();
}
SteadyHand hand_at(const Vector3& q, const Vector3& qd = Vector3::Zero()) {
  SteadyHand hand;
  hand.angle = {q[0], q[1], q[2]};
  hand.rate = {qd[0], qd[1], qd[2]};
  return hand;
}
State<double> state(const Model<double>& model, const Vector3& q, const Vector3& qd) {
  return state_of(model, {q[0], q[1], q[2]}, {qd[0], qd[1], qd[2]});
}

// The generalised force of a fresh coupling: M times what it changes in the accelerations.
Vector3 generalised_force(const CouplingSpec& spec, const Model<double>& model,
                          const SteadyHand& hand, const Vector3& q, const Vector3& qd) {
  KinematicRobot kvr(model, hand, SteadyHand::mapping(), {kJoints, "", 0, 0});
  const auto coupling = make_coupling(spec, model, kvr);
  const State<double> x = state(model, q, qd);
  Kinematics k(model);
  forward_kinematics(model, x, k);
  Forces<double> with(model), without(model);
  coupling->begin_step(k, 0, 1e-3);
  coupling->add_forces(x, k, with);
  const auto qdd = [&](const Forces<double>& forces) {
    Workspace<double> w(model);
    aba(model, x, forces, w);
    return Vector3(w.qdd[0], w.qdd[1], w.qdd[2]);
  };
  return mass_matrix(model, x) * (qdd(with) - qdd(without));
}

// The energy stored in the springs, from the law's own formula.
double stored(const CouplingSpec& spec, const Model<double>& model, const Vector3& q_K,
              const Vector3& q) {
  Kinematics K(model), D(model);
  forward_kinematics(model, state(model, q_K, Vector3::Zero()), K);
  forward_kinematics(model, state(model, q, Vector3::Zero()), D);
  double U = 0;
  for (const Spring& s : spec.springs) {
    const auto i = static_cast<std::size_t>(s.body);
    if (spec.type == Type::linear) {
      U += 0.5 * s.k * (K.position(s.body, s.p_L) - D.position(s.body, s.p_L)).squaredNorm();
    } else if (spec.type == Type::matched) {
      const Eigen::Matrix3Xd J = point_jacobian(model, K, s.body, K.position(s.body, s.p_L));
      U += 0.5 * s.k * (J * (q_K - q)).squaredNorm();
    } else if (spec.measure == Measure::world) {
      const double angle = Eigen::AngleAxisd(K.X_WL[i].R * D.X_WL[i].R.transpose()).angle();
      U += 0.5 * s.k * angle * angle;
    } else {
      const double e = q_K[s.body - 1] - q[s.body - 1];
      U += 0.5 * s.k * e * e;
    }
  }
  return U;
}

// f by central differences, column by column.
Matrix3 derivative(const std::function<Vector3(const Vector3&)>& f, const Vector3& x, double step) {
  Matrix3 D;
  for (Eigen::Index j = 0; j < 3; ++j) {
    const Vector3 e = step * Vector3::Unit(j);
    D.col(j) = (f(x + e) - f(x - e)) / (2 * step);
  }
  return D;
}

}  // namespace

TEST_CASE("every coupling refuses negative and undefined gains, all springs at fault at once") {
  const Model<double> model = chain(1);
  const SteadyHand hand;
  KinematicRobot kvr(model, hand, SteadyHand::mapping(), {kJoints, "", 0, 0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Law& law : kLaws) {
    CAPTURE(law.name);
    std::vector<Spring> bad = springs(10, 1);
    bad[0].k = -1;
    bad[2].k = nan;
    bad[2].b = -2;
    try {
      make_coupling(spec_of(law, bad), model, kvr);
      FAIL("not refused");
    } catch (const InputError& error) {
      CHECK(error.faults().size() == 3);
      const std::string text = error.what();
      CHECK(text.find("first") != std::string::npos);
      CHECK(text.find("second") == std::string::npos);
      CHECK(text.find("third") != std::string::npos);
      CHECK(text.find(law.name) != std::string::npos);
    }
    for (int body : {-1, 0, 4}) {
      bad = springs(10, 1);
      bad[1].body = body;
      CHECK_THROWS_AS(make_coupling(spec_of(law, bad), model, kvr), InputError);
    }
    CHECK_NOTHROW(make_coupling(spec_of(law, springs(0, 0)), model, kvr));
  }
}

TEST_CASE("no coupling moves a DVR that rests on a KVR at rest") {
  Random random(2);
  for (const Law& law : kLaws)
    for (unsigned seed = 0; seed < 5; ++seed) {
      CAPTURE(law.name);
      const Model<double> model = chain(seed);
      const Vector3 q = random.vector(3);
      Coupled system(model, hand_at(q), kJoints, spec_of(law, springs(1e4, 100)),
                     state(model, q, Vector3::Zero()));
      for (int n = 0; n < 5; ++n) system.simulation.step(1e-3);
      for (std::size_t j = 0; j < 3; ++j) CHECK(std::abs(system.simulation.state().qd[j]) < 1e-10);
    }
}

TEST_CASE("without damping the force of every explicit coupling is -dU/dq") {
  Random random(3);
  for (const Law& law : kLaws) {
    if (law.treatment != Treatment::explicit_) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, springs(10, 0));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.9);
      const Vector3 force = generalised_force(spec, model, hand_at(q_K), q, Vector3::Zero());
      const auto U = [&](const Vector3& at) { return Vector3(stored(spec, model, q_K, at), 0, 0); };
      const Vector3 slope = derivative(U, q, 1e-5).row(0);
      CHECK(force.norm() > 0.1);
      CHECK((force + slope).norm() < 1e-7 * (1 + force.norm()));
    }
  }
}

TEST_CASE("a damper alone, against a KVR at rest, never does work on the DVR") {
  Random random(4);
  for (const Law& law : kLaws) {
    if (law.printed) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, springs(0, 5));
    for (unsigned seed = 0; seed < 20; ++seed) {
      const Model<double> model = chain(seed);
      const Vector3 q = random.vector(3), qd = random.vector(10);
      const SteadyHand hand = hand_at(q + random.vector(0.5));
      CHECK(qd.dot(generalised_force(spec, model, hand, q, qd)) < 0);  // power
    }
  }
}

TEST_CASE(
    "the consistent couplings pull with J^T (k e + b e') at the DVR's end, KVR moving or not") {
  Random random(7);
  for (const Law& law : kLaws) {
    if (law.printed || law.type == Type::matched || law.treatment != Treatment::explicit_) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, springs(10, 2));
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Model<double> model = chain(seed);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.9), qd = random.vector(3);
      const Vector3 qd_K = random.vector(3);
      const SteadyHand hand = hand_at(q_K, qd_K);
      Kinematics K(model), D(model);
      forward_kinematics(model, state(model, q_K, qd_K), K);
      forward_kinematics(model, state(model, q, qd), D);
      Vector3 expected = Vector3::Zero();
      for (const Spring& s : spec.springs) {
        const auto i = static_cast<std::size_t>(s.body);
        if (law.type == Type::linear) {
          const Vector3 p_K = K.position(s.body, s.p_L), p_D = D.position(s.body, s.p_L);
          const Vector3 F =
              s.k * (p_K - p_D) + s.b * (K.velocity(s.body, p_K) - D.velocity(s.body, p_D));
          expected += point_jacobian(model, D, s.body, p_D).transpose() * F;
        } else if (law.measure == Measure::world) {
          const Eigen::AngleAxisd turn(K.X_WL[i].R * D.X_WL[i].R.transpose());
          const Vector3 T = s.k * turn.angle() * turn.axis() + s.b * (K.w_WL[i] - D.w_WL[i]);
          expected += rotation_jacobian(model, D, s.body).transpose() * T;
        } else {
          const Eigen::Index j = s.body - 1;
          expected[j] += s.k * (q_K[j] - q[j]) + s.b * (qd_K[j] - qd[j]);
        }
      }
      CHECK((generalised_force(spec, model, hand, q, qd) - expected).norm() <
            1e-10 * expected.norm());
    }
  }
}

TEST_CASE("turning base and KVR together leaves the joints' motion under every coupling as it is") {
  Random random(5);
  for (const Law& law : kLaws)
    for (unsigned seed = 0; seed < 3; ++seed) {
      CAPTURE(law.name);
      const Vector3 q_K = random.vector(2), q = q_K + random.vector(0.5), qd = random.vector(3);
      const SteadyHand hand = hand_at(q_K, {1, -2, 1.5});
      const auto end = [&](const Matrix3& turn) {
        const Model<double> model = chain(seed, turn);
        Coupled system(model, hand, kJoints, spec_of(law, springs(50, 1)), state(model, q, qd));
        for (int n = 0; n < 50; ++n) system.simulation.step(1e-3);
        const State<double>& x = system.simulation.state();
        return Vector3(x.qd[0], x.qd[1], x.qd[2]);
      };
      const Vector3 straight = end(Matrix3::Identity());
      CHECK((straight - qd).norm() > 1e-2);
      CHECK((end(random.rotation()) - straight).norm() < 1e-9 * straight.norm());
    }
}

TEST_CASE("joint_space is how the generalised force changes with the DVR about zero offset") {
  Random random(6);
  for (const Law& law : kLaws) {
    if (law.treatment != Treatment::explicit_) continue;
    CAPTURE(law.name);
    const CouplingSpec spec = spec_of(law, springs(10, 0.6));
    for (unsigned seed = 0; seed < 5; ++seed) {
      const Model<double> model = chain(seed);
      const Vector3 q_K = random.vector(2);
      const SteadyHand hand = hand_at(q_K);
      Coupled system(model, hand, kJoints, spec, state(model, q_K, Vector3::Zero()));
      const auto space = system.coupling->joint_space(system.simulation.kinematics());
      const auto force = [&](const Vector3& q, const Vector3& qd) {
        return generalised_force(spec, model, hand, q, qd);
      };
      const auto by_q = [&](const Vector3& q) { return force(q, Vector3::Zero()); };
      const auto by_qd = [&](const Vector3& qd) { return force(q_K, qd); };
      CHECK((derivative(by_q, q_K, 1e-4) + space.K).norm() < 1e-6 * space.K.norm());
      if (law.printed) continue;  // its velocities are differences: none at the first step
      CHECK((derivative(by_qd, Vector3::Zero(), 1e-3) + space.B).norm() < 1e-8 * space.B.norm());
    }
  }
}
