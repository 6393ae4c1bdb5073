// Force feedback: the couplings' reaction against the derivative of their energy, Newton's law, and
// the device's Jacobian.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "coupling/device/force_feedback.h"
#include "solver/forces/spring.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"
#include "tests/coupling/device/mapped_robots.h"
#include "tests/support/count_allocations.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Beyond y = place the tip of the second link meets a stiff spring-damper.
class TipWall final : public ForceSource {
 public:
  double place = 0.1, k = 20000, b = 300;
  Vector3 p_L;
  void add_forces(const State<double>&, const Kinematics& K,
                  Forces<double>& forces) noexcept override {
    const Vector3 p = K.position(2, p_L);
    if (p.y() <= place) return;
    const Vector3 v = K.velocity(2, p);
    add_point_force(K, 2, p, Vector3(0, -k * (p.y() - place) - b * v.y(), 0), forces);
  }
};

// The KVR is beyond the wall, the DVR at rest at it.
struct Pressed {
  TwoLink arm;
  Model<double> model = arm.model();
  SteadyHand hand;
  TipWall wall;
  std::unique_ptr<TargetRobot> kvr;
  std::unique_ptr<Coupling> coupling;
  std::unique_ptr<Simulation> simulation;
  CouplingReaction reaction{model, {1, 2}};
  std::vector<double> tau;

  Pressed(const CouplingSpec& spec, double wall_place, double seconds) {
    hand.angle = {0.5, 0.7, 0};
    wall.place = wall_place;
    wall.p_L = {arm.l2, 0, 0};
    kvr = std::make_unique<TargetRobot>(model, hand, SteadyHand::mapping(),
                                        DrivenJoints{{"joint1", "joint2"}, "", 0, 0});
    coupling = make_coupling(spec, model, *kvr);
    simulation = std::make_unique<Simulation>(model, state_of(model, {0.1, 0.3}, {0, 0}));
    simulation->add(*coupling);
    simulation->add(wall);
    reaction.add(spec, *coupling);
    for (int n = 0; n < seconds * 1000; ++n) {
      simulation->step(1e-3);
      tau = reaction.after_step(kvr->end(), simulation->state(), simulation->kinematics(), 1e-3);
    }
  }
  // Energy of the springs with another KVR [J].
  double energy(const CouplingSpec& spec, double q1, double q2) const {
    Kinematics K(model);
    forward_kinematics(model, state_of(model, {q1, q2}, {0, 0}), K);
    const Kinematics& D = simulation->kinematics();
    double sum = 0;
    for (const Spring& s : spec.springs) {
      const auto i = static_cast<std::size_t>(s.body);
      const double at_point = (K.position(s.body, s.p_L) - D.position(s.body, s.p_L)).squaredNorm();
      const double turned = rotation_vector(K.X_WL[i].R * D.X_WL[i].R.transpose()).squaredNorm();
      const double e = (s.body == 1 ? q1 : q2) - simulation->state().q[i - 1];
      if (spec.type == CouplingSpec::Type::linear)
        sum += 0.5 * s.k * at_point;
      else if (spec.type == CouplingSpec::Type::bushing)
        sum += 0.5 * s.k * at_point + 0.5 * s.k_rotational * turned;
      else
        sum += 0.5 * s.k * (spec.measure == SpringSpace::joint ? e * e : turned);
    }
    return sum;
  }
};

std::vector<CouplingSpec> felt_laws(const TwoLink& arm) {
  std::vector<CouplingSpec> all;
  for (const Discretization discretization :
       {Discretization::explicit_, Discretization::implicit}) {
    all.push_back(linear(arm.springs(2000, 100), discretization));
    all.push_back(torsional(arm.springs(150, 15), SpringSpace::world, discretization));
    all.push_back(torsional(arm.springs(150, 15), SpringSpace::joint, discretization));
    CouplingSpec bushing = linear(arm.springs(2000, 100), discretization);
    bushing.type = CouplingSpec::Type::bushing;
    for (Spring& spring : bushing.springs) spring.k_rotational = 60, spring.b_rotational = 6;
    all.push_back(bushing);
  }
  return all;
}

// One spring at the tip, and a mapping of the tip to the stylus, one to one.
struct TipHand {
  OmniParameters omni;
  DeviceState device = device_at(omni, {0.2, 0.6, 0.3, 0, 0, 0});
  std::unique_ptr<DeviceMapping> mapping;
  explicit TipHand(const Pressed& pressed) {
    MappingSpec spec;
    spec.kind = MappingKind::cartesian;
    spec.scale = 1;
    MappedRobot robot;
    robot.model = &pressed.model;
    robot.turned = {1, 2};
    robot.body = 2;
    robot.p_L = {pressed.arm.l2, 0, 0};
    mapping = make_mapping(spec, omni, robot);
    mapping->begin(device, {pressed.hand.angle[0], pressed.hand.angle[1]});
    mapping->map(device, 1e-3);
  }
  Vector3 stylus_force_W(const DeviceForce& motors) const {
    const Vector3 torque(motors.torque[0], motors.torque[1], motors.torque[2]);
    return world_from_device(
        omni_jacobian(omni, device.theta).transpose().fullPivLu().solve(torque));
  }
};
CouplingSpec at_tip(double k) {
  CouplingSpec spec = linear({{"tip", 2, {TwoLink().l2, 0, 0}, k, 60}});
  return spec;
}

}  // namespace

TEST_CASE("at a wall: the reaction torques are the derivative of the springs' energy") {
  for (const CouplingSpec& spec : felt_laws(TwoLink())) {
    CAPTURE(std::string(spec.type.name));
    CAPTURE(static_cast<int>(spec.discretization));
    const Pressed pressed(spec, 0.3, 6);
    constexpr double d = 1e-6;
    const double q1 = pressed.hand.angle[0], q2 = pressed.hand.angle[1];
    const double tau1 =
        (pressed.energy(spec, q1 - d, q2) - pressed.energy(spec, q1 + d, q2)) / (2 * d);
    const double tau2 =
        (pressed.energy(spec, q1, q2 - d) - pressed.energy(spec, q1, q2 + d)) / (2 * d);
    CHECK(std::abs(tau1) > 5);  // not negligible
    CHECK(pressed.tau[0] == doctest::Approx(tau1).epsilon(1e-5));
    CHECK(pressed.tau[1] == doctest::Approx(tau2).epsilon(1e-5));
  }
}

TEST_CASE("at a wall: the stylus force is the wall's force and the coupling force") {
  const Pressed pressed(at_tip(40), 0.42, 20);
  TipHand hand(pressed);
  const Vector3 force = hand.stylus_force_W(hand.mapping->motor_torques(hand.device, pressed.tau));
  const Vector3 coupling_force = pressed.coupling->readings()[0].force_W;
  const Vector3 tip = pressed.simulation->kinematics().position(2, pressed.wall.p_L);
  const double of_wall = -pressed.wall.k * (tip.y() - pressed.wall.place);
  CHECK(of_wall < -1);
  CHECK(force.y() == doctest::Approx(of_wall).epsilon(1e-3));
  CHECK((force + coupling_force).head<2>().norm() < 1e-6 * coupling_force.norm());
  CHECK(std::abs(force.z()) < 1e-9);
}

TEST_CASE("in slow free motion the force feedback is almost zero") {
  Pressed free(at_tip(2000), 10, 3);
  free.hand.rate = {0.05, -0.03, 0};  // the KVR was at rest until now
  free.hand.angle = {0.5 - 0.05 * 3, 0.7 + 0.03 * 3, 0};
  double most = 0;
  for (int n = 0; n < 2000; ++n) {
    free.simulation->step(1e-3);
    const auto& tau = free.reaction.after_step(free.kvr->end(), free.simulation->state(),
                                               free.simulation->kinematics(), 1e-3);
    if (n > 1500) most = std::max({most, std::abs(tau[0]), std::abs(tau[1])});
  }
  CHECK(most < 0.1);  // against 2000 N/m at half a metre
}

// m a = F over each step, with any discretization.
TEST_CASE("the reaction of an implicit coupling is the mean force on the body") {
  for (const Discretization discretization :
       {Discretization::explicit_, Discretization::semi_implicit, Discretization::implicit}) {
    const double m = 0.7, h = 1e-3;
    const Model<double> model = one_joint(JointType::prismatic, m);
    SteadyHand hand;
    hand.rate[0] = 0.3;
    for (const bool at_joint : {false, true}) {
      const std::vector<Spring> springs{{"s", 1, {0, 0, 0}, 400, 8}};
      const CouplingSpec spec = at_joint ? torsional(springs, SpringSpace::joint, discretization)
                                         : linear(springs, discretization);
      Coupled system(model, hand, {"joint1"}, spec, state_of(model, {0.05}, {0}));
      CouplingReaction reaction(model, {1});
      reaction.add(spec, *system.coupling);
      double before = 0;
      for (int n = 0; n < 300; ++n) {
        system.simulation.step(h);
        const double force = reaction.after_step(system.kvr.end(), system.simulation.state(),
                                                 system.simulation.kinematics(), h)[0];
        const double v = system.simulation.state().qd[0];
        if (n > 0) CHECK(force == doctest::Approx(-m * (v - before) / h).epsilon(1e-9));
        before = v;
      }
    }
  }
}

TEST_CASE("the force is at most the device's peak, with the specified low-pass") {
  const Pressed pressed(at_tip(40), 0.42, 20);
  TipHand hand(pressed);
  ForceFeedbackSpec spec;
  spec.passive = false;
  ForceFeedback strong(spec, hand.omni, *hand.mapping);
  const std::vector<double> much{500, -300};
  const Vector3 force = hand.stylus_force_W(strong.tick(hand.device, much, 1e-3));
  CHECK(force.norm() == doctest::Approx(3.3).epsilon(1e-3));

  spec.cutoff = 20;
  ForceFeedback soft(spec, hand.omni, *hand.mapping);
  const Vector3 whole = hand.stylus_force_W(hand.mapping->motor_torques(hand.device, pressed.tau));
  const double tau = 1 / (2 * std::numbers::pi * 20);
  Vector3 part;
  for (int n = 0; n < std::lround(tau * 1e4); ++n)
    part = hand.stylus_force_W(soft.tick(hand.device, pressed.tau, 1e-4));
  CHECK(part.norm() / whole.norm() == doctest::Approx(1 - std::exp(-1)).epsilon(0.01));
}

TEST_CASE("reaction and force do not allocate") {
  Pressed pressed(at_tip(40), 0.42, 1);
  TipHand hand(pressed);
  ForceFeedback force(ForceFeedbackSpec{}, hand.omni, *hand.mapping);
  CHECK(allocations_in([&] {
          for (int n = 0; n < 100; ++n)
            force.tick(hand.device,
                       pressed.reaction.after_step(pressed.kvr->end(), pressed.simulation->state(),
                                                   pressed.simulation->kinematics(), 1e-3),
                       1e-3);
        }) == 0);
}
