// Shapes by name: those of collision/shapes/shape.h, and meshes.
#include "app/scene/read/scene_reader.h"
#include "app/support/nearest_name.h"

namespace twinarm {
namespace {

// All of them are > 0.
void read_length(TableReader& table, const char* key, double& length) {
  table.missing(key, std::string("give ") + key + " = ... in metres");
  length = table.positive(key).value_or(1);
}

void read_length(TableReader& table, const char* key, Vector3& lengths) {
  table.missing(key, std::string("give ") + key + " = [x, y, z] in metres");
  const auto found = table.vector(key);
  if (found && !(found->minCoeff() > 0))
    table.fault(key, "all three must be positive", "give lengths above 0", "scene.not-positive");
  lengths = found.value_or(Vector3::Ones());
}

template <class S>
void read_numbers(TableReader& table, S& shape) {
  for_each_length(shape, [&](const char* key, auto& value) { read_length(table, key, value); });
}
void read_numbers(TableReader& table, HalfSpace& half) {
  half.normal = table.unit_vector("normal").value_or(half.normal);
  half.offset = table.number("offset").value_or(0);
}

ShapeDescription read_mesh(SceneReader& reader, TableReader& table) {
  MeshGeometry mesh;
  table.missing("file", "give file = \"...\"");
  mesh.name = table.text("file").value_or("");
  if (!mesh.name.empty()) mesh.file = reader.find_file(table, "file", mesh.name).value_or("");
  const Value* scale = table.find("scale");
  if (scale && scale->kind == Value::Kind::number)
    mesh.scale = Vector3::Constant(table.positive("scale").value_or(1));
  else if (scale)
    mesh.scale = table.vector("scale").value_or(Vector3::Ones());
  if ((mesh.scale.array() == 0).any())
    table.fault("scale", "must not be 0", "give metres per unit of the file", "scene.zero");
  mesh.convex = table.flag("convex").value_or(true);
  return mesh;
}

std::vector<std::string> names_of_shapes() {
  std::vector<std::string> names;
  for_each_shape([&](const auto& shape) { names.emplace_back(shape.key); });
  names.emplace_back("mesh");
  return names;
}

ShapeDescription read_named(const std::string& name, SceneReader& reader, TableReader& table) {
  ShapeDescription found;
  if (name == "mesh") found = read_mesh(reader, table);
  for_each_shape([&](auto shape) {
    if (name != shape.key) return;
    read_numbers(table, shape);
    found = shape;
  });
  return found;
}

}  // namespace

std::optional<ShapeDescription> SceneReader::read_shape(TableReader& body) {
  body.missing("shape", "give shape = { box = { size = [1, 1, 1] } }, or another");
  const Value* shape = body.table("shape");
  if (!shape) return std::nullopt;
  const std::vector<std::string> names = names_of_shapes();
  if (shape->members.empty())
    body.fault("shape", "names no shape", name_remedy("", names, "shapes"), "scene.shapes");
  if (shape->members.size() > 1) {
    std::string given;
    for (const Value& member : shape->members) given += (given.empty() ? "" : " and ") + member.key;
    body.fault("shape", "names " + given, "give one shape; a second one needs a second body",
               "scene.shapes");
  }
  std::optional<ShapeDescription> found;
  for (const Value& member : shape->members) {
    const std::string where = body.where() + ", shape";
    if (std::find(names.begin(), names.end(), member.key) == names.end()) {
      open(*shape, where)
          .fault(member.key, "there is no such shape", name_remedy(member.key, names, "shapes"),
                 "scene.unknown-key");
    } else if (member.kind != Value::Kind::table) {
      open(*shape, where)
          .fault(member.key, "must be a table, is " + describe(member), "", "scene.type");
    } else {
      TableReader table = open(member, where + ", " + member.key);
      found = read_named(member.key, *this, table);
      table.done();
    }
  }
  return found;
}

}  // namespace twinarm
