// Winding and normals of arbitrary meshes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <random>
#include <utility>

#include "app/render/list/draw_mesh.h"
#include "app/render/list/visual_model.h"

using namespace twinarm;

namespace {

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// Numbers of very different size, equal, or nearly equal.
TriangleMesh senseless_mesh(std::mt19937& random) {
  static constexpr double kNumbers[] = {0,     1,    -1,  1e-38, 1e-45, 1e38,
                                        -3e38, 1e-7, 0.5, 1e19,  2,     1 + 1e-7};
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  TriangleMesh mesh;
  const auto vertices = static_cast<unsigned>(3 + random() % 12);
  for (unsigned v = 0; v < vertices; ++v) {
    Vector3 p;
    for (double& x : p) x = kNumbers[below(12)];
    mesh.vertices.push_back(p);
  }
  for (auto t = 1 + random() % 30; t > 0; --t) {
    const std::array<int, 3> corners{below(vertices), below(vertices), below(vertices)};
    if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
      mesh.triangles.push_back(corners);
  }
  return mesh;
}

double length_of(const std::array<float, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

TEST_CASE("winding: a closed surface faces outwards, whichever triangles were flipped") {
  for (unsigned flipped = 0; flipped < 16; ++flipped) {
    TriangleMesh mesh = tetrahedron();
    for (std::size_t i = 0; i < 4; ++i)
      if (flipped >> i & 1) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    const ConsistentWinding winding = make_winding_consistent(mesh);
    CHECK(winding.is_closed);
    CHECK(mesh.triangles == tetrahedron().triangles);
    for (std::size_t i = 0; i < 4; ++i) CHECK(winding.flipped[i] == ((flipped >> i & 1) != 0));
  }
}

TEST_CASE("winding: separate surfaces are repaired separately, open ones too") {
  TriangleMesh good;
  for (int copy = 0; copy < 3; ++copy) {
    TriangleMesh part = tetrahedron();
    if (copy == 1) part.triangles.pop_back();
    for (auto& t : part.triangles)
      good.triangles.push_back({t[0] + 4 * copy, t[1] + 4 * copy, t[2] + 4 * copy});
    for (const Vector3& p : part.vertices) good.vertices.push_back(p + Vector3(2.0 * copy, 0, 0));
  }
  for (unsigned flipped = 0; flipped < 1u << 11; flipped += 7) {
    TriangleMesh mesh = good;
    // Of the open part at most one triangle: the side of most of its area counts.
    const unsigned open = flipped >> 4 & 7;
    if ((open & (open - 1)) != 0) continue;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      if (flipped >> i & 1) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    const ConsistentWinding winding = make_winding_consistent(mesh);
    REQUIRE(mesh.triangles == good.triangles);
    CHECK(!winding.is_closed);
  }
}

TEST_CASE("winding: an open surface keeps the side of most of its area") {
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();  // the slanted one
  const auto good = mesh.triangles;
  std::swap(mesh.triangles[1][1], mesh.triangles[1][2]);
  const ConsistentWinding winding = make_winding_consistent(mesh);
  CHECK(!winding.is_closed);
  CHECK(mesh.triangles == good);
}

TEST_CASE("winding: a Moebius strip is open") {
  TriangleMesh strip{{}, {}};
  const int n = 12;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * 3.14159265358979 * i / n;
    const Vector3 out(std::cos(a), std::sin(a), 0);
    const Vector3 half = 0.2 * (std::cos(a / 2) * out + std::sin(a / 2) * Vector3::UnitZ());
    strip.vertices.push_back(out + half);
    strip.vertices.push_back(out - half);
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({c, b, d});
  }
  CHECK(!make_winding_consistent(strip).is_closed);
}

TEST_CASE("a random mesh gives valid indices and unit normals") {
  std::mt19937 random(5);
  std::size_t drawn = 0;
  for (int i = 0; i < 1000; ++i) {
    TriangleMesh mesh = senseless_mesh(random);
    make_winding_consistent(mesh);
    const DrawMesh draw = make_draw_mesh(mesh);
    drawn += draw.triangles.size();
    REQUIRE(draw.normals.size() == draw.positions.size());
    for (const auto& triangle : draw.triangles)
      for (const std::uint32_t corner : triangle) REQUIRE(corner < draw.positions.size());
    for (const auto& normal : draw.normals)
      REQUIRE(length_of(normal) == doctest::Approx(1).epsilon(1e-5));
  }
  CHECK(drawn > 1000);
}

TEST_CASE("a vertex of 100,000 facets is fast, with the normals of a cone") {
  TriangleMesh cone{{{0, 0, 1}}, {}};
  const int n = 100000;
  const auto turn = [](double k) { return 2 * 3.14159265358979 * k / n; };
  for (int k = 0; k < n; ++k) {
    cone.vertices.emplace_back(std::cos(turn(k)), std::sin(turn(k)), 0);
    cone.triangles.push_back({0, 1 + k, 1 + (k + 1) % n});
  }
  const std::clock_t begin = std::clock();
  make_winding_consistent(cone);
  const DrawMesh draw = make_draw_mesh(cone);
  CHECK(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC < 20);  // squared: minutes
  REQUIRE(draw.triangles.size() == static_cast<std::size_t>(n));
  const double half = std::sqrt(0.5);
  for (int k = 0; k < n; k += 999)
    for (const std::uint32_t corner : draw.triangles[static_cast<std::size_t>(k)]) {
      const auto& normal = draw.normals[corner];
      CHECK(std::abs(normal[0] - half * std::cos(turn(k + 0.5))) < 1e-3);
      CHECK(std::abs(normal[1] - half * std::sin(turn(k + 0.5))) < 1e-3);
      CHECK(std::abs(normal[2] - half) < 1e-3);
    }
}
