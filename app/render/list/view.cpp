#include "app/render/list/view.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace twinarm {
namespace {

using Eigen::Matrix4d;

constexpr double kIgnoredDistance = 30;  // in viewing distances

double viewing_distance(const Camera& camera) {
  const double distance = (camera.eye - camera.target).norm();
  return distance > 0 && std::isfinite(distance) ? distance : 1.0;
}

void extend(Eigen::AlignedBox3d& box, const Ball& ball) {
  box.extend(ball.center - Vector3::Constant(ball.radius));
  box.extend(ball.center + Vector3::Constant(ball.radius));
}

Ball circumscribed(const Eigen::AlignedBox3d& box) {
  return {box.center(), std::max(1e-6, 0.5 * box.diagonal().norm())};
}

Ball bound(const DrawList& list, const Instance& instance) {
  const DrawMesh& mesh = *list.meshes[instance.mesh];
  return {instance.X_WM * instance.scale.cwiseProduct(mesh.bound_center),
          instance.scale.maxCoeff() * mesh.bound_radius};
}

// Right-handed, looking along -z: the camera's frame, or a light's.
Matrix4d look_from(const Vector3& eye, const Vector3& forward, const Vector3& up) {
  const Vector3 f = forward.normalized();
  Vector3 side = f.cross(up);
  // Forward parallel to `up`: any other direction.
  if (side.norm() < 1e-9 * up.norm()) side = f.cross(Vector3::UnitY());
  if (side.norm() < 1e-9) side = f.cross(Vector3::UnitX());
  side.normalize();
  Matrix4d X = Matrix4d::Identity();
  X.block<1, 3>(0, 0) = side.transpose();
  X.block<1, 3>(1, 0) = side.cross(f).transpose();
  X.block<1, 3>(2, 0) = -f.transpose();
  X.block<3, 1>(0, 3) = -X.block<3, 3>(0, 0) * eye;
  return X;
}

Matrix4d perspective(double field_of_view, double aspect, double near, double far) {
  const double focal = 1 / std::tan(0.5 * field_of_view);
  Matrix4d P = Matrix4d::Zero();
  P(0, 0) = focal / aspect;
  P(1, 1) = focal;
  P(2, 2) = (far + near) / (near - far);
  P(2, 3) = 2 * far * near / (near - far);
  P(3, 2) = -1;
  return P;
}

}  // namespace

SceneBounds bound_scene(const DrawList& list) {
  const Camera& camera = list.camera;
  const double limit = kIgnoredDistance * viewing_distance(camera);
  Eigen::AlignedBox3d solid, all;
  for (const Instance& instance : list.instances) {
    const Ball ball = bound(list, instance);
    if (!((ball.center - camera.target).norm() + ball.radius < limit)) continue;
    extend(all, ball);
    if (instance.color.a >= 1) extend(solid, ball);
  }
  const Ball nothing{camera.target, 0.5 * viewing_distance(camera)};
  return {solid.isEmpty() ? nothing : circumscribed(solid),
          all.isEmpty() ? nothing : circumscribed(all)};
}

double floor_radius(const DrawList& list, const SceneBounds& bounds) {
  const double away = list.background.kind == Background::Kind::landscape ? 9 : 2.2;
  return away * std::max(viewing_distance(list.camera), bounds.all.radius);
}

Matrix4d make_clip_from_world(const Camera& camera, double aspect, const SceneBounds& bounds,
                              double floor_radius) {
  const double distance = viewing_distance(camera);
  const double to_scene = (camera.eye - bounds.all.center).norm();
  const double near = std::max(0.02 * distance, 0.95 * (to_scene - bounds.all.radius));
  const double far = std::max(to_scene + bounds.all.radius, distance + 1.5 * floor_radius);
  // The floor may be nearer to the eye than the scene.
  const double safe_near = std::min(near, 0.1 * distance);
  return perspective(camera.field_of_view, aspect, safe_near, far) *
         look_from(camera.eye, camera.target - camera.eye, camera.up);
}

int rows_all_floor(const Matrix4d& clip_from_world, const FloorSquare& floor, int picture_height) {
  const Matrix4d world_from_clip = clip_from_world.inverse();
  const auto is_floor = [&](double x, double y) {  // whether the line of sight meets it
    const Vector3 near = (world_from_clip * Eigen::Vector4d(x, y, -1, 1)).hnormalized();
    const Vector3 far = (world_from_clip * Eigen::Vector4d(x, y, 1, 1)).hnormalized();
    const double share = (floor.height - near.z()) / (far.z() - near.z());
    const Vector3 off = near + share * (far - near) - floor.center;
    return share > 0 && share < 1 && off.head<2>().cwiseAbs().maxCoeff() < 0.99 * floor.half_side;
  };
  // The square is convex: the ends of a row suffice.
  const auto row_is_floor = [&](int row) {
    const double y = 2.0 * row / picture_height - 1;
    return is_floor(-1, y) && is_floor(1, y);
  };
  int row = 0;
  while (row <= picture_height + 1 && row_is_floor(row)) ++row;
  return std::max(0, row - 2);  // a margin of one row for subpixel offsets
}

Matrix4d make_light_clip_from_world(const Vector3& towards_light_W, const Ball& ball) {
  const double radius = 1.01 * ball.radius;
  Matrix4d scale = Matrix4d::Identity();
  scale(0, 0) = scale(1, 1) = 1 / radius;
  scale(2, 2) = -1 / radius;  // near: towards the light
  return scale * look_from(ball.center, -towards_light_W, Vector3::UnitZ());
}

double shadow_texels(const Camera& camera, const SceneBounds& bounds, int picture_height) {
  const double pixel =
      2 * viewing_distance(camera) * std::tan(0.5 * camera.field_of_view) / picture_height;
  return 2 * bounds.solid.radius / pixel;
}

std::optional<Eigen::Vector2d> project(const Matrix4d& clip_from_world, const Vector3& p_W,
                                       int width, int height) {
  const Eigen::Vector4d clip = clip_from_world * p_W.homogeneous();
  if (!clip.allFinite() || clip.w() <= 0) return std::nullopt;
  return Eigen::Vector2d(0.5 * (1 + clip.x() / clip.w()) * width,
                         0.5 * (1 - clip.y() / clip.w()) * height);
}

}  // namespace twinarm
