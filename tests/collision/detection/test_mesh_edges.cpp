// Bodies over the edges of a mesh, or flush in its corners: depths from the convex parts of the
// mesh.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/collision/shapes/step_mesh.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

// Depth of a slightly penetrating body: the deepest of both parts, from all differences of
// vertices.
double depth_in_step(const Shape& body, const Pose& X_WB) {
  double depth = -1e300;
  for (const CoupledTerm& part : step_parts())
    depth = std::max(depth, -oracle_distance(part.box, part.X, body, X_WB));
  return depth;
}

// A face of the step: outward normal, a point, half extents along the other two axes.
struct StepFace {
  int axis;
  double sign;
  Vector3 middle, half;
};
const std::vector<StepFace>& step_faces() {
  static const std::vector<StepFace> faces{{2, 1, {-0.075, 0, 0.12}, {0.075, 0.15, 0}},
                                           {2, 1, {0.075, 0, 0.05}, {0.075, 0.15, 0}},
                                           {2, -1, {0, 0, 0}, {0.15, 0.15, 0}},
                                           {0, 1, {0, 0, 0.085}, {0, 0.15, 0.035}},
                                           {0, 1, {0.15, 0, 0.025}, {0, 0.15, 0.025}},
                                           {0, -1, {-0.15, 0, 0.06}, {0, 0.15, 0.06}},
                                           {1, 1, {-0.075, 0.15, 0.06}, {0.075, 0, 0.06}},
                                           {1, -1, {0.05, -0.15, 0.025}, {0.1, 0, 0.025}}};
  return faces;
}

// Flush with a face, `depth` deep, anywhere over it and beyond its sides.
Pose laid_against(Random& random, const StepFace& face, const Shape& body, double depth) {
  const Vector3 n = face.sign * Vector3::Unit(face.axis);
  Pose X;
  for (int axis = 0; axis < 3; ++axis)
    X.p[axis] = face.middle[axis] + random.uniform(-1.5, 1.5) * face.half[axis];
  const double yaw = random.uniform(0, 1) < 0.5 ? 0 : random.uniform(-3, 3);
  X.R = turn(yaw, n);
  const double reach = -n.dot(X.R * support(body, X.R.transpose() * -n));
  X.p[face.axis] = face.middle[face.axis] + face.sign * (reach - depth);
  return X;
}

}  // namespace

TEST_CASE("a box over the edge of a mesh has the depth of its support, not of its overhang") {
  struct Found {  // found in long runs of pushed bodies
    Vector3 size;
    Pose X;
  };
  Matrix3 R_side, R_back;
  R_side << -0.86959272977813185, -0.10512767862211764, -0.48244860400310285, 0.46971020170915972,
      0.12515517586499936, -0.87390417573355372, 0.1522524572128755, -0.98655174884124874,
      -0.059454487895496788;
  R_back << 0.011802657760427882, 0.29749475941907932, -0.95465049383948608, 0.0036761901034170208,
      -0.95472345111869039, -0.29747204492244617, -0.99992358852870067, 1.4840418394446164e-06,
      -0.012361921439803636;
  const Vector3 step(-0.3, -0.3, 0.001);
  const std::vector<Found> all{
      {{0.15988155060778375, 0.10426666810992206, 0.15605579792344809},
       {R_side, Vector3(-0.35106306473799676, -0.065464454947830361, 0.18924249112714683) - step}},
      {{0.12745580588846012, 0.14107297155749574, 0.080770293788187494},
       {R_back, Vector3(-0.14788629586566862, -0.3972153760567807, 0.11522232460138984) - step}}};
  for (const Found& found : all) {
    const Box box{found.size};
    const double truth = depth_in_step(box, found.X);
    REQUIRE(truth > 1e-8);
    REQUIRE(truth < 1e-7);
    PairScene scene(MeshShape{step_mesh()}, box);
    scene.touch(origin, found.X);
    REQUIRE(!scene.contacts.empty());
    CHECK(std::abs(scene.deepest().depth - truth) < 1e-12);
    CHECK((scene.deepest().n_W - Vector3::UnitZ()).norm() < 1e-9);
    CHECK(std::abs(scene.world.distance(0, 1, origin, found.X) + truth) < 1e-12);
  }
}

TEST_CASE("a slightly penetrating body has the same depth in a mesh as in its convex parts") {
  for (const Shape& body : std::vector<Shape>{Box{{0.1, 0.08, 0.06}}, Box{{0.05, 0.16, 0.2}},
                                              Box{{0.4, 0.04, 0.04}}, Capsule{0.03, 0.1}}) {
    CAPTURE(shape_name(body));
    Random random(77);
    PairScene scene(MeshShape{step_mesh()}, body);
    int seen = 0;
    double too_deep = 0, too_shallow = 0;
    for (int n = 0; n < 1500; ++n) {
      const StepFace& face = step_faces()[static_cast<std::size_t>(n) % step_faces().size()];
      const double depth = std::pow(10, random.uniform(-10, -5));
      const Pose X = laid_against(random, face, body, depth);
      const double truth = depth_in_step(body, X);
      if (!(truth > 0.5 * depth && truth < 2 * depth)) continue;
      ++seen;
      scene.touch(origin, X);
      REQUIRE(!scene.contacts.empty());
      too_deep = std::max(too_deep, scene.deepest().depth - truth);
      too_shallow = std::max(too_shallow, truth - scene.deepest().depth);
    }
    CHECK(seen > 300);
    CHECK(too_deep < 1e-9);
    CHECK(too_shallow < 1e-9);
  }
}

TEST_CASE("a box in the corner of a step, slightly penetrating both sides, touches both") {
  Random random(78);
  const Box box{{0.1, 0.08, 0.14}};  // taller than the riser: above the upper tread's plane
  PairScene scene(MeshShape{step_mesh()}, box);
  for (int n = 0; n < 500; ++n) {
    const double in_riser = std::pow(10, random.uniform(-9, -5)),
                 in_tread = std::pow(10, random.uniform(-9, -5));
    scene.touch(origin, {Matrix3::Identity(),
                         {0.05 - in_riser, random.uniform(-0.18, 0.18), 0.12 - in_tread}});
    double riser = -1, tread = -1;
    for (const Contact& c : scene.contacts) {
      const bool of_riser = (c.n_W - Vector3::UnitX()).norm() < 1e-9;
      const bool of_tread = (c.n_W - Vector3::UnitZ()).norm() < 1e-9;
      REQUIRE((of_riser || of_tread));
      double& depth = of_riser ? riser : tread;
      depth = std::max(depth, c.depth);
    }
    CHECK(std::abs(riser - in_riser) < 1e-12);
    CHECK(std::abs(tread - in_tread) < 1e-12);
  }
}
