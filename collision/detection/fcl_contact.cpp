// FCL's narrow phase (libccd), as far as it is reliable: unsigned distance (GJK, closed forms) at
// tolerance 1e-10 between cores, the shapes shrunk by a margin m:
//   depth = m_A + m_B - distance,  n = difference of the nearest points
// and dBoxBox2 for boxes that overlap. Not MPR, whose normals are wrong in up to half of the curved
// pairs, nor the signed distance, which throws and hangs, nor GST_INDEP, whose normals are in the
// wrong frame. Every answer is verified by support points. A is at the origin: no cancellation.
#include "collision/detection/fcl_contact.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <exception>
#include <utility>

namespace twinarm {
namespace {

constexpr double kCoreMargin = 1e-3;     // m, for all but spheres and capsules [m]
constexpr double kMaxCoreMargin = 0.25;  // of the smallest extent from the centre
constexpr double kPointRadius = 1e-9;    // of the cores of spheres and capsules [m]
constexpr double kDistanceTolerance = 1e-10;
constexpr double kRounding = 1e-6, kMaxDepthError = 1e-3;  // of a consistent answer: [m], relative
constexpr double kFaceGain = 1e-9;  // a face normal with an overlap this close is preferred [m]

using FclGeometry = std::shared_ptr<const fcl::CollisionGeometryd>;

struct MakeGeometry {
  FclGeometry operator()(const Sphere& s) { return std::make_shared<fcl::Sphered>(s.radius); }
  FclGeometry operator()(const Capsule& s) {
    return std::make_shared<fcl::Capsuled>(s.radius, s.length);
  }
  FclGeometry operator()(const Box& s) { return std::make_shared<fcl::Boxd>(s.size); }
  FclGeometry operator()(const Cylinder& s) {
    return std::make_shared<fcl::Cylinderd>(s.radius, s.length);
  }
  FclGeometry operator()(const Ellipsoid& s) {
    return std::make_shared<fcl::Ellipsoidd>(s.semi_axes);
  }
  FclGeometry operator()(const ConvexHull& s) {
    auto faces = std::make_shared<std::vector<int>>();
    for (const auto& loop : s.faces) {  // FCL's format: count, then the vertices
      faces->push_back(static_cast<int>(loop.size()));
      faces->insert(faces->end(), loop.begin(), loop.end());
    }
    return std::make_shared<fcl::Convexd>(std::make_shared<std::vector<Vector3>>(s.vertices),
                                          static_cast<int>(s.faces.size()), faces);
  }
};

// Replaces a shape by its core and returns the margin m [m].
struct Shrink {
  static double margin(double smallest_extent) {
    return std::min(kCoreMargin, kMaxCoreMargin * smallest_extent);
  }
  double operator()(Sphere& s) { return std::exchange(s.radius, kPointRadius) - kPointRadius; }
  double operator()(Capsule& s) { return std::exchange(s.radius, kPointRadius) - kPointRadius; }
  double operator()(Box& s) {
    const double m = margin(s.size.minCoeff() / 2);
    s.size.array() -= 2 * m;
    return m;
  }
  double operator()(Cylinder& s) {
    const double m = margin(std::min(s.radius, s.length / 2));
    s.radius -= m, s.length -= 2 * m;
    return m;
  }
  double operator()(Ellipsoid& s) {
    const double m = margin(s.semi_axes.minCoeff());
    s.semi_axes.array() -= m;
    return m;
  }
  // Moves each vertex by m w with w . n = 1 for its faces (least squares).
  double operator()(ConvexHull& s) {
    Vector3 centre = Vector3::Zero();
    for (const Vector3& v : s.vertices) centre += v / static_cast<double>(s.vertices.size());
    double extent = 1e300;
    std::vector<Matrix3> squares(s.vertices.size(), 1e-9 * Matrix3::Identity());
    std::vector<Vector3> sums(s.vertices.size(), Vector3::Zero());
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      const Vector3& n = s.normals[f];
      extent = std::min(extent, s.offsets[f] - n.dot(centre));
      for (const int v : s.faces[f]) squares[v] += n * n.transpose(), sums[v] += n;
    }
    const double m = margin(extent);
    for (std::size_t v = 0; v < s.vertices.size(); ++v)
      s.vertices[v] -= m * squares[v].ldlt().solve(sums[v]);
    return m;
  }
};

// A shape, or its core with the margin [m].
struct Body {
  Shape shape;
  FclGeometry geometry;  // null: not for FCL
  double margin = 0;
};
struct Solid {
  Body whole, core;
  bool is_box() const { return std::holds_alternative<Box>(whole.shape); }
  bool is_round() const {
    return std::holds_alternative<Sphere>(whole.shape) ||
           std::holds_alternative<Capsule>(whole.shape);
  }
};

struct FclNormal {
  Vector3 n, p;        // p: near the deepest point; in the frame of A
  double depth = 0;    // according to FCL [m]
  double margins = 0;  // of both bodies that FCL was given [m]
};

// False if the cores overlap.
bool find_nearest(const Body& a, const Body& b, const fcl::Transform3d& X_AB, FclNormal& found) {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, /*enable_signed_distance=*/false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = kDistanceTolerance;
  fcl::DistanceResultd result;
  fcl::distance(a.geometry.get(), fcl::Transform3d::Identity(), b.geometry.get(), X_AB, request,
                result);
  const Vector3 p_A = result.nearest_points[0], p_B = result.nearest_points[1];
  const Vector3 n = (p_B - p_A).normalized();
  const double margins = a.margin + b.margin;
  found = {n, 0.5 * (p_A + a.margin * n + p_B - b.margin * n), margins - result.min_distance,
           margins};
  return result.min_distance > kMinGjkDistance;
}

// False if FCL finds no overlap.
bool find_overlap(const Body& a, const Body& b, const fcl::Transform3d& X_AB, FclNormal& found) {
  fcl::CollisionResultd result;
  fcl::collide(a.geometry.get(), fcl::Transform3d::Identity(), b.geometry.get(), X_AB,
               fcl::CollisionRequestd(/*num_max_contacts=*/1, /*enable_contact=*/true), result);
  if (!result.isCollision()) return false;
  const fcl::Contactd& contact = result.getContact(0);
  found = {contact.normal, contact.pos, contact.penetration_depth};
  return true;
}

double tolerance(double depth) {
  return kRounding + kMaxDepthError * std::abs(depth);
}

// False if FCL has no answer, or one whose depth is not the overlap along its normal.
bool find(const Solid& a, const Solid& b, const Pose& X, FclNormal& found) {
  fcl::Transform3d X_AB = fcl::Transform3d::Identity();
  X_AB.linear() = X.R;
  X_AB.translation() = X.p;
  const bool overlap = a.is_box() && b.is_box() && find_overlap(a.whole, b.whole, X_AB, found);
  // The radius of a sphere or capsule is margin enough for both.
  const Body& body_a = overlap || (b.is_round() && !a.is_round()) ? a.whole : a.core;
  const Body& body_b = overlap || (a.is_round() && !b.is_round()) ? b.whole : b.core;
  if (!overlap && !find_nearest(body_a, body_b, X_AB, found)) return false;
  const Vector3 p_A = support(body_a.shape, found.n);
  const Vector3 p_B = X * support(body_b.shape, -(X.R.transpose() * found.n));
  const double depth = (p_A - p_B).dot(found.n) + found.margins;
  return std::abs(found.n.norm() - 1) < 1e-9 &&  // false for NaN
         std::abs(depth - found.depth) <= tolerance(depth);
}

class LibccdContact final : public FclContact {
 public:
  void add(const Shape& shape) override {
    Solid& solid = solids_.emplace_back();
    std::visit(
        [&](auto core) {
          if constexpr (requires { Shrink()(core); }) {
            solid.whole = {core, MakeGeometry()(core)};
            const double margin = Shrink()(core);
            solid.core = {core, MakeGeometry()(core), margin};
          }
        },
        shape);
  }

  Answer nearest(int a, int b, const PosedShape& at_a, const PosedShape& at_b, double margin,
                 NearestPair& pair) override {
    const Solid& solid_a = solids_[static_cast<std::size_t>(a)];
    const Solid& solid_b = solids_[static_cast<std::size_t>(b)];
    if (!solid_a.core.geometry || !solid_b.core.geometry) return Answer::none;
    FclNormal found;
    try {
      if (!find(solid_a, solid_b, at_a.X_WG.inverse() * at_b.X_WG, found)) return Answer::rejected;
    } catch (const std::exception&) {  // by FCL: never observed here
      return Answer::rejected;
    }
    try_direction(at_a, at_b, at_a.X_WG.R * found.n, 0, pair.axis);
    prefer_face(at_a, 1, at_a, at_b, pair.axis);
    prefer_face(at_b, -1, at_a, at_b, pair.axis);
    if (!(pair.axis.overlap > -margin)) return Answer::apart;
    if (pair.axis.overlap > found.depth + found.margins + tolerance(found.depth))
      return Answer::rejected;  // at a sharp vertex
    pair.p_W = midway(at_a, at_b, pair.axis.n_W, at_a.X_WG * found.p);
    return Answer::contact;
  }

 private:
  // The normal of the face that touches, if its overlap is as small: without the rounding error of
  // the nearest points.
  void prefer_face(const PosedShape& body, double sign, const PosedShape& a, const PosedShape& b,
                   PenetrationDirection& best) {
    support_feature(body, sign * best.n_W, face_);
    if (face_.is_polygon()) try_direction(a, b, sign * face_.normal_W, -kFaceGain, best);
  }

  std::vector<Solid> solids_;
  Feature face_;
};

}  // namespace
}  // namespace twinarm

twinarm::FclContact* twinarm_fcl_contact() {
  return new twinarm::LibccdContact;
}
