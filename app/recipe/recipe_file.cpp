// Reads the TOML file of a recipe; its keys: app/recipe/README.md.
#include "app/recipe/robot_recipe.h"

#include "app/data/table_reader.h"
#include "collision/import/robot/robot_check.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

// Every table may have a note.
class RecipeTable : public TableReader {
 public:
  RecipeTable(const Value& table, std::string where, const std::string& file,
              DiagnosticList& faults)
      : TableReader(table, std::move(where), file, faults), faults_(faults) {
    find("note");
  }
  RecipeTable part(const Value& table, std::string where) const {
    return {table, std::move(where), file(), faults_};
  }

  std::string required_text(const std::string& key) {
    missing(key, "give " + key + " = \"...\"");
    return text(key).value_or("");
  }
  std::vector<std::string> names(const std::string& key) {
    std::vector<std::string> found;
    const Value* list = find(key);
    if (list)
      for (const Value& item : list->items)
        if (item.is_text()) found.push_back(item.text);
    if (found.empty() || found.size() != list->items.size())
      fault(key, "must be a list of names", "give " + key + " = [\"...\"]", "recipe.value");
    return found;
  }
  int line_of(const std::string& key) {
    const Value* given = find(key);
    return given ? given->line : 0;
  }

 private:
  DiagnosticList& faults_;
};

RecipeMaterial read_material(RecipeTable table) {
  RecipeMaterial material;
  table.missing("density", "give kg/m^3");
  material.density = table.positive("density").value_or(1);
  constexpr const char* kColor = "give red, green, blue and opacity from 0 to 1";
  table.missing("color", kColor);
  if (const auto color = table.numbers("color", 4)) {
    if (std::ranges::any_of(*color, [](double c) { return c < 0 || c > 1; }))
      table.fault("color", "lies outside [0, 1]", kColor, "recipe.value");
    material.color = Vector4(color->data());
  }
  table.done();
  return material;
}

RecipeLink read_link(RecipeTable table) {
  RecipeLink link;
  link.line = table.line();
  link.name = table.required_text("name");
  const std::string where = "link '" + link.name + "'";
  table.rename(where);
  for (const Value* value : table.tables("part")) {
    RecipeTable part = table.part(*value, where + ", part");
    link.parts.push_back({part.required_text("mesh"), part.required_text("material"), part.line()});
    part.done();
  }
  const std::vector<const Value*> collisions = table.tables("collision");
  for (std::size_t i = 0; i < collisions.size(); ++i) {
    RecipeTable collision = table.part(*collisions[i], where + ", collision");
    const std::string name =
        link.name + (collisions.size() > 1 ? "_" + std::to_string(i + 1) : std::string());
    link.collisions.push_back(
        {collision.text("name").value_or(name), collision.names("parts"), collision.line()});
    collision.done();
  }
  table.done();
  return link;
}

// From [paper] in its unit, or `origin` in metres; default: the parent's origin.
Vector3 read_origin(RecipeTable& table, const std::string& name, TableReader* paper) {
  const Vector3 origin = table.vector("origin").value_or(Vector3::Zero());
  if (!paper || !paper->has(name)) return origin;
  if (table.has("origin"))
    table.fault("origin", "is given here and in [paper]", "give it once", "recipe.value");
  paper->missing("unit", "give metres per unit");
  return paper->vector(name).value_or(Vector3::Zero()) * paper->number("unit").value_or(1);
}

JointDescription read_joint(RecipeTable table, TableReader* paper) {
  JointDescription joint;
  joint.line = table.line();
  joint.name = table.required_text("name");
  table.rename("joint '" + joint.name + "'");
  joint.lines = {table.line_of("parent"),
                 table.line_of("child"),
                 table.line_of("axis"),
                 table.line_of("limits"),
                 table.line_of("damping"),
                 table.line_of("armature"),
                 0};
  const std::string type = table.required_text("type");
  if (!type.empty() && !joint_type_from(type, joint.type))
    table.fault("type", "'" + type + "' is not supported", supported_joints(), "recipe.value");
  joint.parent = table.required_text("parent");
  joint.child = table.required_text("child");
  joint.origin.xyz = read_origin(table, joint.name, paper);
  joint.origin.rpy = table.vector("rpy").value_or(Vector3::Zero());
  if (joint.has_axis()) {
    table.missing("axis", "give axis = [x, y, z]");
    joint.axis = table.vector("axis").value_or(Vector3::UnitX());
    const double length = joint.axis.norm();
    if (length >= 1e-9) joint.axis /= length;
  }
  if (joint.is_limited() || (joint.type == Type::screw && table.has("limits"))) {
    table.missing("limits", "give limits = [lower, upper]");
    if (const auto limits = table.numbers("limits", 2)) {
      joint.lower = (*limits)[0];
      joint.upper = (*limits)[1];
    }
  }
  // Required by URDF; not used here.
  joint.effort = table.number("effort").value_or(joint.has_axis() ? 1000.0 : 0.0);
  joint.velocity = table.number("velocity").value_or(joint.has_axis() ? 100.0 : 0.0);
  joint.damping = table.number("damping").value_or(0);
  joint.friction = table.number("friction").value_or(0);
  joint.armature = table.number("armature").value_or(0);
  if (joint.type == Type::screw) table.missing("pitch", "give metres per revolution");
  const std::optional<double> pitch = table.number("pitch");
  if (joint.type == Type::screw) joint.pitch = pitch.value_or(1);
  joint.coulomb_plus = table.number("coulomb_plus").value_or(joint.friction);
  joint.coulomb_minus = table.number("coulomb_minus").value_or(joint.friction);
  table.done();
  return joint;
}

// Every list in [paper] is the origin of a joint.
void check_paper(TableReader& paper, const RecipeFile& recipe) {
  for (const Value& member : paper.value().members)
    if (member.is_list() && std::ranges::find(recipe.joints, member.key, &JointDescription::name) ==
                                recipe.joints.end())
      paper.fault(member.key, "is not a joint of this robot", "use the name of a joint",
                  "recipe.value");
}

}  // namespace

RecipeFile read_recipe_file(const std::filesystem::path& path, DiagnosticList& faults) {
  RecipeFile recipe;
  recipe.file = std::filesystem::absolute(path).lexically_normal();
  const std::string file = recipe.file.string();
  const Value root = read_toml(recipe.file);
  RecipeTable table(root, "recipe", file, faults);
  recipe.name = table.required_text("name");
  table.missing("mesh_scale", "give metres per unit of the mesh files");
  recipe.mesh_scale = table.positive("mesh_scale").value_or(1);
  if (const Value* value = table.table("material")) {
    RecipeTable materials = table.part(*value, "material");
    for (const Value& member : value->members)
      if (const Value* material = materials.table(member.key))
        recipe.materials[member.key] =
            read_material(table.part(*material, "material '" + member.key + "'"));
  }
  for (const Value* link : table.tables("link"))
    recipe.links.push_back(read_link(table.part(*link, "link")));
  std::optional<TableReader> paper;
  if (const Value* value = table.table("paper")) paper.emplace(*value, "[paper]", file, faults);
  for (const Value* joint : table.tables("joint"))
    recipe.joints.push_back(read_joint(table.part(*joint, "joint"), paper ? &*paper : nullptr));
  if (paper) check_paper(*paper, recipe);
  table.done();
  return recipe;
}

}  // namespace twinarm
