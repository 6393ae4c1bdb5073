// Triangle meshes as obstacles: against convex bodies of the same shape, and across internal edges.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "collision/detection/collision_world.h"
#include "collision/shapes/mesh_shape.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/detection/pair_scene.h"
#include "tests/collision/narrow_phase/oracle.h"
#include "tests/collision/shapes/step_mesh.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

// A square of n x n cells, two triangles each, at z = height(x, y).
template <class Height>
TriangleMesh terrain(int n, double size, Height height) {
  TriangleMesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = size * (static_cast<double>(i) / n - 0.5);
      const double y = size * (static_cast<double>(j) / n - 0.5);
      mesh.vertices.emplace_back(x, y, height(x, y));
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i, up = v + n + 1;
      mesh.triangles.push_back({v, v + 1, up + 1});
      mesh.triangles.push_back({v, up + 1, up});
    }
  }
  return mesh;
}

std::vector<Shape> bodies() {
  Random random(7);
  return {Sphere{0.06},         Box{{0.2, 0.14, 0.1}}, Capsule{0.05, 0.2},
          Cylinder{0.06, 0.15}, random_hull(random),   Ellipsoid{{0.11, 0.05, 0.07}}};
}

}  // namespace

TEST_CASE("a closed mesh of a box has the contacts of the box, from outside, for every shape") {
  const Vector3 size(0.3, 0.25, 0.2);
  const MeshShape mesh{box_mesh(size)};
  for (const Shape& body : bodies()) {
    CAPTURE(shape_name(body));
    Random random(51);
    PairScene with_mesh(mesh, body), with_box(Box{size}, body), swapped(body, mesh);
    double apart = 0, depth = 0, normal = 0, swap = 0;
    int missed = 0, touched = 0;
    for (int k = 0; k < 1500; ++k) {
      const Pose X_WA = random_pose(random);
      const Pose X_WB = pushed_against(random, Box{size}, X_WA, body, random.uniform(-0.05, 5e-3));
      const double truth = with_box.world.distance(0, 1, X_WA, X_WB);
      if (truth < -1e-3) continue;
      if (truth > 0)
        apart = std::max(apart, std::abs(with_mesh.world.distance(0, 1, X_WA, X_WB) - truth));
      with_box.touch(X_WA, X_WB);
      with_mesh.touch(X_WA, X_WB);
      if (with_box.contacts.empty() != with_mesh.contacts.empty()) ++missed;
      if (with_box.contacts.empty() || with_mesh.contacts.empty()) continue;
      ++touched;
      depth = std::max(depth, std::abs(with_box.depth() - with_mesh.depth()));
      if (truth > 1e-6)
        normal = std::max(normal, (with_mesh.deepest().n_W - with_box.contacts[0].n_W).norm());
      swapped.touch(X_WB, X_WA);
      swap = std::max(swap, std::abs(swapped.depth() - with_mesh.depth()));
    }
    CHECK(touched > 20);
    CHECK(missed == 0);
    CHECK(apart < 1e-8);
    CHECK(depth < 1e-6);
    CHECK(normal < 1e-4);
    CHECK(swap < 1e-8);
  }
}

TEST_CASE("a sphere rolls over internal edges of a flat mesh with a constant normal") {
  for (const bool from_below : {false, true}) {
    PairScene scene(MeshShape{terrain(10, 1, [](double, double) { return 0.0; }), true},
                    Sphere{0.05});
    const double side = from_below ? -1 : 1;
    for (int k = 0; k < 2000; ++k) {
      const double x = -0.4 + 0.0004 * k,
                   y = k % 2 == 0 ? 0.1 : 0.37 * x;  // along and across internal edges
      const double depth = k % 3 == 0 ? 1e-4 : -1e-4;
      scene.touch(origin, {Matrix3::Identity(), {x, y, side * (0.05 - depth)}});
      REQUIRE(scene.contacts.size() == 1);
      const Contact& c = scene.contacts[0];
      CHECK(std::abs(c.depth - depth) < 1e-12);
      CHECK((c.n_W - side * Vector3::UnitZ()).norm() < 1e-12);
      CHECK((c.p_WC - Vector3(x, y, -side * depth / 2)).norm() < 1e-9);
    }
  }
}

TEST_CASE("a box on a flat mesh of many triangles has contacts at its four vertices") {
  Random random(53);
  PairScene scene(MeshShape{terrain(20, 1, [](double, double) { return 0.0; }), true},
                  Box{{0.2, 0.14, 0.1}});
  for (int k = 0; k < 200; ++k) {
    const Matrix3 R = Eigen::AngleAxisd(random.uniform(-3, 3), Vector3::UnitZ()).toRotationMatrix();
    const Pose X{R, {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.05 - 1e-5}};
    scene.touch(origin, X);
    REQUIRE(scene.contacts.size() == 4);
    for (const Contact& c : scene.contacts) {
      CHECK(std::abs(c.depth - 1e-5) < 1e-9);
      CHECK((c.n_W - Vector3::UnitZ()).norm() < 1e-9);
      const Vector3 p = X.inverse() * c.p_WC;
      CHECK(std::abs(std::abs(p.x()) - 0.1) < 1e-9);
      CHECK(std::abs(std::abs(p.y()) - 0.07) < 1e-9);
    }
  }
}

TEST_CASE("a sphere in the corner of three planes of an open mesh touches all three") {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  PairScene scene(MeshShape{mesh, true}, Sphere{0.1});
  scene.touch(origin, {Matrix3::Identity(), Vector3::Constant(0.1 - 1e-5)});
  REQUIRE(scene.contacts.size() == 3);
  Vector3 sum = Vector3::Zero();
  for (const Contact& c : scene.contacts) {
    CHECK(std::abs(c.depth - 1e-5) < 1e-12);
    sum += c.n_W;
  }
  CHECK((sum - Vector3::Ones()).norm() < 1e-9);
}

TEST_CASE("invalid meshes are rejected: empty, open, flipped, degenerate, in millimetres") {
  const auto says = [](const TriangleMesh& mesh, const char* text, bool is_open = false) {
    CAPTURE(text);
    CHECK(MeshShape{mesh, is_open}.fault().find(text) != std::string::npos);
    CollisionWorld world;
    CHECK_THROWS_AS(world.add({"mesh", MeshShape{mesh, is_open}, 0}), InputError);
  };
  const TriangleMesh good = box_mesh({1, 1, 1});
  CHECK(MeshShape{good}.fault().empty());
  TriangleMesh open = good, inverted = good, thin = good, wild = good, nowhere = good;
  open.triangles.pop_back();
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  thin.vertices.push_back(0.5 * (good.vertices[0] + good.vertices[1]));
  thin.triangles.push_back({0, 1, 8});
  wild.triangles[3][1] = 99;
  nowhere.vertices[2].x() = std::nan("");
  says({}, "no triangles");
  says(open, "not closed");
  CHECK(MeshShape{open, true}.fault().empty());
  says(inverted, "inverted");
  says(thin, "no area", true);
  says(wild, "vertex index 99");
  says(nowhere, "not finite");
  says(moved(good, origin, 500), "millimetres");
  CollisionWorld world;
  world.add({"a", MeshShape{good}, 0});
  CHECK_THROWS_AS(world.add({"b", MeshShape{good}, 0}), InputError);
}

TEST_CASE("distances to a mesh with obtuse triangles are those of its triangles") {
  const TriangleMesh step = step_mesh();
  REQUIRE(MeshShape{step}.fault().empty());
  const double margin = 0.02;
  for (const Shape& body : bodies()) {
    CAPTURE(shape_name(body));
    Random random(12);
    PairScene scene(MeshShape{step}, body);
    int near = 0;
    for (int n = 0; n < 4000; ++n) {
      const Vector3 p(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                      random.uniform(-0.15, 0.3));
      const Pose X_WB{random.rotation(), p};
      // The nearest of all triangles.
      const double distance = scene.world.distance(0, 1, origin, X_WB);
      const bool centre_is_outside = std::abs(p.y()) > 0.15 || std::abs(p.x()) > 0.15 ||
                                     p.z() < 0 || p.z() > (p.x() < 0 ? 0.12 : 0.05);
      if (!(distance > 1e-4 && distance < 0.9 * margin) || !centre_is_outside) continue;
      ++near;
      scene.touch(origin, X_WB, margin);
      CAPTURE(n);
      CHECK(std::abs(scene.depth() + distance) < 1e-6);
    }
    CHECK(near > 100);
  }
}
