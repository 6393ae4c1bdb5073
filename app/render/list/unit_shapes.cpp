// Unit shapes: box, sphere, cylinder, cone and helical spring. Round parts have facets below the
// crease angle of make_draw_mesh().
#include <algorithm>
#include <cassert>
#include <cmath>

#include "app/render/list/draw_mesh.h"

namespace twinarm {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSegments = 48;        // around a sphere, cylinder or cone
constexpr int kCoarseSegments = 20;  // around a sphere of which there are many

int add(TriangleMesh& mesh, const Vector3& p) {
  mesh.vertices.push_back(p);
  return static_cast<int>(mesh.vertices.size()) - 1;
}

void add_quad(TriangleMesh& mesh, int a, int b, int c, int d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

TriangleMesh box() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {  // bit k of i: the far side along axis k
    add(mesh, Vector3((i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5));
  }
  add_quad(mesh, 0, 2, 3, 1);
  add_quad(mesh, 4, 5, 7, 6);
  add_quad(mesh, 0, 1, 5, 4);
  add_quad(mesh, 2, 6, 7, 3);
  add_quad(mesh, 0, 4, 6, 2);
  add_quad(mesh, 1, 3, 7, 5);
  return mesh;
}

// Joins two rings of `count` vertices with first indices `lower` and `upper`.
void add_band(TriangleMesh& mesh, int lower, int upper, int count) {
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    add_quad(mesh, lower + i, lower + next, upper + next, upper + i);
  }
}

// Closes a ring with a fan; `up`: its outside faces +z.
void add_fan(TriangleMesh& mesh, int ring, int count, const Vector3& tip, bool up) {
  const int center = add(mesh, tip);
  for (int i = 0; i < count; ++i) {
    const int a = ring + i, b = ring + (i + 1) % count;
    mesh.triangles.push_back(up ? std::array<int, 3>{a, b, center}
                                : std::array<int, 3>{b, a, center});
  }
}

int add_ring(TriangleMesh& mesh, double radius, double z, int segments = kSegments) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * kPi * i / segments;
    add(mesh, Vector3(radius * std::cos(angle), radius * std::sin(angle), z));
  }
  return first;
}

TriangleMesh sphere(int segments) {
  const int rings = segments / 2;  // from pole to pole
  TriangleMesh mesh;
  for (int j = 1; j < rings; ++j) {
    const double latitude = kPi * j / rings - kPi / 2;
    const int ring = add_ring(mesh, std::cos(latitude), std::sin(latitude), segments);
    if (j > 1) add_band(mesh, ring - segments, ring, segments);
  }
  add_fan(mesh, 0, segments, -Vector3::UnitZ(), false);
  add_fan(mesh, (rings - 2) * segments, segments, Vector3::UnitZ(), true);
  return mesh;
}

TriangleMesh cylinder() {
  TriangleMesh mesh = surface_of_revolution({{1, 0}, {1, 1}});
  add_fan(mesh, 0, kSegments, Vector3::Zero(), false);
  add_fan(mesh, kSegments, kSegments, Vector3::UnitZ(), true);
  return mesh;
}

TriangleMesh cone() {
  TriangleMesh mesh;
  const int base = add_ring(mesh, 1, 0);
  add_fan(mesh, base, kSegments, Vector3::Zero(), false);
  add_fan(mesh, base, kSegments, Vector3::UnitZ(), true);
  return mesh;
}

// The spring's centre line and wire, all lengths in coil radii.
constexpr int kTurns = 9;
constexpr int kStepsPerTurn = 24;
constexpr int kWireSegments = 12;
constexpr double kWireRadius = 0.17;
constexpr double kLead = 0.10;  // length share of each straight end
constexpr double kRamp = 0.05;  // length share from the axis to the coil

double smooth_step(double low, double high, double t) {
  const double s = std::min(1.0, std::max(0.0, (t - low) / (high - low)));
  return s * s * (3 - 2 * s);
}

double winding_angle(double t) {
  return 2 * kPi * kTurns * (t - kLead) / (1 - 2 * kLead);
}

// Point of the centre line at t in [0, 1], for a spring of the given length.
Vector3 center_line(double t, double length) {
  const double out =
      smooth_step(kLead, kLead + kRamp, t) * smooth_step(kLead, kLead + kRamp, 1 - t);
  const double angle = winding_angle(t);
  return {out * std::cos(angle), out * std::sin(angle), length * t};
}

TriangleMesh spring(double length) {
  constexpr int kSteps = static_cast<int>(kTurns / (1 - 2 * kLead) * kStepsPerTurn);
  TriangleMesh mesh;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps, step = 0.25 / kSteps;
    const Vector3 along =
        (center_line(t + step, length) - center_line(t - step, length)).normalized();
    // The outward direction, made normal to the wire.
    const double angle = winding_angle(t);
    const Vector3 outward(std::cos(angle), std::sin(angle), 0);
    const Vector3 side = along.cross(outward).normalized(), up = side.cross(along);
    const int ring = static_cast<int>(mesh.vertices.size());
    for (int k = 0; k < kWireSegments; ++k) {
      const double phi = 2 * kPi * k / kWireSegments;
      add(mesh, center_line(t, length) + kWireRadius * (std::cos(phi) * up - std::sin(phi) * side));
    }
    if (i > 0) add_band(mesh, ring - kWireSegments, ring, kWireSegments);
  }
  const int last = static_cast<int>(mesh.vertices.size()) - kWireSegments;
  add_fan(mesh, 0, kWireSegments, Vector3::Zero(), false);
  add_fan(mesh, last, kWireSegments, Vector3(0, 0, length), true);
  return mesh;
}

}  // namespace

TriangleMesh surface_of_revolution(const std::vector<Eigen::Vector2d>& profile) {
  TriangleMesh mesh;
  int below = -1;
  for (const Eigen::Vector2d& p : profile) {
    const int ring = add_ring(mesh, p.x(), p.y());
    if (below >= 0) add_band(mesh, below, ring, kSegments);
    below = ring;
  }
  return mesh;
}

DrawMesh make_unit_mesh(UnitShape shape) {
  switch (shape) {
    case UnitShape::box: {
      const TriangleMesh mesh = box();
      return make_draw_mesh(mesh, places_on_box(mesh));
    }
    case UnitShape::sphere:
    case UnitShape::coarse_sphere: {
      const TriangleMesh mesh = sphere(shape == UnitShape::sphere ? kSegments : kCoarseSegments);
      const auto down = [](const Vector3& p) { return std::acos(p.z()) / kPi; };
      return make_draw_mesh(mesh, places_around_z(mesh, down));
    }
    case UnitShape::cylinder: {
      const TriangleMesh mesh = cylinder();
      const auto down = [](const Vector3& p) { return 1 - p.z(); };
      return make_draw_mesh(mesh, places_around_z(mesh, down, 1));
    }
    case UnitShape::cone:
      return make_draw_mesh(cone());
  }
  assert(false);
  return {};
}

DrawMesh make_unit_spring(double aspect) {
  assert(aspect > 0);
  DrawMesh mesh = make_draw_mesh(spring(aspect));  // true proportions: normals by true angles
  // Scale to unit length; normals by the transpose of the inverse scale, which the painter undoes.
  const auto squash = static_cast<float>(1 / aspect), stretch = static_cast<float>(aspect);
  for (auto& p : mesh.positions) p[2] *= squash;
  for (auto& n : mesh.normals) {
    n[2] *= stretch;
    const float norm = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& x : n) x /= norm;
  }
  mesh.bound_center = Vector3(0, 0, 0.5);
  mesh.bound_radius = std::hypot(1 + kWireRadius, 0.5 + kWireRadius / aspect);
  return mesh;
}

}  // namespace twinarm
