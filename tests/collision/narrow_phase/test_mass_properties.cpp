// Closed forms: box, tetrahedron, sphere; transformations and sums.
#include "collision/shapes/shape.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "collision/mesh_files/mesh_file.h"
#include "solver/support/diagnostics.h"
#include "tests/collision/narrow_phase/oracle.h"

using namespace twinarm;
using namespace twinarm::test;

namespace {

MassProperties box_properties(const Vector3& s, double density) {
  const double m = density * s.prod();
  const Vector3 sq = s.cwiseProduct(s);
  const Vector3 moments(sq.y() + sq.z(), sq.x() + sq.z(), sq.x() + sq.y());
  return {m, Vector3::Zero(), Matrix3((m / 12 * moments).asDiagonal())};
}

void check_close(const MassProperties& found, const MassProperties& truth, double tolerance) {
  CHECK(std::abs(found.mass - truth.mass) < tolerance * truth.mass);
  CHECK((found.com - truth.com).norm() < tolerance * (1 + truth.com.norm()));
  CHECK((found.inertia - truth.inertia).norm() < tolerance * truth.inertia.norm());
}

// From the definitions of the shapes, not from their supports.
bool is_inside(const Shape& shape, const Vector3& x) {
  const double rho = std::hypot(x.x(), x.y());
  if (const auto* s = std::get_if<Sphere>(&shape)) return x.norm() < s->radius;
  if (const auto* b = std::get_if<Box>(&shape))
    return (2 * x.cwiseAbs().array() < b->size.array()).all();
  if (const auto* e = std::get_if<Ellipsoid>(&shape))
    return x.cwiseQuotient(e->semi_axes).norm() < 1;
  if (const auto* c = std::get_if<Cylinder>(&shape))
    return rho < c->radius && 2 * std::abs(x.z()) < c->length;
  if (const auto* c = std::get_if<Capsule>(&shape))
    return std::hypot(rho, std::max(0.0, std::abs(x.z()) - c->length / 2)) < c->radius;
  const auto& hull = std::get<ConvexHull>(shape);
  for (std::size_t f = 0; f < hull.normals.size(); ++f) {
    if (hull.normals[f].dot(x) > hull.offsets[f]) return false;
  }
  return true;
}

// Octahedron, each triangle subdivided into four `levels` times, all vertices on the unit sphere.
TriangleMesh sphere_mesh(int levels) {
  TriangleMesh mesh;
  for (int i = 0; i < 3; ++i) {
    mesh.vertices.push_back(Vector3::Unit(i));
    mesh.vertices.push_back(-Vector3::Unit(i));
  }
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middle;
    const auto between = [&](int i, int j) {
      const auto [place, is_new] =
          middle.try_emplace(std::minmax(i, j), static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[i] + mesh.vertices[j]).normalized());
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

}  // namespace

TEST_CASE("a box has m/12 (b^2 + c^2)") {
  const Vector3 size(0.3, 0.5, 0.7);
  check_close(mass_properties(box_mesh(size), 2700), box_properties(size, 2700), 1e-14);
}

TEST_CASE("the corner tetrahedron has volume 1/6, centre 1/4 and moments 1/80, products 1/480") {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  // int x^2 = 1/60, int x y = 1/120 over it; less V/16 at the centre: 1/160 and -1/480.
  Matrix3 inertia = Matrix3::Constant(1.0 / 480);
  inertia.diagonal().setConstant(2.0 / 160);
  check_close(mass_properties(mesh, 1), {1.0 / 6, Vector3::Constant(0.25), inertia}, 1e-14);
}

TEST_CASE("scaling, rotating and translating a box changes its properties as expected") {
  Random random(5);
  const Vector3 size(0.3, 0.5, 0.7);
  const MassProperties box = box_properties(size, 1000);
  for (int k = 0; k < 100; ++k) {
    const Pose X{random.rotation(), 10 * random.direction()};
    const double s = random.uniform(0.1, 3);
    const MassProperties truth{std::pow(s, 3) * box.mass, X.p,
                               std::pow(s, 5) * X.R * box.inertia * X.R.transpose()};
    check_close(mass_properties(moved(box_mesh(size), X, s), 1000), truth, 1e-12);
  }
}

TEST_CASE("a refined sphere mesh converges to the sphere with order 2 in the edge length") {
  const double volume = 4 * std::numbers::pi / 3;
  std::array<double, 2> before{};
  for (int level = 2; level <= 5; ++level) {
    const MassProperties found = mass_properties(sphere_mesh(level), 1);
    const std::array<double, 2> error{volume - found.mass,
                                      0.4 * volume - found.inertia.trace() / 3};
    if (level > 2) {
      for (std::size_t i = 0; i < 2; ++i)
        CHECK(before[i] / error[i] == doctest::Approx(4).epsilon(0.06));
    }
    before = error;
  }
}

TEST_CASE("every solid shape has the mass and inertia of two million of its points") {
  const std::vector<Vector3> corners = box_mesh({0.2, 0.3, 0.4}).vertices;
  Random random(47);
  for (const Shape& shape :
       {Shape(Sphere{0.2}), Shape(Box{{0.2, 0.3, 0.4}}), Shape(Capsule{0.1, 0.3}),
        Shape(Cylinder{0.1, 0.3}), Shape(Ellipsoid{{0.1, 0.2, 0.3}}), Shape(random_hull(random)),
        Shape(convex_hull(corners))}) {
    CAPTURE(shape_name(shape));
    Vector3 half;  // its bounding box
    for (int i = 0; i < 3; ++i) {
      half[i] =
          std::max(support(shape, Vector3::Unit(i))[i], -support(shape, -Vector3::Unit(i))[i]);
    }
    const int count = 120;  // midpoints of cells: not random
    double inside = 0;
    Vector3 first = Vector3::Zero();
    Matrix3 second = Matrix3::Zero();
    for (int i = 0; i < count * count * count; ++i) {
      const Eigen::Array3d cell(i % count, i / count % count, i / count / count);
      const Vector3 x = ((cell + 0.5) / count * 2 - 1) * half.array();
      if (!is_inside(shape, x)) continue;
      inside += 1;
      first += x;
      second += x * x.transpose();
    }
    const double cell = 8 * half.prod() / std::pow(count, 3);
    const Vector3 com = first / inside;
    const Matrix3 central = (second - inside * com * com.transpose()) * cell * 700;
    const MassProperties truth{700 * inside * cell, com,
                               central.trace() * Matrix3::Identity() - central};
    const MassProperties found = mass_properties(shape, 700);
    check_close(found, truth, 2e-3);
    check_close(with_mass(found, 3), {3, found.com, found.inertia * (3 / found.mass)}, 1e-15);
  }
  check_close(mass_properties(Shape(Box{{0.3, 0.5, 0.7}}), 2700),
              box_properties({0.3, 0.5, 0.7}, 2700), 1e-15);
  CHECK_THROWS_AS(mass_properties(HalfSpace{}, 1000), InputError);
  CHECK_THROWS_AS(mass_properties(Sphere{0}, 1000), InputError);
  CHECK_THROWS_AS(mass_properties(Sphere{1}, -1), InputError);
}

TEST_CASE("a hollow box is the outer minus the inner one, by mesh and by combine") {
  const Vector3 outer(0.4, 0.3, 0.2), inner(0.2, 0.1, 0.1), shift(0.05, -0.02, 0.01);
  MassProperties hole = box_properties(inner, -500);
  hole.com = shift;
  const std::array parts{box_properties(outer, 500), hole};
  const MassProperties truth = combine(parts);
  CHECK(truth.mass == doctest::Approx(500 * (0.024 - 0.002)));

  TriangleMesh mesh = box_mesh(outer);
  const TriangleMesh cavity = moved(box_mesh(inner), {Matrix3::Identity(), shift});
  mesh.vertices.insert(mesh.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  for (const auto& [a, b, c] : cavity.triangles) mesh.triangles.push_back({a + 8, c + 8, b + 8});
  check_close(mass_properties(mesh, 500), truth, 1e-13);
}

TEST_CASE("two halves combine to the whole") {
  const std::array halves{
      mass_properties(moved(box_mesh({0.2, 0.5, 0.7}), {Matrix3::Identity(), {0.1, 0, 0}}), 800),
      mass_properties(moved(box_mesh({0.2, 0.5, 0.7}), {Matrix3::Identity(), {-0.1, 0, 0}}), 800)};
  check_close(combine(halves), box_properties({0.4, 0.5, 0.7}, 800), 1e-13);
}

TEST_CASE("open, inverted and massless solids are rejected") {
  TriangleMesh open = box_mesh({1, 1, 1}), inverted = open, doubled = open, flipped = open;
  open.triangles.pop_back();
  for (auto& t : inverted.triangles) std::swap(t[0], t[1]);
  doubled.triangles.push_back(doubled.triangles.front());
  std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
  for (const TriangleMesh& mesh : {open, inverted, doubled, flipped, TriangleMesh{}})
    CHECK_THROWS_AS(mass_properties(mesh, 1000), InputError);
  CHECK_THROWS_AS(mass_properties(box_mesh({1, 1, 1}), 0), InputError);
  CHECK_THROWS_AS(combine(std::vector<MassProperties>{}), InputError);
  CHECK(is_closed(box_mesh({1, 1, 1})));
  CHECK(!is_closed(open));
  CHECK(!is_closed(flipped));
}
