#include "app/draw/scene_meshes.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "app/draw/palette.h"
#include "app/draw/shape_mesh.h"
#include "app/scene/read/read_scene.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// What the robot's file says rules, then the mesh's own colours and textures; a link without any
// has a colour of ours, so that neighbours are told apart.
Color color_of(const VisualPart& visual, ShapeLook& look, std::size_t body) {
  const bool says_nothing = visual.material.empty() && visual.texture.empty() &&
                            visual.color.isApprox(VisualPart().color);
  if (says_nothing)
    return look.color.value_or(look.texture ? Color{1, 1, 1, 1} : palette::body(body));
  look.texture.reset();
  const Eigen::Vector4f c = visual.color.cast<float>();
  return {c(0), c(1), c(2), c(3)};
}

class CastMaker {
 public:
  CastMaker(SceneMeshes& cast, DrawList& list) : cast_(cast), list_(list) {}

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
    if (!box.isEmpty()) {
      part.low_M = box.min().cwiseProduct(look.scale);
      part.high_M = box.max().cwiseProduct(look.scale);
    }
    cast_.parts.push_back(part);
  }

  // The picture in a file, if there is one; why it is left out is noted.
  void lay_on(const std::filesystem::path& file, const std::string& whose, ShapeLook& look) {
    if (file.empty()) return;
    if (look.can_be_textured) {
      if (const auto texture = texture_in(file)) look.texture = texture;
      return;
    }
    cast_.notes.push_back(
        fmt::format("{}: the texture '{}' is left out: its shape does not say "
                    "where a picture lies on it",
                    whose, file.filename().string()));
  }

  // Visuals; in place of what cannot be drawn of them, all collision shapes.
  void add_link(const LinkDescription& link, std::size_t body, int robot) {
    std::vector<std::vector<ShapeLook>> looks;  // by visual
    try {
      for (const VisualPart& visual : link.visuals)
        looks.push_back(looks_of(
            visual.geometry, list_,
            visual.texture.empty() ? KeepPlaces::where_textured : KeepPlaces::always, cast_.notes));
    } catch (const InputError& error) {
      const Diagnostic& fault = error.faults().front();
      cast_.notes.push_back(fmt::format("link '{}' is drawn by its collision shapes: {}: {}",
                                        link.name, fault.file, fault.problem));
      looks.clear();
      add_collisions(link, body, robot);
      return;
    }
    for (std::size_t i = 0; i < looks.size(); ++i)
      for (ShapeLook& look : looks[i]) {
        const Color color = color_of(link.visuals[i], look, body);
        lay_on(link.visuals[i].texture, "link '" + link.name + "'", look);
        add(body, robot, look, link.visuals[i].X_LG(), color);
      }
    if (!link.visuals.empty() || link.collisions.empty()) return;
    cast_.notes.push_back(
        fmt::format("link '{}' has no visual: it is drawn by its collision shapes", link.name));
    add_collisions(link, body, robot);
  }

 private:
  void add_collisions(const LinkDescription& link, std::size_t body, int robot) {
    for (const CollisionPart& part : link.collisions) try {
        for (const ShapeLook& look :
             looks_of(part.geometry, list_, KeepPlaces::where_textured, cast_.notes))
          add(body, robot, look, part.X_LG(), palette::body(body));
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        cast_.notes.push_back(fmt::format("of link '{}' a collision shape is missing: {}: {}",
                                          link.name, fault.file, fault.problem));
      }
  }

  std::optional<TextureId> texture_in(const std::filesystem::path& file) {
    const auto [place, is_new] = textures_.try_emplace(file);
    if (is_new) try {
        place->second = list_.register_texture(std::make_shared<const Image>(read_image(file)));
      } catch (const InputError& error) {
        const Diagnostic& fault = error.faults().front();
        cast_.notes.push_back(
            fmt::format("the texture '{}' is left out: {}", file.string(), fault.problem));
      }
    return place->second;
  }

  SceneMeshes& cast_;
  DrawList& list_;
  std::map<std::filesystem::path, std::optional<TextureId>> textures_;
};

void add_body(const SceneGeometry& geometry, const BodyDescription& body, std::size_t& free_bodies,
              CastMaker& maker, SceneMeshes& cast, DrawList& list) {
  const auto index = static_cast<std::size_t>(geometry.body);
  Color color = body.fixed ? palette::kObstacle : palette::kDriven;
  if (body.is_free()) color = palette::body(free_bodies++);
  if (!body.texture.empty()) color = {1, 1, 1, 1};
  if (body.color) {
    const Eigen::Vector3f c = body.color->cast<float>();
    color = {c(0), c(1), c(2), 1};
  }
  if (std::optional<ShapeLook> look = look_of(geometry.shape, list)) {
    maker.lay_on(body.texture, "body '" + body.name + "'", *look);
    return maker.add(index, -1, *look, geometry.X_LG, color);
  }
  const auto& half = std::get<HalfSpace>(geometry.shape);
  const Vector3 normal = geometry.X_LG.R * half.normal;
  cast.planes.push_back({index, normal, half.offset + normal.dot(geometry.X_LG.p), color});
}

}  // namespace

SceneMeshes cast_of(const SceneModel& scene, DrawList& list) {
  SceneMeshes cast;
  CastMaker maker(cast, list);
  const SceneDescription& description = scene.description;
  for (std::size_t r = 0; r < description.robots.size(); ++r)
    for (const LinkDescription& link : description.robots[r].description.links) {
      const int body = scene.model.find_body(name_in_scene(description, r, link.name));
      if (body >= 0) maker.add_link(link, static_cast<std::size_t>(body), static_cast<int>(r));
    }
  // The geometries of bodies are the last ones, in their order.
  const std::size_t first = scene.geometries.size() - description.bodies.size();
  std::size_t free_bodies = 0;
  for (std::size_t b = 0; b < description.bodies.size(); ++b)
    add_body(scene.geometries[first + b], description.bodies[b], free_bodies, maker, cast, list);
  for (const SceneConstraint& c : scene.constraints)
    if (c.type == SceneConstraint::Type::distance)
      cast.ties.push_back(
          {static_cast<std::size_t>(c.a), static_cast<std::size_t>(c.b), c.X_AC.p, c.X_BC.p});
  return cast;
}

SceneMeshes cast_of(const RobotDescription& robot, const Model<double>& model, DrawList& list) {
  SceneMeshes cast;
  CastMaker maker(cast, list);
  for (const LinkDescription& link : robot.links) {
    const int body = model.find_body(link.name);
    if (body >= 0) maker.add_link(link, static_cast<std::size_t>(body), 0);
  }
  return cast;
}

}  // namespace twinarm
