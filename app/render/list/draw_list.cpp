#include "app/render/list/draw_list.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "solver/spatial/rotation_to_axis.h"

namespace twinarm {
namespace {

// Frame with its origin at `from` and its z axis towards `to`.
Pose pose_along(const Vector3& from_W, const Vector3& to_W) {
  const Vector3 along = to_W - from_W;
  return {rotation_taking_z_to(along), from_W};
}

// False for zero, NaN and infinity.
bool has_length(const Vector3& from_W, const Vector3& to_W) {
  const double length = (to_W - from_W).norm();
  return length > 0 && std::isfinite(length);
}

}  // namespace

Background sky_background() {
  return {.kind = Background::Kind::landscape,
          .bottom = {0.86f, 0.89f, 0.92f, 1.0f},
          .top = {0.33f, 0.50f, 0.75f, 1.0f},
          .ground = {0.70f, 0.70f, 0.68f, 1.0f}};
}

Background white_background() {
  Background white;
  white.bottom = white.top = {1.0f, 1.0f, 1.0f, 1.0f};
  return white;
}

MeshId DrawList::register_mesh(DrawMesh mesh) {
  meshes.push_back(std::make_shared<const DrawMesh>(std::move(mesh)));
  return meshes.size() - 1;
}

TextureId DrawList::register_texture(std::shared_ptr<const Image> texture) {
  textures.push_back(std::move(texture));
  return textures.size() - 1;
}

MeshId DrawList::unit_mesh(UnitShape shape) {
  const auto found = units_.find(shape);
  if (found != units_.end()) return found->second;
  return units_[shape] = register_mesh(make_unit_mesh(shape));
}

MeshId DrawList::unit_spring(double aspect) {
  // Steps of sqrt(2): the wire's section is round within 20 %.
  const int step = static_cast<int>(std::lround(2 * std::log2(std::clamp(aspect, 0.5, 512.0))));
  const auto found = springs_.find(step);
  if (found != springs_.end()) return found->second;
  return springs_[step] = register_mesh(make_unit_spring(std::exp2(0.5 * step)));
}

void DrawList::clear_frame() {
  instances.clear();
  labels.clear();
  bars.clear();
  title.clear();
  legend.clear();
}

void add_mesh_instance(DrawList& list, MeshId mesh, const Pose& X_WM, const Color& color,
                       const Vector3& scale, float shininess) {
  assert(mesh < list.meshes.size());
  if (!X_WM.R.allFinite() || !X_WM.p.allFinite() || !scale.allFinite()) return;
  if (!(scale.minCoeff() > 0)) return;
  list.instances.push_back({mesh, X_WM, scale, color, shininess, false, std::nullopt, -1});
}

void add_box(DrawList& list, const Pose& X_WM, const Vector3& size, const Color& color) {
  add_mesh_instance(list, list.unit_mesh(UnitShape::box), X_WM, color, size);
}

void add_sphere(DrawList& list, const Vector3& p_W, double radius, const Color& color) {
  add_mesh_instance(list, list.unit_mesh(UnitShape::sphere), {Matrix3::Identity(), p_W}, color,
                    Vector3::Constant(radius));
}

void add_rod(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
             const Color& color) {
  if (!has_length(from_W, to_W)) return;
  add_mesh_instance(list, list.unit_mesh(UnitShape::cylinder), pose_along(from_W, to_W), color,
                    Vector3(radius, radius, (to_W - from_W).norm()));
}

void add_spring(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
                const Color& color) {
  if (!has_length(from_W, to_W)) return;
  const double length = (to_W - from_W).norm();
  add_mesh_instance(list, list.unit_spring(length / radius), pose_along(from_W, to_W), color,
                    Vector3(radius, radius, length), 0.8f);
}

void add_arrow(DrawList& list, const Vector3& from_W, const Vector3& to_W, double radius,
               const Color& color) {
  if (!has_length(from_W, to_W)) return;
  const double length = (to_W - from_W).norm();
  const double head = std::min(6.5 * radius, 0.6 * length);  // a short arrow is mostly head
  const Vector3 neck_W = to_W - (to_W - from_W) * (head / length);
  add_rod(list, from_W, neck_W, radius, color);
  add_mesh_instance(list, list.unit_mesh(UnitShape::cone), pose_along(neck_W, to_W), color,
                    Vector3(2.4 * radius, 2.4 * radius, head));
}

void add_label(DrawList& list, const Vector3& p_W, const std::string& text,
               const Eigen::Vector2d& offset_px, double size_px) {
  list.labels.push_back({.text = text, .p_W = p_W, .offset_px = offset_px, .size_px = size_px});
}

}  // namespace twinarm
