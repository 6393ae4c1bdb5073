// The shapes of a URDF link.
#include "collision/import/urdf/urdf_parts.h"

#include <optional>
#include <utility>

#include "collision/import/robot/file_search.h"

namespace twinarm {

namespace {

MeshGeometry read_mesh(const XmlElement& element, const std::string& where, UrdfSource& source) {
  MeshGeometry mesh;
  mesh.name = source.text(element, "filename", where);
  mesh.scale =
      source.vector3(element, "scale", where, Vector3(Vector3::Ones())).value_or(Vector3::Ones());
  if (mesh.scale.cwiseAbs().minCoeff() == 0)
    source.fault(element.line, where,
                 std::string("mesh scale is '") + element.value("scale") + "', must not be 0",
                 "give three numbers other than 0 (a negative one mirrors)", "urdf.mesh-scale");
  if (mesh.name.empty()) return mesh;
  const FilePlace place =
      find_named_file("mesh", mesh.name, source.folder(), source.options().roots);
  mesh.file = place.file;
  if (place.problem.empty()) return mesh;
  if (source.options().geometry == RobotFileOptions::Geometry::required)
    source.fault(element.line, where, place.problem, place.fix, place.code);
  else
    source.warn_once("mesh", element.line, where, place.problem, place.fix, "file.missing");
  return mesh;
}

void read_length(const XmlElement& shape, const char* name, const std::string& where,
                 UrdfSource& source, double& length) {
  length = source.positive(shape, name, where).value_or(1.0);
}
void read_length(const XmlElement& shape, const char* name, const std::string& where,
                 UrdfSource& source, Vector3& lengths) {
  lengths = source.vector3(shape, name, where).value_or(Vector3::Ones());
  if (!(lengths.minCoeff() > 0))
    source.fault(
        shape.line, where,
        shape.name + " " + name + " is '" + shape.value(name) + "', must be three positive numbers",
        "give the edge lengths in metres", "urdf.number");
}

ShapeDescription read_geometry(const XmlElement& part, const std::string& where,
                               UrdfSource& source) {
  const XmlElement* geometry = part.child("geometry");
  const XmlElement* shape =
      geometry && !geometry->children.empty() ? &geometry->children.front() : nullptr;
  const std::string kind = shape ? shape->name : "";
  if (kind == "mesh") return read_mesh(*shape, where, source);
  std::optional<ShapeDescription> found;
  for_each_shape([&](auto known) {
    if constexpr (requires { known.is_in_urdf; }) {
      if (kind != known.key) return;
      for_each_length(known, [&](const char* name, auto& value) {
        read_length(*shape, name, where, source, value);
      });
      found = known;
    }
  });
  if (found) return *found;
  const XmlElement& at = shape ? *shape : geometry ? *geometry : part;
  source.fault(at.line, where,
               kind.empty() ? "the geometry is missing" : "unknown shape <" + kind + ">",
               "shapes: box, sphere, cylinder, capsule, mesh", "urdf.shape");
  return {};
}

std::string material_name(const XmlElement& material) {
  const char* name = material.value("name");
  return std::string("material '") + (name ? name : "") + "'";
}

// The colour of a <material> element, if it has one. An invalid one is a warning.
std::optional<Vector4> read_color(const XmlElement& material, UrdfSource& source) {
  const UrdfSource::ErrorsAsWarnings as_warnings(source, true);
  const XmlElement* color = material.child("color");
  if (!color) return std::nullopt;
  const auto rgba = source.numbers(*color, "rgba", material_name(material), 4);
  if (!rgba) return Vector4(VisualPart().color);
  const Vector4 given((*rgba)[0], (*rgba)[1], (*rgba)[2], (*rgba)[3]);
  const Vector4 clamped = given.cwiseMax(0.0).cwiseMin(1.0);
  if (clamped != given)
    source.fault(
        color->line, material_name(material),
        std::string("colour '") + color->value("rgba") + "' is outside [0, 1] and is clamped",
        "give red, green, blue and opacity from 0 to 1", "urdf.color");
  return clamped;
}

// The texture of a <material>, if it has one. A missing file is a warning. CAD exporters write
// empty names.
void read_texture(const XmlElement& material, UrdfMaterial& result, UrdfSource& source) {
  const XmlElement* texture = material.child("texture");
  const char* name = texture ? texture->value("filename") : nullptr;
  if (!texture || (name && *name == '\0')) return;
  const std::string where = material_name(material);
  if (!name)
    return source.warn(texture->line, where, "its <texture> has no 'filename'",
                       "give filename=\"...\"", "urdf.no-texture");
  result.texture_name = name;
  const FilePlace place = find_named_file("texture", name, source.folder(), source.options().roots);
  result.texture = place.file;
  if (!place.problem.empty())
    source.warn_once("texture", texture->line, where, place.problem, place.fix, "file.missing");
}

// Colour and texture of a <material> element, if it has any.
std::optional<UrdfMaterial> read_own_material(const XmlElement& material, UrdfSource& source) {
  UrdfMaterial result;
  read_texture(material, result, source);
  const std::optional<Vector4> color = read_color(material, source);
  if (!color && result.texture_name.empty()) return std::nullopt;
  result.color = color.value_or(result.texture.empty() ? result.color : Vector4(1, 1, 1, 1));
  return result;
}

void read_material(const XmlElement& visual, const std::string& where,
                   const UrdfMaterials& materials, VisualPart& part, UrdfSource& source) {
  const XmlElement* material = visual.child("material");
  if (!material) return;
  if (const char* name = material->value("name")) part.material = name;
  UrdfSource silent(source.file(), source.options());  // read_materials has reported its errors
  std::optional<UrdfMaterial> found = read_own_material(*material, silent);
  if (const auto known = materials.find(part.material); !found && known != materials.end())
    found = known->second;
  if (!found)
    return source.warn_once("material " + part.material, material->line, where,
                            "material '" + part.material + "' is not defined in this file",
                            "define it with a <color> in <robot>; the default is grey",
                            "urdf.no-material");
  part.color = found->color;
  part.texture_name = found->texture_name;
  part.texture = found->texture;
}

}  // namespace

UrdfMaterials read_materials(const XmlElement& robot, UrdfSource& source) {
  UrdfMaterials materials;
  const auto take = [&](const XmlElement& element) {
    const auto material = read_own_material(element, source);
    const char* name = element.value("name");
    if (material && name) materials.emplace(name, *material);
  };
  for (const XmlElement* m : robot.all("material")) {
    const UrdfSource::ErrorsAsWarnings as_warnings(source, true);
    const std::string name = source.text(*m, "name", "material");
    if (materials.count(name))
      source.warn(m->line, material_name(*m), "it is defined twice",
                  "remove one definition; the first is used", "urdf.twice");
    take(*m);
  }
  for (const XmlElement* link : robot.all("link"))
    for (const XmlElement* visual : link->all("visual"))
      if (const XmlElement* m = visual->child("material")) take(*m);
  return materials;
}

void read_shapes(const XmlElement& link_element, const UrdfMaterials& materials,
                 LinkDescription& link, UrdfSource& source) {
  const UrdfSource::ErrorsAsWarnings as_warnings(
      source, source.options().geometry == RobotFileOptions::Geometry::optional);
  const auto read = [&](const XmlElement& element, auto& part) {
    if (const char* name = element.value("name")) part.name = name;
    part.line = element.line;
    const std::string where = "link '" + link.name + "', " + element.name +
                              (part.name.empty() ? "" : " '" + part.name + "'");
    for (const char* name : {"geometry", "material"}) source.at_most_one(element, name, where);
    part.origin = source.origin(element, where);
    part.geometry = read_geometry(element, where, source);
    return where;
  };
  for (const XmlElement* e : link_element.all("visual")) {
    VisualPart part;
    const std::size_t before = source.downgraded();
    const std::string where = read(*e, part);
    if (source.downgraded() > before) continue;  // an invalid shape
    read_material(*e, where, materials, part, source);
    link.visuals.push_back(std::move(part));
  }
  for (const XmlElement* e : link_element.all("collision")) {
    CollisionPart part;
    const std::size_t before = source.downgraded();
    read(*e, part);
    if (source.downgraded() == before) link.collisions.push_back(std::move(part));
  }
}

}  // namespace twinarm
