// A fast arm with stiff couplings hits the corner of a post.
#include <doctest/doctest.h>

#include <algorithm>

#include "collision/contact/contact_constraints.h"
#include "tests/coupling/analysis/one_joint.h"
#include "tests/coupling/analysis/two_link.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

// Maximum penetration depth while the target moves the arm steadily against the post [m].
double deepest_on_the_way(const Model<double>& model, double friction, double speed, double q2,
                          double direction) {
  ContactConstraints contact(model, ContactResponse::compliant);
  ContactBodies& bodies = contact.bodies();
  const ContactSurface surface{.friction = friction, .stiffness = 2e8};  // in series: 1e8 N/m
  bodies.add({"fore", 2, {Matrix3::Identity(), {0.2, 0, 0}}, Box{{0.4, 0.05, 0.06}}, surface, 1});
  bodies.add(
      {"upper", 1, {Matrix3::Identity(), {0.125, 0, 0}}, Box{{0.25, 0.06, 0.06}}, surface, 1});
  bodies.add({"post", 0, {Matrix3::Identity(), {0.45, 0, 0}}, Box{{0.12, 0.12, 0.5}}, surface, 0});
  const double q1 = -1.6 * direction, w1 = direction * speed, w2 = 0.5 * w1;
  SteadyHand hand;
  hand.angle = {q1, q2, 0};
  hand.rate = {w1, w2, 0};
  CouplingSpec spec;
  spec.type = CouplingSpec::Type::linear;
  spec.discretization = Discretization::implicit;
  spec.springs = {{"arm1", 1, {0.125, 0, 0}, 5e4, 500}, {"arm2", 2, {0.2, 0, 0}, 5e4, 500}};
  const State<double> start = state_of(model, {q1, q2}, {w1, w2});
  Coupled system(model, hand, {"joint1", "joint2"}, spec, start);
  system.simulation.add(contact);
  double deepest = 0;
  for (int n = 0; n < static_cast<int>(3200 / speed); ++n) {
    system.simulation.step(1e-3);
    for (const ContactPoint& point : contact.points()) {
      if (n == 0 && point.contact.depth > 0) return 0;  // initial penetration: not a case
      deepest = std::max(deepest, point.contact.depth);
    }
  }
  return deepest;
}

}  // namespace

TEST_CASE("a fast arm that hits a post with friction penetrates by less than a millimetre") {
  const Model<double> model = TwoLink{5, 3, 0.25, 0.35}.model();
  double worst = 0;
  for (double speed : {3.0, 6.0, 12.0})
    for (double q2 = -2; q2 <= 2; q2 += 0.25)
      for (double direction : {-1.0, 1.0})
        worst = std::max(worst, deepest_on_the_way(model, 0.3, speed, q2, direction));
  MESSAGE("deepest " << 1e3 * worst << " mm");
  CHECK(worst > 0);
  CHECK(worst < 1e-3);
}
