#include "tests/collision/narrow_phase/oracle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace twinarm::test {
namespace {

// Distance of the origin from a triangle: inside its prism from the plane, else from a side.
double distance_from_triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 n = (b - a).cross(c - a);
  double best = 1e300;
  bool inside = n.norm() > 0;
  const std::array<Vector3, 3> corner{a, b, c};
  for (int i = 0; i < 3; ++i) {
    const Vector3 &p = corner[i], &q = corner[(i + 1) % 3];
    const double t = std::clamp(-p.dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p + t * (q - p)).norm());
    inside = inside && (q - p).cross(-p).dot(n) >= 0;
  }
  return inside ? std::min(best, std::abs(a.dot(n.normalized()))) : best;
}

}  // namespace

double Random::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

Vector3 Random::direction() {
  std::normal_distribution<double> normal;
  Vector3 v;
  for (int i = 0; i < 3; ++i) v[i] = normal(engine);
  return v.normalized();
}

Matrix3 Random::rotation() {
  std::normal_distribution<double> normal;
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = normal(engine);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

std::vector<Vector3> core_vertices(const Shape& shape) {
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return hull->vertices;
  if (const auto* box = std::get_if<Box>(&shape)) return box_mesh(box->size).vertices;
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return {{0, 0, -capsule->length / 2}, {0, 0, capsule->length / 2}};
  if (const auto* c = std::get_if<Cylinder>(&shape)) {
    std::vector<Vector3> prism;
    for (int k = 0; k < 96; ++k) {
      const double angle = 2 * std::numbers::pi * (k / 2) / 48;
      prism.emplace_back(c->radius * std::cos(angle), c->radius * std::sin(angle),
                         (k % 2 - 0.5) * c->length);
    }
    return prism;
  }
  return {Vector3::Zero()};
}

double core_radius(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return sphere->radius;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return capsule->radius;
  return 0;
}

double oracle_distance(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  std::vector<Vector3> difference;
  for (const Vector3& p : core_vertices(a)) {
    for (const Vector3& q : core_vertices(b)) difference.push_back(X_WB * q - X_WA * p);
  }
  const ConvexHull hull = convex_hull(difference, 1e-13);
  const double inside = *std::min_element(hull.offsets.begin(), hull.offsets.end());
  double distance = -inside;
  if (inside < 0) {
    distance = 1e300;
    for (const auto& [i, j, k] : hull.triangles) {
      distance = std::min(
          distance, distance_from_triangle(hull.vertices[i], hull.vertices[j], hull.vertices[k]));
    }
  }
  return distance - core_radius(a) - core_radius(b);
}

double sampled_depth(Random& random, const PosedShape& a, const PosedShape& b) {
  std::vector<std::pair<double, Vector3>> tried;
  for (int k = 0; k < 500; ++k) {
    const Vector3 n = random.direction();
    tried.emplace_back(overlap(a, b, n), n);
  }
  std::partial_sort(tried.begin(), tried.begin() + 3, tried.end(),
                    [](const auto& x, const auto& y) { return x.first < y.first; });
  double least = tried[0].first;
  for (int k = 0; k < 3; ++k) {
    auto [value, n] = tried[static_cast<std::size_t>(k)];
    for (double step = 0.1; step > 1e-6; step *= 0.93) {
      for (int i = 0; i < 4; ++i) {
        const Vector3 trial = (n + step * random.direction()).normalized();
        const double found = overlap(a, b, trial);
        if (found < value) value = found, n = trial;
      }
    }
    least = std::min(least, value);
  }
  return least;
}

Pose random_pose(Random& random) {
  return {random.rotation(), random.uniform(0, 1) * random.direction()};
}

Matrix3 quarter_turns(Random& random) {
  Matrix3 R = Matrix3::Identity();
  for (int i = 0; i < 3; ++i) {
    const Matrix3 turn =
        Eigen::AngleAxisd(M_PI / 2, Vector3::Unit(i)).toRotationMatrix().array().round();
    for (int n = static_cast<int>(random.uniform(0, 4)); n > 0; --n) R = turn * R;
  }
  return R;
}

Pose pushed_against(Random& random, const Shape& a, const Pose& X_WA, const Shape& b, double gap) {
  Pose X_WB{random.rotation(), Vector3::Zero()};
  const Vector3 n = random.direction();
  const Vector3 top = X_WA * support(a, X_WA.R.transpose() * n);
  const Vector3 bottom = X_WB * support(b, -(X_WB.R.transpose() * n));
  // Aim near the middle of A, not at the support vertex.
  const Vector3 aim = X_WA.p + 0.03 * random.direction();
  X_WB.p = aim + n * (n.dot(top - aim) - n.dot(bottom) + gap);
  return X_WB;
}

ConvexHull random_hull(Random& random) {
  std::vector<Vector3> points;
  for (int i = 0; i < 40; ++i)
    points.push_back(random.direction().cwiseProduct(Vector3(0.1, 0.06, 0.05)));
  return convex_hull(points);
}

TriangleMesh box_mesh(const Vector3& size) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1 ? 0.5 : -0.5) * size.x(), (i & 2 ? 0.5 : -0.5) * size.y(),
                               (i & 4 ? 0.5 : -0.5) * size.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Pose& X, double scale) {
  for (Vector3& v : mesh.vertices) v = X * Vector3(scale * v);
  return mesh;
}

}  // namespace twinarm::test
