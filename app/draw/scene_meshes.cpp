#include "app/draw/scene_meshes.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/draw/palette.h"
#include "app/scene/read/read_scene.h"

namespace twinarm {
namespace {

// From the robot's file, else the mesh's colours and textures, else a colour of the palette.
Color color_of(const VisualPart& visual, ShapeLook& look, std::size_t body) {
  const bool has_default = visual.material.empty() && visual.texture.empty() &&
                           visual.color.isApprox(VisualPart().color);
  if (has_default)
    return look.color.value_or(look.texture ? Color{1, 1, 1, 1} : palette::body(body));
  look.texture.reset();
  const Eigen::Vector4f c = visual.color.cast<float>();
  return {c(0), c(1), c(2), c(3)};
}

class SceneMeshesBuilder {
 public:
  SceneMeshesBuilder(SceneMeshes& meshes, DrawList& list) : meshes_(meshes), list_(list) {}

  void add(std::size_t body, int robot, const ShapeLook& look, const Pose& X_LG, Color color) {
    if (look.is_hollow) color.a = palette::kHollow;
    ScenePart part{.body = body,
                   .robot = robot,
                   .mesh = look.mesh,
                   .X_LM = X_LG * look.X_GM,
                   .scale = look.scale,
                   .color = color,
                   .texture = look.texture};
    const Eigen::AlignedBox3d box = bounding_box(*list_.meshes[look.mesh]);
    if (!box.isEmpty())
      part.box_M = {box.min().cwiseProduct(look.scale), box.max().cwiseProduct(look.scale)};
    meshes_.parts.push_back(part);
  }

  // Applies a texture file; a note if it cannot be used.
  void apply_texture(const std::filesystem::path& file, const std::string& whose, ShapeLook& look) {
    if (file.empty()) return;
    if (look.can_be_textured) {
      if (const auto texture = texture_in(file)) look.texture = texture;
      return;
    }
    meshes_.notes.push_back(
        fmt::format("{}: texture '{}' ignored: its shape has no texture coordinates", whose,
                    file.filename().string()));
  }

  // The visuals; if one cannot be read, all collision shapes instead.
  void add_link(const LinkDescription& link, std::size_t body, int robot) {
    std::vector<std::vector<ShapeLook>> looks;  // by visual
    try {
      for (const VisualPart& visual : link.visuals)
        looks.push_back(
            looks_of(visual.geometry, list_,
                     visual.texture.empty() ? KeepPlaces::where_textured : KeepPlaces::always,
                     meshes_.notes));
    } catch (const InputError& error) {
      const Diagnostic& fault = error.faults().front();
      meshes_.notes.push_back(fmt::format("link '{}' is drawn by its collision shapes: {}: {}",
                                          link.name, fault.file, fault.problem));
      looks.clear();
      add_collisions(link, body, robot);
      return;
    }
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (ShapeLook& look : looks[i]) {
        const Color color = color_of(link.visuals[i], look, body);
        apply_texture(link.visuals[i].texture, "link '" + link.name + "'", look);
        add(body, robot, look, link.visuals[i].X_LG(), color);
      }
    if (!link.visuals.empty() || link.collisions.empty()) return;
    meshes_.notes.push_back(
        fmt::format("link '{}' without visual is drawn by its collision shapes", link.name));
    add_collisions(link, body, robot);
  }

 private:
  void add_collisions(const LinkDescription& link, std::size_t body, int robot) {
    for (const CollisionPart& part : link.collisions) try {
        for (const ShapeLook& look :
             looks_of(part.geometry, list_, KeepPlaces::where_textured, meshes_.notes))
          add(body, robot, look, part.X_LG(), palette::body(body));
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        meshes_.notes.push_back(fmt::format("link '{}': collision shape omitted: {}: {}", link.name,
                                            fault.file, fault.problem));
      }
  }

  std::optional<TextureId> texture_in(const std::filesystem::path& file) {
    const auto [place, is_new] = textures_.try_emplace(file);
    if (is_new) try {
        place->second = list_.register_texture(std::make_shared<const Image>(read_image(file)));
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        meshes_.notes.push_back(
            fmt::format("texture '{}' ignored: {}", file.string(), fault.problem));
      }
    return place->second;
  }

  SceneMeshes& meshes_;
  DrawList& list_;
  std::map<std::filesystem::path, std::optional<TextureId>> textures_;
};

void add_body(const SceneGeometry& geometry, const BodyDescription& body, std::size_t& free_bodies,
              SceneMeshesBuilder& builder, SceneMeshes& meshes, DrawList& list) {
  const auto index = static_cast<std::size_t>(geometry.body);
  Color color = body.fixed ? palette::kObstacle : palette::kDriven;
  if (body.is_free()) color = palette::body(free_bodies++);
  if (!body.texture.empty()) color = {1, 1, 1, 1};
  if (body.color) {
    const Eigen::Vector3f c = body.color->cast<float>();
    color = {c(0), c(1), c(2), 1};
  }
  if (std::optional<ShapeLook> look = look_of(geometry.shape, list)) {
    builder.apply_texture(body.texture, "body '" + body.name + "'", *look);
    return builder.add(index, -1, *look, geometry.X_LG, color);
  }
  const auto& half = std::get<HalfSpace>(geometry.shape);
  const Vector3 normal = geometry.X_LG.R * half.normal;
  meshes.planes.push_back({index, normal, half.offset + normal.dot(geometry.X_LG.p), color});
}

// Many spheres are small in the picture; with all their facets 300 of them take a software renderer
// a second for each picture.
void coarsen_many_spheres(std::vector<ScenePart>& parts, DrawList& list) {
  constexpr std::ptrdiff_t kMany = 64;
  const MeshId sphere = list.unit_mesh(UnitShape::sphere);
  if (std::ranges::count(parts, sphere, &ScenePart::mesh) < kMany) return;
  const MeshId coarse = list.unit_mesh(UnitShape::coarse_sphere);
  for (ScenePart& part : parts)
    if (part.mesh == sphere) part.mesh = coarse;
}

}  // namespace

SceneMeshes make_scene_meshes(const SceneModel& scene, DrawList& list) {
  SceneMeshes meshes;
  SceneMeshesBuilder builder(meshes, list);
  const SceneDescription& description = scene.description;
  for (std::size_t r = 0; r < description.robots.size(); ++r)
    for (const LinkDescription& link : description.robots[r].description.links) {
      const int body = scene.model.find_body(name_in_scene(description, r, link.name));
      if (body >= 0) builder.add_link(link, static_cast<std::size_t>(body), static_cast<int>(r));
    }
  // Geometries of bodies come last, in the order of the bodies.
  const std::size_t first = scene.geometries.size() - description.bodies.size();
  std::size_t free_bodies = 0;
  for (std::size_t b = 0; b < description.bodies.size(); ++b)
    add_body(scene.geometries[first + b], description.bodies[b], free_bodies, builder, meshes,
             list);
  coarsen_many_spheres(meshes.parts, list);
  for (const SceneConstraint& c : scene.constraints)
    if (c.type == SceneConstraint::Type::distance)
      meshes.ties.push_back(
          {static_cast<std::size_t>(c.a), static_cast<std::size_t>(c.b), c.X_AC.p, c.X_BC.p});
  for (const PointSpring& s : scene.springs)
    meshes.ties.push_back({static_cast<std::size_t>(s.a.body), static_cast<std::size_t>(s.b.body),
                           s.a.p_L, s.b.p_L, true});
  return meshes;
}

SceneMeshes make_scene_meshes(const RobotDescription& robot, const Model<double>& model,
                              DrawList& list) {
  SceneMeshes meshes;
  SceneMeshesBuilder builder(meshes, list);
  for (const LinkDescription& link : robot.links) {
    const int body = model.find_body(link.name);
    if (body >= 0) builder.add_link(link, static_cast<std::size_t>(body), 0);
  }
  return meshes;
}

}  // namespace twinarm
