// Where the implicit treatment has something left that is explicit: a long chain that moves fast
// (velocity products), and a point spring whose target lies far out (geometric stiffness).
#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "coupling/prediction.h"
#include "solver/energy.h"
#include "tests/coupling/one_joint.h"
#include "tests/solver/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Twenty links, hinges in all directions.
Model<double> long_chain(Random& random) {
  ModelBuilder builder;
  for (int i = 1; i <= 20; ++i)
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, {random.rotation(), {0.15, 0, 0}}, random.vector(1),
                     {0.5, {0.075, 0, 0}, 0.001 * Vector3(1, 2, 2).asDiagonal().toDenseMatrix()});
  return builder.build();
}

}  // namespace

TEST_CASE("a chain of 20 links that moves fast stays bounded implicitly at w h from 10 to 100") {
  Random random(21);
  const Model<double> model = long_chain(random);
  const double h = 1e-3;
  SteadyHand hand;
  hand.rate = {3, -2, 4};  // of the first three joints: all links outward are swept along
  State<double> start(model);
  for (double& qd : start.qd) qd = random.uniform(-20, 20);
  for (const bool point : {true, false})
    for (double wh : {10.0, 30.0, 100.0}) {
      CAPTURE(point);
      CAPTURE(wh);
      CouplingSpec spec;
      spec.type = point ? CouplingSpec::Type::linear : CouplingSpec::Type::torsional;
      spec.treatment = Treatment::implicit;
      for (int i = 1; i <= 20; ++i)
        spec.springs.push_back({"spring" + std::to_string(i), i, {0.1, 0.02, 0}, 1, 0});
      Coupled unit(model, hand, {"joint1", "joint2", "joint3"}, spec, start);
      const double per_gain =
          squared_frequencies(mass_matrix(model, start),
                              unit.coupling->joint_space(unit.simulation.kinematics()).K)
              .maxCoeff();
      for (Spring& spring : spec.springs) {
        spring.k = wh * wh / (h * h) / per_gain;
        spring.b = 2 * 0.7 * spring.k * h / wh;
      }
      Coupled system(model, hand, {"joint1", "joint2", "joint3"}, spec, start);
      const double energy_at_start = kinetic_energy(model, start);
      double largest = 0;
      bool finite = true;
      for (int n = 0; n < 1000 && finite; ++n) {
        finite = system.simulation.step(h).finite;
        largest = std::max(largest, kinetic_energy(model, system.simulation.state()));
      }
      CHECK(finite);
      CHECK(largest < 2 * energy_at_start);
      // The chain has come to follow the hand, to the sag of gravity and of centrifugal forces.
      const State<double>& x = system.simulation.state();
      CHECK(std::abs(x.q[0] - 3) < 0.05);
      CHECK(std::abs(x.qd[0] - 3) < 0.5);
    }
}

TEST_CASE("one implicit step of a moving chain solves (M + h B + h^2 K) qdd = tau, to 1e-9") {
  Random random(22);
  const Model<double> model = long_chain(random);
  const auto n = static_cast<Eigen::Index>(model.nv);
  const double h = 2e-3, k = 3e4, b = 70;
  for (int trial = 0; trial < 10; ++trial)
    for (const bool point : {true, false}) {
      SteadyHand hand;
      hand.angle = {0.3, -0.2, 0.4};
      hand.rate = {3, -2, 4};
      State<double> x(model);
      for (double& q : x.q) q = random.uniform(-0.1, 0.1);
      for (double& qd : x.qd) qd = random.uniform(-10, 10);
      CouplingSpec spec;
      spec.type = point ? CouplingSpec::Type::linear : CouplingSpec::Type::torsional;
      spec.treatment = Treatment::implicit;
      for (const int body : {4, 11, 20})
        spec.springs.push_back({"spring", body, {0.1, 0.02, -0.05}, k, b});

      const auto qdd_of = [&](Simulation& simulation) {
        simulation.step(h);
        return Eigen::VectorXd((Eigen::Map<const Eigen::VectorXd>(simulation.state().qd.data(), n) -
                                Eigen::Map<const Eigen::VectorXd>(x.qd.data(), n)) /
                               h);
      };
      Simulation alone(model, x);
      const Eigen::VectorXd free = qdd_of(alone);  // no spring: M free = -bias
      Coupled system(model, hand, {"joint1", "joint2", "joint3"}, spec, x);
      const Kinematics D = system.simulation.kinematics();
      const Eigen::VectorXd qdd = qdd_of(system.simulation);
      const Kinematics& K = system.kvr.end().k;  // where the hand is at the end of the step

      Eigen::MatrixXd felt = mass_matrix(model, x);
      Eigen::VectorXd tau = felt * free;
      for (const Spring& s : spec.springs) {
        const auto i = static_cast<std::size_t>(s.body);
        const Vector3 p_K = K.position(s.body, s.p_L), p_D = D.position(s.body, s.p_L);
        const Eigen::AngleAxisd turn(K.X_WL[i].R * D.X_WL[i].R.transpose());
        const Vector3 e = point ? Vector3(p_K - p_D) : Vector3(turn.angle() * turn.axis());
        const Vector3 v_K = point ? K.velocity(s.body, p_K) : K.w_WL[i];
        const Vector3 v_D = point ? D.velocity(s.body, p_D) : D.w_WL[i];
        const Eigen::Matrix3Xd J =
            point ? point_jacobian(model, D, s.body, p_D) : rotation_jacobian(model, D, s.body);
        tau += J.transpose() * (k * (e - h * v_D) + b * (v_K - v_D));
        felt += (h * b + h * h * k) * J.transpose() * J;
      }
      CHECK((felt.llt().solve(tau) - qdd).norm() < 1e-9 * qdd.norm());
    }
}

TEST_CASE("an implicit point spring is stable up to its target's largest radius, to 0.5 percent") {
  const double I = 0.05, r = 0.2, h = 1e-3;
  ModelBuilder at_origin;
  at_origin.set_gravity(Vector3::Zero());
  const BodyInertia body{1, Vector3::Zero(), I * Matrix3::Identity()};
  at_origin.add_body("link", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(), body);
  const Model<double> model = at_origin.build();
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::linear;
  spec.treatment = Treatment::implicit;
  const SteadyHand hand;
  for (const auto& gains : {std::pair{1e6, 0.0}, std::pair{1e7, 100.0}, std::pair{1e9, 1e4}}) {
    const double k = gains.first, b = gains.second;
    CAPTURE(k);
    spec.springs = {{"spring", 1, {r, 0, 0}, k, b}};
    // The KVR's hinge stands so far back that its point lies at radius R_K from the DVR's hinge.
    const auto grows = [&](double R_K) {
      ModelBuilder shifted;
      shifted.add_body("link", 0, "joint1", JointType::revolute,
                       {Matrix3::Identity(), {R_K - r, 0, 0}}, Vector3::UnitZ(), body);
      const Model<double> target_model = shifted.build();
      KinematicRobot kvr(target_model, hand, SteadyHand::mapping(), {{"joint1"}, "", 0, 0});
      const auto coupling = make_coupling(spec, model, kvr);
      Simulation simulation(model, state_of(model, {1e-9}, {0}));
      simulation.add(*coupling);
      double largest = 0;
      for (int n = 0; n < 4000 && largest < 1e-5; ++n) {
        simulation.step(h);
        largest = std::max(largest, std::abs(simulation.state().q[0]));
      }
      return largest > 1e-5;
    };
    const double predicted = largest_target_radius(I, r, k, b, h);
    CHECK(predicted > 2 * r);
    CHECK_FALSE(grows(0.995 * predicted));
    CHECK(grows(1.005 * predicted));
  }
}
