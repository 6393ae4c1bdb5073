// Reads the TOML file of a recipe; its keys: collision/import/README.md.
#include "collision/import/recipe/recipe_file.h"

#include <algorithm>

#include "collision/import/recipe/recipe_toml.h"
#include "collision/import/robot/robot_check.h"
#include "collision/import/toml/toml_file.h"

namespace twinarm {
namespace {

using Type = JointDescription::Type;

RecipeMaterial read_material(const toml::table& table, const std::string& where,
                             TomlSource& source) {
  source.only_keys(table, where, {"density", "color", "note"});
  RecipeMaterial material;
  material.density = source.number(table, "density", where);
  if (!(material.density > 0)) {
    source.fault(TomlSource::line_of(*table.get("density")), where, "'density' must be positive",
                 "give kg/m^3");
    material.density = 1;
  }
  const auto color = source.numbers(table, "color", where, 4);
  if (!color) return material;
  if (std::any_of(color->begin(), color->end(), [](double c) { return c < 0 || c > 1; }))
    source.fault(TomlSource::line_of(*table.get("color")), where, "'color' lies outside [0, 1]",
                 "give red, green, blue and opacity from 0 to 1");
  material.color = Vector4((*color)[0], (*color)[1], (*color)[2], (*color)[3]);
  return material;
}

RecipeLink read_link(const toml::table& table, TomlSource& source) {
  RecipeLink link;
  link.line = TomlSource::line_of(table);
  link.name = source.text(table, "name", "link");
  const std::string where = "link '" + link.name + "'";
  source.only_keys(table, where, {"name", "part", "collision", "note"});
  for (const toml::table* part : source.tables(table, "part", where)) {
    source.only_keys(*part, where + ", part", {"mesh", "material", "note"});
    link.parts.push_back({source.text(*part, "mesh", where + ", part"),
                          source.text(*part, "material", where + ", part"),
                          TomlSource::line_of(*part)});
  }
  const auto collisions = source.tables(table, "collision", where);
  for (std::size_t i = 0; i < collisions.size(); ++i) {
    const std::string name =
        link.name + (collisions.size() > 1 ? "_" + std::to_string(i + 1) : std::string());
    source.only_keys(*collisions[i], where + ", collision", {"name", "parts", "note"});
    link.collisions.push_back({source.text(*collisions[i], "name", where + ", collision", name),
                               source.texts(*collisions[i], "parts", where + ", collision"),
                               TomlSource::line_of(*collisions[i])});
  }
  return link;
}

// From [paper] in its unit, or `origin` in metres; default: the parent's origin.
Vector3 read_origin(const toml::table& table, const std::string& where, const std::string& name,
                    const toml::table* paper, TomlSource& source) {
  const bool in_paper = paper && paper->contains(name);
  if (in_paper && table.contains("origin"))
    source.fault(TomlSource::line_of(*table.get("origin")), where,
                 "its origin is given here and in [paper]", "give it once");
  if (in_paper)
    return source.vector3(*paper, name, "[paper]").value_or(Vector3::Zero()) *
           source.number(*paper, "unit", "[paper]");
  if (!table.contains("origin")) return Vector3::Zero();
  return source.vector3(table, "origin", where).value_or(Vector3::Zero());
}

JointDescription read_joint(const toml::table& table, const toml::table* paper,
                            TomlSource& source) {
  JointDescription joint;
  joint.line = TomlSource::line_of(table);
  joint.name = source.text(table, "name", "joint");
  const std::string where = "joint '" + joint.name + "'";
  source.only_keys(
      table, where,
      {"name", "type", "parent", "child", "axis", "limits", "origin", "rpy", "effort", "velocity",
       "damping", "friction", "pitch", "armature", "coulomb_plus", "coulomb_minus", "note"});
  const auto line_of = [&](const char* key) {
    const toml::node* node = table.get(key);
    return node ? TomlSource::line_of(*node) : 0;
  };
  joint.lines = {line_of("parent"),
                 line_of("child"),
                 line_of("axis"),
                 line_of("limits"),
                 line_of("damping"),
                 line_of("armature"),
                 0};
  const std::string type = source.text(table, "type", where);
  if (!type.empty() && !joint_type_from(type, joint.type))
    source.fault(TomlSource::line_of(*table.get("type")), where,
                 "joint type '" + type + "' is not supported", supported_joints());
  joint.parent = source.text(table, "parent", where);
  joint.child = source.text(table, "child", where);
  joint.origin.xyz = read_origin(table, where, joint.name, paper, source);
  if (table.contains("rpy"))
    joint.origin.rpy = source.vector3(table, "rpy", where).value_or(Vector3::Zero());
  if (joint.has_axis()) {
    joint.axis = source.vector3(table, "axis", where).value_or(Vector3::UnitX());
    const double length = joint.axis.norm();
    if (length >= 1e-9) joint.axis /= length;
  }
  if (joint.is_limited() || (joint.type == Type::screw && table.contains("limits")))
    if (const auto limits = source.numbers(table, "limits", where, 2)) {
      joint.lower = (*limits)[0];
      joint.upper = (*limits)[1];
    }
  // Required by URDF; not used here.
  joint.effort = source.number(table, "effort", where, joint.has_axis() ? 1000.0 : 0.0);
  joint.velocity = source.number(table, "velocity", where, joint.has_axis() ? 100.0 : 0.0);
  joint.damping = source.number(table, "damping", where, 0.0);
  joint.friction = source.number(table, "friction", where, 0.0);
  joint.armature = source.number(table, "armature", where, 0.0);
  if (joint.type == Type::screw) joint.pitch = source.number(table, "pitch", where);
  joint.coulomb_plus = source.number(table, "coulomb_plus", where, joint.friction);
  joint.coulomb_minus = source.number(table, "coulomb_minus", where, joint.friction);
  return joint;
}

// Every list in [paper] is the origin of a joint.
void check_paper(const toml::table* paper, const RecipeFile& recipe, TomlSource& source) {
  if (!paper) return;
  for (const auto& [key, node] : *paper) {
    const std::string name(key.str());
    const auto is_named = [&name](const JointDescription& joint) { return joint.name == name; };
    if (node.is_array() && std::none_of(recipe.joints.begin(), recipe.joints.end(), is_named))
      source.fault(TomlSource::line_of(node), "[paper]",
                   "'" + name + "' is not a joint of this robot", "use the name of a joint");
  }
}

toml::table parse(const std::filesystem::path& file) {
  const std::string text = read_toml_text(file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw InputError({{file.string(), static_cast<int>(error.source().begin.line), "",
                       "not well-formed TOML: " + std::string(error.description()),
                       "correct this line", "file.toml"}});
  }
}

}  // namespace

RecipeFile read_recipe_file(const std::filesystem::path& file, std::vector<Diagnostic>& faults) {
  RecipeFile recipe;
  recipe.file = std::filesystem::absolute(file).lexically_normal();
  const toml::table table = parse(recipe.file);
  TomlSource source(recipe.file.string(), faults);
  source.only_keys(table, "recipe",
                   {"name", "mesh_scale", "paper", "material", "link", "joint", "note"});
  recipe.name = source.text(table, "name", "recipe");
  recipe.mesh_scale = source.number(table, "mesh_scale", "recipe");
  if (!(recipe.mesh_scale > 0)) {
    source.fault(TomlSource::line_of(*table.get("mesh_scale")), "recipe",
                 "'mesh_scale' must be positive", "give metres per unit of the mesh files");
    recipe.mesh_scale = 1;
  }
  if (const toml::table* materials = source.table(table, "material", "recipe"))
    for (const auto& [key, node] : *materials) {
      const std::string name(key.str());
      if (const toml::table* material = source.table(*materials, key.str(), "material"))
        recipe.materials[name] = read_material(*material, "material '" + name + "'", source);
    }
  for (const toml::table* link : source.tables(table, "link", "recipe"))
    recipe.links.push_back(read_link(*link, source));
  const toml::table* paper = source.table(table, "paper", "recipe");
  for (const toml::table* joint : source.tables(table, "joint", "recipe"))
    recipe.joints.push_back(read_joint(*joint, paper, source));
  check_paper(paper, recipe, source);
  return recipe;
}

}  // namespace twinarm
