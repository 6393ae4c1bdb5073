// FCL's narrow phase (libccd), as far as it is reliable: unsigned distance (GJK) at tolerance 1e-10
// between cores, which are the shapes shrunk by a margin m, and closed forms of spheres and
// capsules. The shapes are approximated by their cores with rounded surfaces, so that
//   depth = m_A + m_B - distance,  n = difference of the nearest points
// Two boxes that overlap: dBoxBox2. Cores that overlap: collide() (MPR of libccd). Not the signed
// distance, which throws and hangs, nor GST_INDEP, whose normals are in the wrong frame.
// Every normal is verified by support points; the depth of the result is overlap(n) of the true
// shapes. A is at the origin: no cancellation.
#include "collision/detection/fcl_contact.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace twinarm {
namespace {

constexpr double kCoreMargin = 1e-3;     // m, for all but spheres and capsules [m]
constexpr double kMaxCoreMargin = 0.25;  // of the smallest extent from the centre
constexpr double kPointRadius = 1e-9;    // of the cores of spheres and capsules [m]
constexpr double kDistanceTolerance = 1e-10, kCollideTolerance = 1e-8;
constexpr double kRounding = 1e-6, kMaxDepthError = 1e-3;  // of a consistent answer: [m], relative
constexpr double kFaceGain = 1e-9;     // a face normal with an overlap this close is preferred [m]

using FclGeometry = std::shared_ptr<const fcl::CollisionGeometryd>;

FclGeometry geometry_of(const Sphere& s) {
  return std::make_shared<fcl::Sphered>(s.radius);
}
FclGeometry geometry_of(const Capsule& s) {
  return std::make_shared<fcl::Capsuled>(s.radius, s.length);
}
FclGeometry geometry_of(const Box& s) {
  return std::make_shared<fcl::Boxd>(s.size);
}
FclGeometry geometry_of(const Cylinder& s) {
  return std::make_shared<fcl::Cylinderd>(s.radius, s.length);
}
FclGeometry geometry_of(const Ellipsoid& s) {
  return std::make_shared<fcl::Ellipsoidd>(s.semi_axes);
}
FclGeometry geometry_of(const ConvexHull& s) {
  auto faces = std::make_shared<std::vector<int>>();
  for (const auto& loop : s.faces) {  // FCL's format: count, then the vertices
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  return std::make_shared<fcl::Convexd>(std::make_shared<std::vector<Vector3>>(s.vertices),
                                        static_cast<int>(s.faces.size()), faces);
}

// The core of a shape, and its margin m [m].
template <class S>
using Core = std::pair<S, double>;

double core_margin(double smallest_extent) {
  return std::min(kCoreMargin, kMaxCoreMargin * smallest_extent);
}
Core<Sphere> core_of(const Sphere& s) {
  return {{kPointRadius}, s.radius - kPointRadius};
}
Core<Capsule> core_of(const Capsule& s) {
  return {{kPointRadius, s.length}, s.radius - kPointRadius};
}
Core<Box> core_of(const Box& s) {
  const double m = core_margin(s.size.minCoeff() / 2);
  return {{s.size - Vector3::Constant(2 * m)}, m};
}
Core<Cylinder> core_of(const Cylinder& s) {
  const double m = core_margin(std::min(s.radius, s.length / 2));
  return {{s.radius - m, s.length - 2 * m}, m};
}
Core<Ellipsoid> core_of(const Ellipsoid& s) {
  const double m = core_margin(s.semi_axes.minCoeff());
  return {{s.semi_axes - Vector3::Constant(m)}, m};
}
// Scaled about the mean of its vertices, so that the nearest face moves by m.
Core<ConvexHull> core_of(const ConvexHull& s) {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& v : s.vertices) centre += v / static_cast<double>(s.vertices.size());
  double extent = 1e300;
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    extent = std::min(extent, s.offsets[f] - s.normals[f].dot(centre));
  Core<ConvexHull> core{s, core_margin(extent)};
  for (Vector3& v : core.first.vertices) v += core.second / extent * (centre - v);
  return core;
}

// A shape, or its core with the margin [m].
struct Body {
  Shape shape;
  FclGeometry geometry;
  double margin = 0;
};
struct Solid {
  Body whole, core;  // without geometry: not for FCL
  bool is_box() const { return std::holds_alternative<Box>(whole.shape); }
  bool is_round() const {
    return std::holds_alternative<Sphere>(whole.shape) ||
           std::holds_alternative<Capsule>(whole.shape);
  }
};

// In the frame of A.
struct FclNormal {
  Vector3 n, p;      // p: near the deepest point
  double depth = 0;  // according to FCL [m]
};

// Nearest points. False if the bodies without their margins overlap.
bool find_nearest(const Body& a, const Body& b, const fcl::Transform3d& X_AB, FclNormal& found) {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, /*enable_signed_distance=*/false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = kDistanceTolerance;
  fcl::DistanceResultd result;
  fcl::distance(a.geometry.get(), fcl::Transform3d::Identity(), b.geometry.get(), X_AB, request,
                result);
  if (!(result.min_distance > kMinGjkDistance)) return false;
  const Vector3 p_A = result.nearest_points[0], p_B = result.nearest_points[1];
  const Vector3 n = (p_B - p_A).normalized();
  found = {n, 0.5 * (p_A + a.margin * n + p_B - b.margin * n),
           a.margin + b.margin - result.min_distance};
  return true;
}

// Penetration, without margins. False if FCL finds none.
bool find_penetration(const Body& a, const Body& b, const fcl::Transform3d& X_AB,
                      FclNormal& found) {
  fcl::CollisionRequestd request(/*num_max_contacts=*/1, /*enable_contact=*/true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = kCollideTolerance;
  fcl::CollisionResultd result;
  fcl::collide(a.geometry.get(), fcl::Transform3d::Identity(), b.geometry.get(), X_AB, request,
               result);
  if (!result.isCollision()) return false;
  const fcl::Contactd& contact = result.getContact(0);
  found = {contact.normal, contact.pos, contact.penetration_depth};
  return true;
}

// Whether FCL's depth is the overlap along its normal.
bool is_consistent(const Body& a, const Body& b, const fcl::Transform3d& X_AB,
                   const FclNormal& found) {
  const Vector3 p_A = support(a.shape, found.n);
  const Vector3 p_B = X_AB * support(b.shape, -(X_AB.linear().transpose() * found.n));
  const double depth = (p_A - p_B).dot(found.n) + a.margin + b.margin;
  return std::abs(found.n.norm() - 1) < 1e-9 &&  // false for NaN
         std::abs(depth - found.depth) <= kRounding + kMaxDepthError * std::abs(depth);
}

// False if FCL has no consistent answer.
bool find(const Solid& a, const Solid& b, const Pose& X, FclNormal& found) {
  fcl::Transform3d X_AB = fcl::Transform3d::Identity();
  X_AB.linear() = X.R;
  X_AB.translation() = X.p;
  // The radius of a sphere or capsule is margin enough for both.
  const Body& core_a = a.is_round() || !b.is_round() ? a.core : a.whole;
  const Body& core_b = b.is_round() || !a.is_round() ? b.core : b.whole;
  try {
    const bool overlap = a.is_box() && b.is_box() && find_penetration(a.whole, b.whole, X_AB, found);
    if (!overlap && find_nearest(core_a, core_b, X_AB, found))
      return is_consistent(core_a, core_b, X_AB, found);
    return (overlap || find_penetration(a.whole, b.whole, X_AB, found)) &&
           is_consistent(a.whole, b.whole, X_AB, found);
  } catch (const std::exception&) {
    return false;
  }
}

class LibccdContact final : public FclContact {
 public:
  void add(const Shape& shape) override {
    Solid& solid = solids_.emplace_back();
    std::visit(
        [&](const auto& s) {
          if constexpr (requires { core_of(s); }) {
            const auto [core, margin] = core_of(s);
            solid = {{s, geometry_of(s)}, {core, geometry_of(core), margin}};
          }
        },
        shape);
  }

  Answer nearest(int a, int b, const PosedShape& at_a, const PosedShape& at_b, double margin,
                 NearestPair& pair) noexcept override {
    const Solid& solid_a = solids_[static_cast<std::size_t>(a)];
    const Solid& solid_b = solids_[static_cast<std::size_t>(b)];
    if (!solid_a.core.geometry || !solid_b.core.geometry) return Answer::none;
    FclNormal found;
    if (!find(solid_a, solid_b, at_a.X_WG.inverse() * at_b.X_WG, found)) return Answer::rejected;
    try_direction(at_a, at_b, at_a.X_WG.R * found.n, 0, pair.axis);
    prefer_face(at_a, 1, at_a, at_b, pair.axis);
    prefer_face(at_b, -1, at_a, at_b, pair.axis);
    pair.p_W = midway(at_a, at_b, pair.axis.n_W, at_a.X_WG * found.p);
    return pair.axis.overlap > -margin ? Answer::contact : Answer::apart;
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
