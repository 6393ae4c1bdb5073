// Constraints and springs between links and bodies.
#include "app/scene/read/read_scene.h"
#include "app/scene/read/scene_reader.h"
#include "app/support/text.h"
#include "solver/expressions/expression_parser.h"

namespace twinarm {
namespace {

using Type = ConstraintDescription::Type;

// Name of the joint of a gear, or of the body of other constraints; a diagnostic if there is none.
std::string read_end(TableReader& table, const char* key, bool gear,
                     const SceneDescription& scene) {
  table.missing(key, gear ? "name a joint: robot/joint" : "name a body, robot/link or world");
  const auto name = table.text(key);
  if (!name) return "";
  if (gear) {
    const auto joint = find_joint(scene, *name);
    if (!joint)
      table.fault(key, "there is no joint '" + *name + "'", "name it as robot/joint",
                  "scene.unknown-name");
    else if (joint->joint->dofs() != 1)
      table.fault(key,
                  "the joint has " + std::to_string(joint->joint->dofs()) + " degrees of freedom",
                  "name a joint with one", "scene.degrees-of-freedom");
    return *name;
  }
  const auto found = find_reference(scene, *name);
  if (!found || (found->robot >= 0 && found->link.empty()))
    table.fault(key, found ? "names a robot, not a link" : "there is no body '" + *name + "'",
                name_remedy(*name, reference_names(scene), "names"), "scene.unknown-name");
  return *name;
}

void refuse(TableReader& table, const char* key) {
  if (table.has(key))
    table.fault(key, "is not a key of this type of constraint", "leave it out",
                "scene.key-useless");
}

// The keys that only some types have.
void read_type_keys(TableReader& table, ConstraintDescription& constraint) {
  const bool gear = constraint.type == Type::gear;
  const bool of_joints = gear || constraint.type == Type::locked;
  const auto vector = [&](const char* key, bool allowed) {
    if (!allowed) refuse(table, key);
    return table.vector(key);
  };
  if (constraint.type != Type::locked) refuse(table, "position");
  constraint.point = vector("point", !of_joints);
  constraint.point_b = vector("point_b", constraint.type == Type::distance);
  const bool has_axis = !of_joints && constraint.type != Type::weld &&
                        constraint.type != Type::ball && constraint.type != Type::distance;
  constraint.axis = vector("axis", has_axis);
  constraint.axis_b = vector("axis_b", constraint.type == Type::universal);
  for (const auto& [key, axis] :
       {std::pair("axis", constraint.axis), {"axis_b", constraint.axis_b}})
    if (axis && !(axis->norm() > 0))
      table.fault(key, "is zero", "give a direction", "scene.no-direction");
  if (constraint.type == Type::ball || has_axis)
    table.missing("point", "give the common point in the world at the start");
  if (has_axis) table.missing("axis", "give the axis in the world at the start");
  if (constraint.type == Type::universal)
    table.missing("axis_b", "give the axis of b, perpendicular to that of a");
  if (gear) table.missing("ratio", "give the speed of a as a multiple of that of b");
  if (const auto ratio = table.number("ratio")) {
    constraint.ratio = *ratio;
    if (!gear) table.fault("ratio", "is a key of gears only", "leave it out", "scene.key-useless");
    if (*ratio == 0) table.fault("ratio", "must not be 0", "", "scene.zero");
  }
}

Dimension unit(const char* text) {
  return parse_unit(text)->dimension;
}

// A formula, and as many derivatives by the last symbol; a diagnostic if it cannot be read.
std::optional<ExpressionTape> read_formula(TableReader& table, const char* key,
                                           const std::vector<ExpressionSymbol>& symbols,
                                           const Dimension& wanted, std::size_t derivatives,
                                           const char* fix) {
  const auto text = table.text(key);
  if (!text) return std::nullopt;
  try {
    ExpressionGraph graph;
    std::vector outputs{parse_expression(graph, *text, symbols, wanted)};
    std::vector<ExpressionGraph::Id> inputs;
    for (const ExpressionSymbol& symbol : symbols) inputs.push_back(graph.symbol(symbol.name));
    while (outputs.size() <= derivatives)
      outputs.push_back(graph.derivative(outputs.back(), inputs.back()));
    return ExpressionTape(graph, inputs, outputs);
  } catch (const std::exception& error) {
    table.fault(key, error.what(), fix, "scene.formula");
    return std::nullopt;
  }
}

// The motion of joint a over time.
void read_motion_of_joint(TableReader& table, ConstraintDescription& constraint,
                          const SceneDescription& scene) {
  refuse(table, "b");
  table.missing("position", "give the joint's position over time, as \"0.5 * sin(2[1/s] * t)\"");
  const auto joint = find_joint(scene, constraint.a);
  const bool slides = joint && joint->joint->type == JointDescription::Type::prismatic;
  constraint.motion =
      read_formula(table, "position", {{"t", unit("s")}}, unit(slides ? "m" : "rad"), 2,
                   slides ? "give a length over time t, as \"50[mm] * sin(2[1/s] * t)\""
                          : "give an angle over time t, as \"0.5 * sin(2[1/s] * t)\"");
}

}  // namespace

void SceneReader::read_spring(const Value& value, std::size_t index) {
  TableReader table = open(value, "spring");
  SpringDescription spring;
  spring.line = table.line();
  spring.name = read_item_name(table, "spring", index);
  spring.a = read_end(table, "a", false, scene);
  spring.b = read_end(table, "b", false, scene);
  if (!spring.a.empty() && spring.a == spring.b)
    table.fault("b", "is the same as a", "name two bodies", "scene.same-ends");
  spring.point = table.vector("point");
  spring.point_b = table.vector("point_b");
  spring.stiffness = table.not_negative("stiffness").value_or(0);
  spring.damping = table.not_negative("damping").value_or(0);
  spring.rest_length = table.not_negative("rest_length");
  spring.law = read_formula(
      table, "force", {{"l", unit("m")}, {"v", unit("m/s")}, {"t", unit("s")}}, unit("N"), 0,
      "give a force of length l, rate v and time t, as \"-20[N] + 3[N s/m] * v\"");
  if (!table.has("stiffness") && !table.has("damping") && !table.has("force"))
    table.fault("stiffness", "is missing", "give a stiffness, a damping or a force",
                "scene.missing");
  table.done();
  scene.springs.push_back(std::move(spring));
}

void SceneReader::read_constraint(const Value& value, std::size_t index) {
  TableReader table = open(value, "constraint");
  ConstraintDescription constraint;
  constraint.line = table.line();
  constraint.name = read_item_name(table, "constraint", index);
  table.missing("type", "give type = \"weld\", \"ball\", \"hinge\" or another");
  std::vector<std::string> types;  // in the order of Type
  for (const LoopTypeFacts& facts : all_loop_types())
    types.emplace_back(facts.type == Type::locked ? "motion" : facts.name);
  if (const auto type = table.choice("type", types)) constraint.type = static_cast<Type>(*type);
  const bool is_motion = constraint.type == Type::locked;
  const bool of_joints = constraint.type == Type::gear || is_motion;

  constraint.a = read_end(table, "a", of_joints, scene);
  if (is_motion)
    read_motion_of_joint(table, constraint, scene);
  else
    constraint.b = read_end(table, "b", of_joints, scene);
  if (!constraint.a.empty() && constraint.a == constraint.b)
    table.fault("b", "is the same as a", "name two bodies or joints", "scene.same-ends");
  read_type_keys(table, constraint);
  table.done();
  scene.constraints.push_back(std::move(constraint));
}

}  // namespace twinarm
