// Detection by FCL's narrow phase against the Minkowski oracle and our own narrow phase.
#include "collision/detection/fcl_contact.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "collision/detection/collision_world.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

constexpr double kNear = 0.01;     // margin [m]
constexpr double kRound = 1e-6;    // error of depth with a sphere or capsule [m]
constexpr double kEdges = 1.5e-3;  // of others: 2 m (sqrt(3) - 1), two corners rounded by m = 1 mm

std::vector<Shape> shapes_of_fcl() {
  Random random(7);
  return {Sphere{0.06},         Box{{0.2, 0.14, 0.1}},         Capsule{0.05, 0.2},
          Cylinder{0.06, 0.15}, Ellipsoid{{0.11, 0.05, 0.07}}, random_hull(random)};
}

bool has_radius(const Shape& s) {
  return std::holds_alternative<Sphere>(s) || std::holds_alternative<Capsule>(s);
}
bool is_curved(const Shape& s) {
  return std::holds_alternative<Cylinder>(s) || std::holds_alternative<Ellipsoid>(s);
}

struct FclScene : PairScene {
  FclScene(const Shape& a, const Shape& b) : PairScene(a, b, kNear) { world.use_fcl(); }
  const CollisionWorld::FclUse& use() const { return world.fcl_use(); }
};

// visit(a, b, random)
template <class Visit>
void for_fcl_pairs(Visit visit) {
  const std::vector<Shape> shapes = shapes_of_fcl();
  for (const Shape& a : shapes)
    for (const Shape& b : shapes) {
      CAPTURE(shape_name(a));
      CAPTURE(shape_name(b));
      Random random(61);
      visit(a, b, random);
    }
}

bool are_equal(const std::vector<Contact>& x, const std::vector<Contact>& y, double tolerance) {
  return std::equal(
      x.begin(), x.end(), y.begin(), y.end(), [&](const Contact& p, const Contact& q) {
        return p.feature == q.feature && std::abs(p.depth - q.depth) <= tolerance &&
               (p.p_WC - q.p_WC).norm() <= tolerance && (p.n_W - q.n_W).norm() <= 1e-6 * tolerance;
      });
}

}  // namespace

TEST_CASE("FCL: depths to 1.5 mm are exact for spheres and capsules, others have rounded edges") {
  for_fcl_pairs([](const Shape& a, const Shape& b, Random& random) {
    FclScene fcl(a, b);
    const bool is_round = has_radius(a) || has_radius(b);
    const bool by_oracle = !is_curved(a) && !is_curved(b) && !(has_radius(a) && has_radius(b));
    double shallower = 0, deeper = 0, wrong_normal = 0;
    int found = 0, lost = 0;
    for (int k = 0; k < 300; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-1.5e-3, 1e-3));
      const double own = fcl.world.distance(0, 1, X_WA, X_WB);
      const double truth = -(by_oracle ? oracle_distance(a, X_WA, b, X_WB) : own);
      if (fcl.touch(X_WA, X_WB).empty()) {
        lost += truth > -kNear + 1e-6;
        continue;
      }
      ++found;
      shallower = std::max(shallower, truth - fcl.depth());
      deeper = std::max(deeper, fcl.depth() - truth);
      const PreparedShape solid_a(a), solid_b(b);
      const double along = overlap({solid_a, X_WA}, {solid_b, X_WB}, fcl.contacts[0].n_W);
      wrong_normal = std::max(wrong_normal, std::abs(along - fcl.depth()));
    }
    CHECK(found > 30);
    CHECK(lost <= (is_round ? 0 : 3));
    CHECK(shallower < 1e-8);
    CHECK(deeper < (is_round ? kRound : kEdges));
    CHECK(wrong_normal < 1e-9);
    CHECK(fcl.use().rejected <= 2);
  });
}

TEST_CASE("FCL: spheres and capsules have the normals, spheres the points, of our narrow phase") {
  for_fcl_pairs([](const Shape& a, const Shape& b, Random& random) {
    if (!has_radius(a) && !has_radius(b)) return;
    FclScene fcl(a, b);
    PairScene own(a, b, kNear);
    const bool has_sphere = std::holds_alternative<Sphere>(a) || std::holds_alternative<Sphere>(b);
    double normal = 0, place = 0;
    for (int k = 0; k < 300; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.02, 0.01));
      if (fcl.touch(X_WA, X_WB).empty() || own.touch(X_WA, X_WB).empty()) continue;
      normal = std::max(normal, (fcl.contacts[0].n_W - own.contacts[0].n_W).norm());
      if (has_sphere) place = std::max(place, (fcl.contacts[0].p_WC - own.contacts[0].p_WC).norm());
    }
    CHECK(normal < 5e-3);
    CHECK(place < 3e-4);
    CHECK(fcl.use().rejected == 0);
  });
}

TEST_CASE("FCL: moving b by the depth along the normal separates, also from 2 cm deep") {
  for_fcl_pairs([](const Shape& a, const Shape& b, Random& random) {
    FclScene fcl(a, b);
    int still_touching = 0, wrong_way = 0;
    for (int k = 0; k < 200; ++k) {
      const Pose X_WA = random_pose(random);
      Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.02, 0.01));
      if (fcl.touch(X_WA, X_WB).empty()) continue;
      X_WB.p += (fcl.depth() + 1e-8) * fcl.contacts[0].n_W;
      const double gap = fcl.world.distance(0, 1, X_WA, X_WB);
      still_touching += !(gap > 0);
      wrong_way += gap > 1e-2;
    }
    CHECK(still_touching == 0);
    CHECK(wrong_way == 0);
  });
}

TEST_CASE("FCL: faces on faces have the contact points and features of our narrow phase") {
  Random random(67);
  const Box table{{1, 0.8, 0.2}};
  for (const Shape& body : {Shape(Box{{0.2, 0.14, 0.1}}), Shape(Cylinder{0.06, 0.1}),
                            Shape(convex_hull(Box{{0.1, 0.1, 0.1}}.polytope().hull.vertices))}) {
    CAPTURE(shape_name(body));
    FclScene fcl(table, body);
    PairScene own(table, body, kNear);
    const double height = 0.1 + support(body, Vector3::UnitZ()).z();
    int unlike = 0;
    for (int k = 0; k < 500; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_AB{turn(random.uniform(-3, 3), Vector3::UnitZ()),
                      {random.uniform(-0.5, 0.5), 0, height - random.uniform(-1e-3, 1e-3)}};
      fcl.touch(X_WA, X_WA * X_AB);
      own.touch(X_WA, X_WA * X_AB);
      unlike += own.contacts.size() < 3 ? 0 : !are_equal(fcl.contacts, own.contacts, 1e-8);
    }
    CHECK(unlike == 0);
  }
}

TEST_CASE("FCL: half-spaces, cavities and meshes have our contacts, bit by bit") {
  const Shape ball = Sphere{0.1}, box = Box{{0.2, 0.2, 0.2}};
  Random random(71);
  for (const Shape& wall :
       {Shape(HalfSpace{}), Shape(SphericalCavity{0.3}), Shape(CylindricalCavity{0.3, 2}),
        Shape(MeshShape{box_mesh({1, 1, 1})})})
    for (const Shape& body : {ball, box}) {
      CAPTURE(shape_name(wall));
      FclScene fcl(wall, body);
      PairScene own(wall, body, kNear);
      int unlike = 0, found = 0;
      for (int k = 0; k < 200; ++k) {
        Pose X = random_pose(random);
        X.p = random.uniform(0, 0.6) * random.direction();
        found += !own.touch(origin, X).empty();
        unlike += !are_equal(fcl.touch(origin, X), own.contacts, 0);
      }
      CHECK(found > 5);
      CHECK(unlike == 0);
      CHECK(fcl.use().queries == 0);
    }
}

TEST_CASE("FCL: at the edge of a knife, whose core ends far inside, answers are rejected") {
  const std::vector<Vector3> knife{{0.1, 0.1, 0.005},   {0.1, -0.1, 0.005}, {0.1, 0.1, -0.005},
                                   {0.1, -0.1, -0.005}, {-0.1, 0.1, 0},     {-0.1, -0.1, 0}};
  const Shape a = convex_hull(knife), b = Box{{0.2, 0.14, 0.1}};
  FclScene fcl(a, b);
  Random random(79);
  double shallower = 0, deeper = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose X_WA{turn(random.uniform(-0.5, 0.5), random.direction()), Vector3::Zero()};
    const Pose X_WB{turn(random.uniform(-0.5, 0.5), random.direction()),
                    {-0.2 + random.uniform(-2e-3, 2e-3), 0, random.uniform(-0.06, 0.06)}};
    if (fcl.touch(X_WA, X_WB).empty()) continue;
    const double truth = -oracle_distance(a, X_WA, b, X_WB);
    shallower = std::max(shallower, truth - fcl.depth());
    deeper = std::max(deeper, fcl.depth() - truth);
  }
  CHECK(shallower < 1e-8);
  CHECK(deeper < 2e-3);
  CHECK(fcl.use().rejected > 20);
}

TEST_CASE("FCL: deeper than the margins, queries are counted and have our contacts") {
  const Shape a = Cylinder{0.06, 0.15}, b = Ellipsoid{{0.11, 0.05, 0.07}};
  FclScene fcl(a, b);
  PairScene own(a, b, kNear);
  Random random(73);
  int unlike = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose X_WA = random_pose(random);
    const Pose X_WB = pushed_against(random, a, X_WA, b, random.uniform(-0.03, -0.02));
    const std::size_t before = fcl.use().rejected;
    own.touch(X_WA, X_WB);
    fcl.touch(X_WA, X_WB);
    unlike += fcl.use().rejected > before && !are_equal(fcl.contacts, own.contacts, 0);
  }
  CHECK(fcl.use().queries == 300);
  CHECK(fcl.use().rejected > 50);
  CHECK(unlike == 0);
}
