// Explicit remainders of the implicit discretization: velocity products of a fast long chain, and
// the geometric stiffness of a point spring with a distant target.
#include <doctest/doctest.h>

#include "coupling/analysis/joint_space_stiffness.h"
#include "coupling/analysis/prediction.h"
#include "solver/dynamics/energy_momentum.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Twenty links, revolute joints in all directions.
Model<double> long_chain(Random& random) {
  ModelBuilder builder;
  for (int i = 1; i <= 20; ++i)
    builder.add_body("link" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                     JointType::revolute, {random.rotation(), {0.15, 0, 0}}, random.vector(1),
                     {0.5, {0.075, 0, 0}, 0.001 * Vector3(1, 2, 2).asDiagonal().toDenseMatrix()});
  return builder.build();
}

}  // namespace

TEST_CASE("a fast chain of 20 links stays bounded with implicit springs at w h from 10 to 100") {
  Random random(21);
  const Model<double> model = long_chain(random);
  const double h = 1e-3;
  SteadyHand hand;
  hand.rate = {3, -2, 4};  // of the first three joints
  State<double> start(model);
  for (double& qd : start.qd) qd = random.uniform(-20, 20);
  for (const bool point : {true, false})
    for (double wh : {10.0, 30.0, 100.0}) {
      CAPTURE(point);
      CAPTURE(wh);
      CouplingSpec spec;
      spec.type = point ? CouplingSpec::Type::linear : CouplingSpec::Type::torsional;
      spec.discretization = Discretization::implicit;
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
      // The chain follows the target up to the static deflection by gravity and centrifugal forces.
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
      spec.discretization = Discretization::implicit;
      for (const int body : {4, 11, 20})
        spec.springs.push_back({"spring", body, {0.1, 0.02, -0.05}, k, b});

      const auto qdd_of = [&](Simulation& simulation) {
        simulation.step(h);
        return Eigen::VectorXd((Eigen::Map<const Eigen::VectorXd>(simulation.state().qd.data(), n) -
                                Eigen::Map<const Eigen::VectorXd>(x.qd.data(), n)) /
                               h);
      };
      Simulation alone(model, x);
      const Eigen::VectorXd free = qdd_of(alone);  // without springs: M free = -bias
      Coupled system(model, hand, {"joint1", "joint2", "joint3"}, spec, x);
      const Kinematics D = system.simulation.kinematics();
      const Eigen::VectorXd qdd = qdd_of(system.simulation);
      const Kinematics& K = system.kvr.end().k;  // target at the end of the step

      Eigen::MatrixXd M = mass_matrix(model, x);
      Eigen::VectorXd tau = M * free;
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
        M += (h * b + h * h * k) * J.transpose() * J;
      }
      CHECK((solve_symmetric(M, tau) - qdd).norm() < 1e-9 * qdd.norm());
    }
}

TEST_CASE(
    "an implicit point spring is stable up to the maximum radius of its target, to 0.5 percent") {
  const double I = 0.05, r = 0.2, h = 1e-3;
  ModelBuilder at_origin;
  at_origin.set_gravity(Vector3::Zero());
  const BodyInertia body{1, Vector3::Zero(), I * Matrix3::Identity()};
  at_origin.add_body("link", 0, "joint1", JointType::revolute, {}, Vector3::UnitZ(), body);
  const Model<double> model = at_origin.build();
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::linear;
  spec.discretization = Discretization::implicit;
  const SteadyHand hand;
  for (const auto& gains : {std::pair{1e6, 0.0}, std::pair{1e7, 100.0}, std::pair{1e9, 1e4}}) {
    const double k = gains.first, b = gains.second;
    CAPTURE(k);
    spec.springs = {{"spring", 1, {r, 0, 0}, k, b}};
    // The KVR's joint is offset so that its point is at radius R_K from the DVR's joint.
    const auto grows = [&](double R_K) {
      ModelBuilder shifted;
      shifted.add_body("link", 0, "joint1", JointType::revolute,
                       {Matrix3::Identity(), {R_K - r, 0, 0}}, Vector3::UnitZ(), body);
      const Model<double> target_model = shifted.build();
      TargetRobot kvr(target_model, hand, SteadyHand::mapping(), {{"joint1"}, "", 0, 0});
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
    const double predicted = max_target_radius(I, r, k, b, h);
    CHECK(predicted > 2 * r);
    CHECK_FALSE(grows(0.995 * predicted));
    CHECK(grows(1.005 * predicted));
  }
}

namespace {

// Twenty rods, 1 m long, straight along x, planar; one implicit spring at the tip at w h = 100 (of
// the stiffest mode), target `off` metres to the side.
struct HeldTip {
  static constexpr double h = 1e-3, length = 0.05;
  static constexpr int links = 20;
  Model<double> model;
  Spring spring{"tip", links, {length, 0, 0}, 1, 0};
  std::unique_ptr<Coupled> system;

  HeldTip(double off, double zeta) {
    ModelBuilder builder;
    const double m = 0.1, I = m * length * length / 12;
    for (int i = 1; i <= links; ++i)
      builder.add_body("rod" + std::to_string(i), i - 1, "joint" + std::to_string(i),
                       JointType::revolute, {Matrix3::Identity(), {i == 1 ? 0 : length, 0, 0}},
                       Vector3::UnitZ(),
                       {m, {length / 2, 0, 0}, Vector3(0.1 * I, I, I).asDiagonal()});
    model = builder.build();
    SteadyHand hand;
    hand.angle[0] = off;  // of the root: the tip is at 1 m
    const State<double> straight(model);
    CouplingSpec spec;
    spec.type = CouplingSpec::Type::linear;
    spec.discretization = Discretization::implicit;
    spec.springs = {spring};
    const Coupled unit(model, hand, {"joint1"}, spec, straight);
    const double wh = 100;
    spring.k = wh * wh / (h * h) /
               squared_frequencies(mass_matrix(model, straight),
                                   unit.coupling->joint_space(unit.simulation.kinematics()).K)
                   .maxCoeff();
    spring.b = 2 * zeta * spring.k * h / wh;
    spec.springs = {spring};
    system =
        std::make_unique<Coupled>(model, hand, std::vector<std::string>{"joint1"}, spec, straight);
  }
  Vector3 offset() const {
    return system->kvr.start().k.position(links, spring.p_L) -
           system->simulation.kinematics().position(links, spring.p_L);
  }
  double energy() const {
    return kinetic_energy(model, system->simulation.state()) +
           0.5 * spring.k * offset().squaredNorm();
  }
  TargetRadius radius() const {
    return nearest_target_radius(model, system->simulation.state(), system->simulation.kinematics(),
                                 system->kvr.start().k, spring, h);
  }
};

}  // namespace

TEST_CASE(
    "a tip held at w h = 100 converges from 7 mm with decreasing energy; from 71 mm it diverges") {
  for (const double zeta : {0.0, 0.7}) {
    CAPTURE(zeta);
    HeldTip near(0.007, zeta);
    const double first = near.energy();
    double most = 0, ratio = 0;
    for (int n = 0; n < 600; ++n) {
      ratio = std::max(ratio, near.radius().ratio());
      CHECK(near.system->simulation.step(HeldTip::h).finite);
      most = std::max(most, near.energy());
    }
    CHECK(most < 1.5 * first);
    CHECK(near.offset().norm() < 1e-3);
    CHECK(ratio < 0.7);  // relative to the geometric stiffness limit

    // The limit is exceeded in the first steps, before the energy has grown.
    HeldTip far(0.071, zeta);
    const double before = far.energy();
    CHECK(far.radius().ratio() < 1);
    int passed = -1, grown = -1;
    for (int n = 1; n <= 60 && grown < 0; ++n) {
      far.system->simulation.step(HeldTip::h);
      if (passed < 0 && far.radius().ratio() > 1) passed = n;
      if (!(far.energy() < 10 * before)) grown = n;
    }
    CHECK(passed > 0);
    CHECK(passed < grown);
  }
}

TEST_CASE("the maximum target radius is that of the joint that folds: one link, any axis") {
  Random random(23);
  ModelBuilder builder;
  builder.add_body("base", 0, "slide", JointType::prismatic, {random.rotation(), random.vector(1)},
                   random.vector(1), {3, random.vector(0.1), 0.1 * Matrix3::Identity()});
  builder.add_body("link", 1, "joint1", JointType::revolute, {random.rotation(), random.vector(1)},
                   random.vector(1), {2, Vector3::Zero(), 0.05 * Matrix3::Identity()});
  const Model<double> model = builder.build();
  const State<double> x(model);
  Kinematics D(model);
  forward_kinematics(model, x, D);
  const Spring spring{"spring", 2, random.vector(0.4), 1e6, 30};
  const TargetRadius found = nearest_target_radius(model, x, D, D, spring, 1e-3);
  // r = |dp/dq| of a revolute joint; I is the diagonal of the mass matrix.
  const double r = point_jacobian(model, D, 2, D.position(2, spring.p_L)).col(1).norm();
  CHECK(found.body == 2);
  CHECK(found.r == doctest::Approx(r).epsilon(1e-12));
  CHECK(found.R_K == doctest::Approx(r).epsilon(1e-12));
  CHECK(found.largest ==
        doctest::Approx(max_target_radius(mass_matrix(model, x)(1, 1), r, 1e6, 30, 1e-3)));
}
