#include "app/draw/scene_meshes.h"

namespace twinarm {
namespace {

DrawMesh capsule(double radius, double length) {
  constexpr int kArc = 12;  // of a quarter circle
  std::vector<Eigen::Vector2d> profile;
  for (const double side : {-0.5, 0.5})
    for (int i = 0; i <= kArc; ++i) {
      const double share = static_cast<double>(i) / kArc;
      const double latitude = 0.5 * std::numbers::pi * (side < 0 ? share - 1 : share);
      const bool on_axis = (side < 0 && i == 0) || (side > 0 && i == kArc);
      profile.emplace_back(on_axis ? 0 : radius * std::cos(latitude),
                           side * length + radius * std::sin(latitude));
    }
  // Triangles without area, at the poles, are dropped where normals are made.
  const TriangleMesh mesh = surface_of_revolution(profile);
  const auto down = [&](const Vector3& p) { return 0.5 - p.z() / (length + 2 * radius); };
  return make_draw_mesh(mesh, places_around_z(mesh, down));
}

TriangleMesh hull_of(const std::vector<Vector3>& points) {
  const ConvexHull hull = convex_hull(points);
  return {hull.vertices, hull.triangles};
}

// Of any convex shape: hull of its support points.
template <class S>
TriangleMesh hull_of(const S& shape) {
  constexpr int kRings = 24;
  std::vector<Vector3> points;
  for (int ring = 0; ring <= kRings; ++ring)
    for (int k = 0; k < 2 * kRings; ++k) {
      const double polar = std::numbers::pi * ring / kRings,
                   azimuth = std::numbers::pi * k / kRings;
      points.push_back(
          shape.support(Vector3(std::sin(polar) * std::cos(azimuth),
                                std::sin(polar) * std::sin(azimuth), std::cos(polar))));
    }
  return hull_of(points);
}

ShapeLook placed(const DrawList& list, MeshId mesh, const Vector3& scale = Vector3::Ones(),
                 const Pose& X_GM = {}) {
  const bool has_uv = !list.meshes[mesh]->uv.empty();
  return {.mesh = mesh, .X_GM = X_GM, .scale = scale, .can_be_textured = has_uv};
}

ShapeLook cylinder(double radius, double length, DrawList& list) {
  return placed(list, list.unit_mesh(UnitShape::cylinder), {radius, radius, length},
                {Matrix3::Identity(), Vector3(0, 0, -0.5 * length)});
}

ShapeLook sphere(const Vector3& semi_axes, DrawList& list) {
  return placed(list, list.unit_mesh(UnitShape::sphere), semi_axes);
}

ShapeLook hollow(ShapeLook look) {
  look.is_hollow = true;
  return look;
}

struct Look {
  DrawList& list;
  using Maybe = std::optional<ShapeLook>;
  Maybe operator()(const Box& box) const {
    return placed(list, list.unit_mesh(UnitShape::box), box.size);
  }
  Maybe operator()(const Sphere& s) const { return sphere(Vector3::Constant(s.radius), list); }
  Maybe operator()(const Ellipsoid& e) const { return sphere(e.semi_axes, list); }
  Maybe operator()(const Cylinder& c) const { return cylinder(c.radius, c.length, list); }
  Maybe operator()(const Capsule& c) const {
    return placed(list, list.register_mesh(capsule(c.radius, c.length)));
  }
  Maybe operator()(const SphericalCavity& s) const {
    return hollow(sphere(Vector3::Constant(s.radius), list));
  }
  Maybe operator()(const CylindricalCavity& c) const {
    return hollow(cylinder(c.radius, c.length, list));
  }
  Maybe operator()(const HalfSpace&) const { return std::nullopt; }
  Maybe operator()(const MeshGeometry& mesh) const {
    return placed(list, list.register_mesh(mesh.convex ? hull_of(load_mesh(mesh).vertices)
                                                       : load_mesh(mesh)));
  }
  template <class S>
  Maybe operator()(const S& shape) const {
    return placed(list, list.register_mesh(hull_of(shape)));
  }
};

std::vector<ShapeLook> parts_of(const MeshGeometry& geometry, DrawList& list, KeepPlaces keep,
                                std::vector<std::string>& notes) {
  VisualModel model = load_visual(file_of(geometry), geometry.scale, keep);
  for (const std::string& note : model.notes)
    notes.push_back("mesh '" + geometry.name + "': " + note);
  std::vector<ShapeLook> looks;
  for (VisualMesh& part : model.parts) {
    looks.push_back(placed(list, list.register_mesh(std::move(part.mesh))));
    looks.back().color = part.color;
    if (part.texture) looks.back().texture = list.register_texture(part.texture);
  }
  return looks;
}

}  // namespace

std::optional<ShapeLook> look_of(const ShapeDescription& shape, DrawList& list) {
  return std::visit(Look{list}, shape);
}

std::vector<ShapeLook> looks_of(const ShapeDescription& geometry, DrawList& list, KeepPlaces keep,
                                std::vector<std::string>& notes) {
  if (const auto* mesh = std::get_if<MeshGeometry>(&geometry))
    return parts_of(*mesh, list, keep, notes);
  return {*look_of(geometry, list)};
}

}  // namespace twinarm
