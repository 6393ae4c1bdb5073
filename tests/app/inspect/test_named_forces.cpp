// Wrenches in any viewpoint, and named forces.
#include <doctest/doctest.h>

#include "app/inspect/force_balance.h"
#include "tests/solver/dynamics/random_tree.h"

using namespace twinarm;
using namespace twinarm::testing;

namespace {

std::vector<Viewpoint> all_viewpoints(std::size_t last_body) {
  std::vector<Viewpoint> all;
  for (const auto axes : {Viewpoint::Axes::world, Viewpoint::Axes::own, Viewpoint::Axes::body})
    for (const auto about : {Viewpoint::About::own_origin, Viewpoint::About::own_com,
                             Viewpoint::About::body, Viewpoint::About::point})
      all.push_back({axes, last_body, about, last_body, Vector3(0.7, -1.2, 0.4)});
  return all;
}

// Force on body i in world axes at a point of the world.
AppliedForce::OnBody at_point(const Inspection& in, std::size_t i, const Vector3& p,
                              const Vector3& f) {
  const Matrix3 R_BW = in.k.R_WB[i].transpose();
  const Vector3 n = R_BW * (p - in.k.X_WL[i].p).cross(f), turned = R_BW * f;
  return {i, {from_eigen(n), from_eigen(turned)}, {}};
}

}  // namespace

TEST_CASE("wrenches balance in every viewpoint, on 100 random trees of all joints") {
  Random random(31);
  const std::vector<JointType> types{all_joint_types.begin(), all_joint_types.end()};
  for (int k = 0; k < 100; ++k) {
    CAPTURE(k);
    const Model<double> model = build(random_bodies(random, random.integer(1, 6), types));
    const Inspection in(model, random_state(random, model), {});
    for (const Viewpoint& from : all_viewpoints(model.parent.size() - 1))
      for (std::size_t i = 1; i < in.body_count(); ++i) {
        const BodyBalance seen = balance_of(in, i, from), plain = balance_of(in, i);
        CHECK(seen.residual < 1e-10);
        REQUIRE(seen.wrenches.size() == plain.wrenches.size());
        for (std::size_t n = 0; n < plain.wrenches.size(); ++n) {
          const NamedWrench &a = seen.wrenches[n], &b = plain.wrenches[n];
          // Invariants: size of the force, and torque along it.
          const double size = 1 + b.force.norm() + b.torque.norm();
          CHECK(std::abs(a.force.norm() - b.force.norm()) < 1e-12 * size);
          CHECK(std::abs(a.force.dot(a.torque) - b.force.dot(b.torque)) < 1e-11 * size * size);
        }
      }
  }
}

TEST_CASE("torque of a weight about the centre of mass and of a force about its point is zero") {
  Random random(32);
  const Model<double> model = random_tree(random, 3, {JointType::revolute});
  const State<double> x = random_state(random, model);
  const Inspection still(model, x, {});
  const Vector3 p(0.3, 0.9, -0.2), f(3, -4, 12);
  AppliedForce push{"wrench/0", {at_point(still, 2, p, f)}, {}};
  push.point_W = p;
  const Inspection in(model, x, {push});
  Viewpoint from;
  from.about = Viewpoint::About::own_com;
  const BodyBalance balance = balance_of(in, 2, from);
  CHECK(balance.wrenches.front().source == "gravity");
  CHECK(balance.wrenches.front().torque.norm() < 1e-13);

  from.about = Viewpoint::About::point;
  from.point = p;
  from.axes = Viewpoint::Axes::body;
  from.axes_of = 3;
  const NamedForce named = named_forces(in, from).at(0);
  CHECK(named.force->source == "wrench/0");
  REQUIRE(named.ends.size() == 1);
  CHECK((named.ends[0].wrench.force - in.k.X_WL[3].R.transpose() * f).norm() < 1e-12);
  CHECK(named.ends[0].wrench.torque.norm() < 1e-12);
  CHECK((named.ends[0].about - p).norm() == 0);
}

TEST_CASE("a contact has opposite wrenches on its two bodies, and its normal and friction force") {
  Random random(33);
  const Model<double> model = random_tree(random, 3, {JointType::spherical});
  const State<double> x = random_state(random, model);
  const Inspection still(model, x, {});
  const Vector3 p(0.1, 0.2, 0.3), n = Vector3(2, -1, 2) / 3, slide = Vector3(1, 2, 0);
  const Vector3 f = 30 * n + slide;  // slide is in the plane
  AppliedForce contact{"contact/a-b", {at_point(still, 3, p, f), at_point(still, 1, p, -f)}, {}};
  contact.normal_W = n;
  const Inspection in(model, x, {contact});
  Viewpoint from;
  from.about = Viewpoint::About::point;
  from.point = {5, 6, 7};
  const NamedForce named = named_forces(in, from).at(0);
  REQUIRE(named.ends.size() == 2);
  CHECK((named.ends[0].wrench.force + named.ends[1].wrench.force).norm() < 1e-12);
  CHECK((named.ends[0].wrench.torque + named.ends[1].wrench.torque).norm() < 1e-11);
  REQUIRE(named.parts);
  CHECK(named.parts->normal == doctest::Approx(30).epsilon(1e-13));
  CHECK(named.parts->friction == doctest::Approx(std::sqrt(5.0)).epsilon(1e-12));
}
