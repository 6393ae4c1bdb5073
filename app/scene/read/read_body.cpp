// Bodies with their shapes: primitives (collision/shapes/shape.h) and meshes.

#include "app/scene/read/scene_reader.h"
#include "app/support/text.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

// A shape without volume has no inertia; nullptr if it can be a free body.
const char* why_not_free(const ShapeDescription& shape) {
  if (std::holds_alternative<HalfSpace>(shape)) return "a half-space is unbounded";
  if (std::holds_alternative<SphericalCavity>(shape) ||
      std::holds_alternative<CylindricalCavity>(shape))
    return "a hollow shape is unbounded outside";
  const auto* mesh = std::get_if<MeshGeometry>(&shape);
  return mesh && !mesh->convex ? "contacts of a moving mesh need convex = true" : nullptr;
}

std::optional<Matrix3> read_inertia(TableReader& table, SceneDescription& scene) {
  const auto given = table.numbers("inertia", 6);
  if (!given) return std::nullopt;
  const double xx = (*given)[0], yy = (*given)[1], zz = (*given)[2];
  const double xy = (*given)[3], xz = (*given)[4], yz = (*given)[5];
  const Matrix3 I = (Matrix3() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
  const Vector3 principal = symmetric_eigenvalues(I);  // ascending
  if (!(principal[0] > 0))
    table.fault("inertia",
                "the principal moments must be positive, the smallest is " +
                    short_number_text(principal[0]),
                "give [xx, yy, zz, xy, xz, yz] in kg m^2, about the centre of mass",
                "scene.inertia");
  else if (principal[0] + principal[1] < principal[2] * (1 - 1e-9))
    scene.warnings.push_back(scene.file.string() + ": " + table.where() +
                             ", inertia: physically inconsistent: the largest principal moment "
                             "exceeds the sum of the others");
  return I;
}

void read_mass(TableReader& table, BodyDescription& body, SceneDescription& scene) {
  body.mass = table.positive("mass");
  body.density = table.positive("density");
  body.com = table.vector("com");
  body.inertia = read_inertia(table, scene);
  if (table.has("com") && !table.has("inertia"))
    table.fault("com", "is valid only together with 'inertia'",
                "give inertia = [xx, yy, zz, xy, xz, yz] about this point", "scene.key-alone");
  if (table.has("mass") && table.has("density"))
    table.fault("density", "conflicts with 'mass'", "leave one of them out", "scene.two-keys");
  if (body.is_free() && !table.has("mass") && !table.has("density"))
    table.fault("", "a free body needs a mass", "give mass or density, or fixed = true, or motion",
                "scene.missing");
}

void read_how_it_moves(SceneReader& reader, TableReader& table, BodyDescription& body) {
  body.fixed = table.flag("fixed").value_or(false);
  body.motion = reader.read_motion(table);
  if (body.motion && body.fixed)
    table.fault("motion", "conflicts with 'fixed'", "leave one of them out", "scene.two-keys");
  reader.read_velocities(
      table, body, body.is_free(),
      {"applies to a free body only", "leave it out, or give motion = { linear, angular }"});
}

// Colour and texture.
void read_appearance(SceneReader& reader, TableReader& table, BodyDescription& body) {
  body.color = table.vector("color");
  if (body.color && !(body.color->minCoeff() >= 0 && body.color->maxCoeff() <= 1))
    table.fault("color", "red, green and blue must be from 0 to 1", "", "scene.range");
  if (const auto name = table.text("texture"))
    body.texture = reader.find_file(table, "texture", *name).value_or("");
  if (!body.texture.empty() && std::holds_alternative<HalfSpace>(body.shape))
    table.fault("texture", "a half-space has no texture", "leave it out", "scene.key-useless");
}

// Places of a body and its copies, relative to its own: copies = { count, spacing, scatter }, a
// grid whose places are shifted by up to `scatter` in each direction, by numbers that only depend
// on the place's index.
std::vector<Vector3> read_copies(SceneReader& reader, TableReader& table) {
  constexpr double kMaxBodies = 10000;  // of a scene, as soon as it has copies
  const Value* given = table.table("copies");
  if (!given) return {Vector3::Zero()};
  TableReader grid = reader.open(*given, table.where() + ", copies");
  grid.missing("count", "give count = [x, y, z], the numbers of copies");
  grid.missing("spacing", "give spacing = [x, y, z] in metres");
  const Vector3 count = grid.vector("count").value_or(Vector3::Ones());
  const Vector3 spacing = grid.vector("spacing").value_or(Vector3::Zero());
  const double scatter = grid.number("scatter").value_or(0);
  grid.done();
  if (!(count.minCoeff() >= 1 &&
        static_cast<double>(reader.scene.bodies.size()) + count.prod() <= kMaxBodies) ||
      count != count.array().floor().matrix()) {
    grid.fault("count", "must be whole numbers from 1, with at most 10000 bodies in the scene", "",
               "scene.range");
    return {Vector3::Zero()};
  }
  std::uint64_t random = 1;
  const auto shift = [&] {  // linear congruential generator of Knuth's MMIX
    random = random * 6364136223846793005U + 1442695040888963407U;
    return scatter * (2 * static_cast<double>(random >> 11) * 0x1p-53 - 1);
  };
  std::vector<Vector3> places;
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x)
        places.push_back(spacing.cwiseProduct(Vector3(x, y, z)) +
                         Vector3{shift(), shift(), shift()});
  return places;
}

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

std::optional<BodyMotion> SceneReader::read_motion(TableReader& table) {
  const Value* given = table.table("motion");
  if (!given) return std::nullopt;
  TableReader law = open(*given, table.where() + ", motion");
  const auto vector = [&](const char* key) { return law.vector(key).value_or(Vector3::Zero()); };
  BodyMotion motion{vector("linear"), vector("angular"), vector("amplitude"), vector("swing"),
                    law.positive("frequency").value_or(0)};
  const bool oscillates = law.has("amplitude") || law.has("swing");
  if (oscillates != law.has("frequency"))
    law.fault("frequency", oscillates ? "is missing" : "there is nothing that it applies to",
              oscillates ? "give it in Hz" : "give amplitude [m] or swing [rad]",
              "scene.key-alone");
  if (law.has("angular") && law.has("swing"))
    law.fault("swing", "conflicts with 'angular'", "leave one of them out", "scene.two-keys");
  law.done();
  return motion;
}

void SceneReader::read_body(const Value& value) {
  TableReader table = open(value, "body");
  BodyDescription body;
  body.line = table.line();
  body.name = read_name(table, "body");
  read_how_it_moves(*this, table, body);
  if (const auto shape = read_shape(table)) {
    body.shape = *shape;
    if (const char* why = why_not_free(*shape); why && body.is_free())
      table.fault("shape", std::string(why) + ": it cannot be a free body",
                  "give fixed = true or motion = { ... }", "scene.no-inside");
  }
  read_mass(table, body, scene);
  body.X_WB = read_pose(table);
  body.surface = read_surface(table);
  read_appearance(*this, table, body);
  if (const auto group = table.number("group")) {
    body.group = static_cast<int>(*group);
    if (!(*group >= 0 && *group <= 31 && *group == body.group))
      table.fault("group", "must be a whole number from 0 to 31, is " + number_text(*group), "",
                  "scene.range");
  }
  const std::vector<Vector3> places = read_copies(*this, table);
  table.done();
  const BodyDescription first = body;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places.size() > 1) body.name = first.name + std::to_string(i + 1);
    if (places.size() > 1 && !taken_names.emplace("body", body.name).second)
      table.fault("copies", "the name '" + body.name + "' is already used",
                  "rename one of the bodies", "scene.name-taken");
    body.X_WB.p = first.X_WB.p + places[i];
    scene.bodies.push_back(body);
  }
}

std::optional<ShapeDescription> SceneReader::read_shape(TableReader& body) {
  body.missing("shape", "give shape = { box = { size = [1, 1, 1] } }, or another");
  const Value* shape = body.table("shape");
  if (!shape) return std::nullopt;
  const std::vector<std::string> names = names_of_shapes();
  if (shape->members.empty())
    body.fault("shape", "is empty", name_remedy("", names, "shapes"), "scene.shapes");
  if (shape->members.size() > 1) {
    std::string given;
    for (const Value& member : shape->members) given += (given.empty() ? "" : " and ") + member.key;
    body.fault("shape", "has " + given, "give one shape; a second one needs a second body",
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
