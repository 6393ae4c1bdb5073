// FCL 0.7 with libccd 2.1, only where it is reliable: unsigned distance at tolerance 1e-10 (GJK),
// no exception and no hang in 200,000 queries. Not the signed distance, which throws and hangs; not
// collide(), whose normals are wrong in up to half of the curved pairs; not GST_INDEP, whose
// normals are in the wrong frame.
// Points and segments are `Convex` with one and two vertices, for which GJK ends at the exact
// feature; a tiny sphere would leave an error of its radius.
// A is at the origin: no cancellation.
#include "tests/collision/shapes/fcl_oracle.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/narrowphase/distance.h>

#include <exception>
#include <utility>
#include <vector>

namespace twinarm::test {

using FclGeometry = std::shared_ptr<const fcl::CollisionGeometryd>;

struct FclShape::Impl {
  FclGeometry geometry;
};

namespace {

constexpr double distance_tolerance = 1e-10;

FclGeometry convex_of(const ConvexHull& hull) {
  auto vertices = std::make_shared<std::vector<Vector3>>(hull.vertices);
  auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& loop : hull.faces) {  // FCL's format: count, then the vertices
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.faces.size()), faces);
}

fcl::Transform3d transform_of(const Pose& X) {
  fcl::Transform3d T = fcl::Transform3d::Identity();
  T.linear() = X.R;
  T.translation() = X.p;
  return T;
}

}  // namespace

FclShape::FclShape(const Shape& shape, const Polytope& core) {
  Impl impl;
  if (const auto* box = std::get_if<Box>(&shape)) {
    impl.geometry = std::make_shared<fcl::Boxd>(box->size);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    impl.geometry = std::make_shared<fcl::Cylinderd>(cylinder->radius, cylinder->length);
  } else if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape)) {
    impl.geometry = std::make_shared<fcl::Ellipsoidd>(ellipsoid->semi_axes);
  } else if (core.exists) {
    impl.geometry = convex_of(core.hull);
  }
  impl_ = std::make_shared<const Impl>(std::move(impl));
}

FclDistance core_distance(const FclShape& a, const Pose& X_WA, const FclShape& b,
                          const Pose& X_WB) {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, /*enable_signed_distance=*/false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = distance_tolerance;
  fcl::DistanceResultd result;
  FclDistance answer;
  try {
    fcl::distance(a.impl()->geometry.get(), fcl::Transform3d::Identity(), b.impl()->geometry.get(),
                  transform_of(X_WA.inverse() * X_WB), request, result);
  } catch (const std::exception&) {  // never observed for unsigned distance
    return answer;
  }
  if (!(result.min_distance > 0)) return answer;
  answer.p_WA = X_WA * Vector3(result.nearest_points[0]);
  answer.p_WB = X_WA * Vector3(result.nearest_points[1]);
  if (answer.p_WA.allFinite() && answer.p_WB.allFinite()) answer.distance = result.min_distance;
  return answer;
}

}  // namespace twinarm::test
