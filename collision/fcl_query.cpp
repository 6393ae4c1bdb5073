// FCL 0.7 with libccd 2.1, used only where it was measured to be right (DEPENDENCIES.md, B):
// * unsigned distance at tolerance 1e-10 (GJK): no exception and no hang in 200,000 queries. Not
// the
//   signed one, which throws and hangs; not GST_INDEP, whose normals are in the wrong frame.
// * the direction of collide() (MPR), as one candidate among others.
// Points and segments are `Convex` with one and two vertices, for which GJK ends at the exact
// feature; a tiny sphere would leave an error of its radius.
// A is put at the origin, so that the answer does not lose digits far from it.
#include "collision/fcl_query.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>
#include <vector>

namespace twinarm {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

struct FclShape::Impl {
  std::array<Geometry, core_count> by_core;  // indexed by Core
  std::array<double, core_count> erosion{};
  const fcl::CollisionGeometryd* at(Core core) const {
    return by_core[static_cast<std::size_t>(core)].get();
  }
};

namespace {

constexpr double distance_tolerance = 1e-10;
constexpr double collide_tolerance = 1e-8;

Geometry convex_of(const ConvexHull& hull) {
  auto vertices = std::make_shared<std::vector<Vector3>>(hull.vertices);
  auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& loop : hull.faces) {  // as FCL wants it: count, then the corners
    faces->push_back(static_cast<int>(loop.size()));
    faces->insert(faces->end(), loop.begin(), loop.end());
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(hull.faces.size()), faces);
}

Geometry eroded(const Cylinder& c, double margin) {
  return std::make_shared<fcl::Cylinderd>(c.radius - margin, c.length - 2 * margin);
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
    impl.by_core.fill(std::make_shared<fcl::Boxd>(box->size));
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    const double thickness = std::min(cylinder->radius, cylinder->length / 2);
    impl.erosion = {0, std::min(0.002, 0.1 * thickness), thickness / 3, 2 * thickness / 3,
                    0.9 * thickness};
    for (std::size_t i = 0; i < core_count; ++i) {
      impl.by_core[i] = eroded(*cylinder, impl.erosion[i]);
    }
  } else if (core.exists) {
    impl.by_core.fill(convex_of(core.hull));
  }
  impl_ = std::make_shared<const Impl>(std::move(impl));
}

double FclShape::erosion(Core core) const {
  return impl_->erosion[static_cast<std::size_t>(core)];
}

CoreDistance core_distance(const FclShape& a, const Pose& X_WA, const FclShape& b, const Pose& X_WB,
                           Core core) {
  fcl::DistanceRequestd request(/*enable_nearest_points=*/true, /*enable_signed_distance=*/false);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.distance_tolerance = distance_tolerance;
  fcl::DistanceResultd result;
  CoreDistance answer;
  try {
    fcl::distance(a.impl()->at(core), fcl::Transform3d::Identity(), b.impl()->at(core),
                  transform_of(X_WA.inverse() * X_WB), request, result);
  } catch (const std::exception&) {  // never seen for unsigned distance; a step must not throw
    return answer;
  }
  if (!(result.min_distance > 0)) return answer;
  answer.p_WA = X_WA * Vector3(result.nearest_points[0]);
  answer.p_WB = X_WA * Vector3(result.nearest_points[1]);
  if (answer.p_WA.allFinite() && answer.p_WB.allFinite()) answer.distance = result.min_distance;
  return answer;
}

std::optional<Vector3> penetration_direction(const FclShape& a, const Pose& X_WA, const FclShape& b,
                                             const Pose& X_WB) {
  fcl::CollisionRequestd request(/*num_max_contacts=*/1, /*enable_contact=*/true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = collide_tolerance;
  fcl::CollisionResultd result;
  try {
    fcl::collide(a.impl()->at(Core::whole), fcl::Transform3d::Identity(), b.impl()->at(Core::whole),
                 transform_of(X_WA.inverse() * X_WB), request, result);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  if (result.numContacts() == 0) return std::nullopt;
  const Vector3 n = X_WA.R * result.getContact(0).normal;
  if (!n.allFinite() || n.norm() < 0.5) return std::nullopt;
  return n.normalized();
}

}  // namespace twinarm
