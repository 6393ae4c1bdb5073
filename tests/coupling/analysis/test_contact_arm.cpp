// Two rods of the S-103's lengths against a fixed box: the target robot is driven into it at joint
// 1's speed in the paper's automatic motion, and stops inside; the robot stays outside with each
// coupling.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "collision/contact/contact_constraints.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

constexpr double kArm = 0.25, kFore = 0.35, kSpeed = std::numbers::pi,
                 kTime = 0.9 / kSpeed;  // [m, rad/s, s]

// Rotates joint 1 at kSpeed for kTime, then stops.
class StoppingHand final : public OperatorMotion {
 public:
  OperatorSample sample(double t, double) const override {
    OperatorSample hand;
    const bool moves = t < kTime;
    SteadyHand::mapping().set_robot_angle(hand, 0, -0.9 + kSpeed * std::min(t, kTime),
                                          moves ? kSpeed : 0);
    SteadyHand::mapping().set_robot_angle(hand, 1, 0.3, 0);
    return hand;
  }
  double duration() const override { return 10; }
  std::string description() const override { return "moves, then stops"; }
};

CouplingSpec coupling_of(int kind) {
  CouplingSpec spec;
  spec.discretization = Discretization::implicit;
  if (kind == 0) {
    spec.type = CouplingSpec::Type::linear;
    spec.springs = {{"arm1", 1, {kArm / 2, 0, 0}, 4000, 60}, {"arm2", 2, {0.3, 0, 0}, 1500, 40}};
  } else {
    spec.type = CouplingSpec::Type::torsional;
    spec.measure = kind == 1 ? SpringSpace::world : SpringSpace::joint;
    spec.springs = {{"arm1", 1, {}, 150, 6}, {"arm2", 2, {}, 40, 1.5}};
  }
  return spec;
}

// Joint force of the springs at rest, from the definition.
std::array<double, 2> spring_torque(int kind, const CouplingSpec& spec,
                                    const std::vector<double>& q, double q1_K, double q2_K) {
  const double k1 = spec.springs[0].k, k2 = spec.springs[1].k;
  const double e1 = q1_K - q[0], e12 = q1_K + q2_K - q[0] - q[1];
  if (kind == 1) return {k1 * e1 + k2 * e12, k2 * e12};  // torques on the links, in the world
  if (kind == 2) return {k1 * e1, k2 * (q2_K - q[1])};
  const auto along = [](double angle, double r) {
    return Vector3(r * std::cos(angle), r * std::sin(angle), 0);
  };
  const Vector3 F1 = k1 * (along(q1_K, kArm / 2) - along(q[0], kArm / 2));
  const Vector3 elbow = along(q[0], kArm), fore = along(q[0] + q[1], 0.3);
  const Vector3 F2 = k2 * (along(q1_K, kArm) + along(q1_K + q2_K, 0.3) - elbow - fore);
  return {along(q[0], kArm / 2).cross(F1).z() + (elbow + fore).cross(F2).z(), fore.cross(F2).z()};
}

}  // namespace

TEST_CASE("an arm pushed against a box stays outside, at rest with the coupling's force") {
  for (int kind = 0; kind < 3; ++kind) {
    CAPTURE(kind);
    const Model<double> model = TwoLink{5, 3, kArm, kFore}.model();
    StoppingHand hand;
    TargetRobot kvr(model, hand, SteadyHand::mapping(), {{"joint1", "joint2"}, "", 0, 0});
    const CouplingSpec spec = coupling_of(kind);
    const auto coupling = make_coupling(spec, model, kvr);
    Simulation simulation(model, state_of(model, {-0.9, 0.3}, {kSpeed, 0}));
    simulation.add(*coupling);
    ContactConstraints contacts(model, ContactResponse::rigid);
    ContactSurface surface;
    surface.friction = 0.3;
    const Pose fore{Matrix3::Identity(), {kFore / 2, 0, 0}};
    contacts.bodies().add({"fore", 2, fore, Box{{kFore, 0.04, 0.05}}, surface, 0});
    contacts.bodies().add(
        {"post", 0, {Matrix3::Identity(), {0.5, 0, 0}}, Box{{0.1, 0.1, 0.5}}, surface, 0});
    simulation.add(contacts);

    double deepest = 0, least = 1e300, most = 0;
    int refused = 0;
    for (int n = 0; n < 3000; ++n) {
      refused += !simulation.step(1e-3).ok();
      double force = 0;
      for (const ContactPoint& point : contacts.points()) {
        deepest = std::max(deepest, point.contact.depth);
        force += point.force_W.norm();
      }
      if (n < 2000) continue;  // the arm is at rest on the post
      least = std::min(least, force), most = std::max(most, force);
    }
    CHECK(refused == 0);
    CHECK(deepest < 1e-4);
    CHECK(most > 1);
    CHECK(most - least < 0.01 * most);                                  // no chatter
    CHECK(kvr.end().x.q[0] == doctest::Approx(-0.9 + kSpeed * kTime));  // inside the post
    const std::vector<double>& q = simulation.state().q;
    const std::array<double, 2> expected = spring_torque(kind, spec, q, -0.9 + kSpeed * kTime, 0.3);
    for (std::size_t j = 0; j < 2; ++j)
      CHECK(simulation.constraints().constraint_force()[j] ==
            doctest::Approx(-expected[j]).epsilon(1e-6));
  }
}
