// Shapes by name. Adding one: a struct in ShapeSpec, a line in the list below, and its conversion
// in scene_shapes.cpp.
#include <array>

#include "app/scene/read/scene_reader.h"
#include "app/support/nearest_name.h"

namespace twinarm {
namespace {

// All of them are > 0.
double length(SceneTable& table, const char* key) {
  table.missing(key, std::string("give ") + key + " = ... in metres");
  return table.positive(key).value_or(1);
}

Vector3 lengths(SceneTable& table, const char* key) {
  table.missing(key, std::string("give ") + key + " = [x, y, z] in metres");
  const auto found = table.vector(key);
  if (found && !(found->minCoeff() > 0))
    table.fault(key, "all three must be positive", "give lengths above 0", "scene.not-positive");
  return found.value_or(Vector3::Ones());
}

template <class T>
ShapeSpec round_and_long(SceneTable& table) {
  return T{length(table, "radius"), length(table, "length")};
}

ShapeSpec read_half_space(SceneReader&, SceneTable& table) {
  HalfSpaceSpec half;
  half.normal = table.unit_vector("normal").value_or(half.normal);
  half.offset = table.number("offset").value_or(0);
  return half;
}

ShapeSpec read_mesh(SceneReader& reader, SceneTable& table) {
  MeshSpec mesh;
  table.missing("file", "give file = \"...\"");
  mesh.mesh.name = table.text("file").value_or("");
  if (!mesh.mesh.name.empty())
    mesh.mesh.file = reader.find_file(table, "file", mesh.mesh.name).value_or("");
  const TomlValue* scale = table.find("scale");
  if (scale && scale->kind == TomlValue::Kind::number)
    mesh.mesh.scale = Vector3::Constant(table.positive("scale").value_or(1));
  else if (scale)
    mesh.mesh.scale = table.vector("scale").value_or(Vector3::Ones());
  if ((mesh.mesh.scale.array() == 0).any())
    table.fault("scale", "must not be 0", "give metres per unit of the file", "scene.zero");
  mesh.convex = table.flag("convex").value_or(true);
  return mesh;
}

struct ShapeByName {
  const char* name;
  ShapeSpec (*read)(SceneReader& reader, SceneTable& table);
};
constexpr std::array kShapes{
    ShapeByName{"halfspace", read_half_space},
    ShapeByName{"box",
                [](SceneReader&, SceneTable& table) -> ShapeSpec {
                  return BoxGeometry{lengths(table, "size")};
                }},
    ShapeByName{"sphere",
                [](SceneReader&, SceneTable& table) -> ShapeSpec {
                  return SphereGeometry{length(table, "radius")};
                }},
    ShapeByName{
        "capsule",
        [](SceneReader&, SceneTable& table) { return round_and_long<CapsuleGeometry>(table); }},
    ShapeByName{
        "cylinder",
        [](SceneReader&, SceneTable& table) { return round_and_long<CylinderGeometry>(table); }},
    ShapeByName{"ellipsoid",
                [](SceneReader&, SceneTable& table) -> ShapeSpec {
                  return EllipsoidSpec{lengths(table, "semi_axes")};
                }},
    ShapeByName{"hollow_sphere",
                [](SceneReader&, SceneTable& table) -> ShapeSpec {
                  return HollowSphereSpec{length(table, "radius")};
                }},
    ShapeByName{
        "hollow_cylinder",
        [](SceneReader&, SceneTable& table) { return round_and_long<HollowCylinderSpec>(table); }},
    ShapeByName{"mesh", read_mesh},
};

}  // namespace

std::optional<ShapeSpec> SceneReader::read_shape(SceneTable& body) {
  body.missing("shape", "give shape = { box = { size = [1, 1, 1] } }, or another");
  const TomlValue* shape = body.table("shape");
  if (!shape) return std::nullopt;
  std::vector<std::string> names;
  for (const ShapeByName& known : kShapes) names.emplace_back(known.name);
  if (shape->members.empty())
    body.fault("shape", "names no shape", name_remedy("", names, "shapes"), "scene.shapes");
  if (shape->members.size() > 1) {
    std::string given;
    for (const TomlValue& member : shape->members)
      given += (given.empty() ? "" : " and ") + member.key;
    body.fault("shape", "names " + given, "give one shape; a second one needs a second body",
               "scene.shapes");
  }
  std::optional<ShapeSpec> found;
  for (const TomlValue& member : shape->members) {
    const std::string where = body.where() + ", shape";
    const auto known = std::find(names.begin(), names.end(), member.key);
    if (known == names.end()) {
      open(*shape, where)
          .fault(member.key, "there is no such shape", name_remedy(member.key, names, "shapes"),
                 "scene.unknown-key");
    } else if (member.kind != TomlValue::Kind::table) {
      open(*shape, where)
          .fault(member.key, "must be a table, is " + describe(member), "", "scene.type");
    } else {
      SceneTable table = open(member, where + ", " + member.key);
      found = kShapes[static_cast<std::size_t>(known - names.begin())].read(*this, table);
      table.done();
    }
  }
  return found;
}

}  // namespace twinarm
