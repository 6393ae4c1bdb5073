// Couplings and constraints: what ties links and bodies together.
#include "app/nearest_name.h"
#include "app/scene/scene_names.h"
#include "app/scene/scene_reader.h"
#include "collision/import/number_text.h"

namespace twinarm {
namespace {

template <class Items>
std::string given_name(SceneTable& table, const char* kind, std::size_t index,
                       const Items& others) {
  const std::string name = table.text("name").value_or(kind + std::to_string(index));
  table.rename(std::string(kind) + " '" + name + "'");
  for (const auto& other : others)
    if (other.name == name)
      table.fault("name", "the name is taken already",
                  std::string("give each ") + kind + " its own name");
  return name;
}

// The robot that carries the link; nullptr, told, where it cannot be found.
const RobotInScene* read_robot_of(SceneTable& table, const SceneDescription& scene,
                                  CouplingDescription& coupling) {
  std::vector<std::string> names;
  for (const RobotInScene& robot : scene.robots) names.push_back(robot.name);
  if (!table.has("robot") && names.size() == 1)
    coupling.robot = names[0];
  else
    table.missing("robot", name_remedy("", names, "robots"));
  if (const auto name = table.text("robot")) coupling.robot = *name;
  for (const RobotInScene& robot : scene.robots)
    if (robot.name == coupling.robot) return &robot;
  if (!coupling.robot.empty())
    table.fault("robot", "there is no robot '" + coupling.robot + "'",
                name_remedy(coupling.robot, names, "robots"));
  return nullptr;
}

void read_link(SceneTable& table, const RobotDescription& robot, CouplingDescription& coupling) {
  table.missing("link", "name the link that is pulled");
  coupling.link = table.text("link").value_or("");
  if (coupling.link.empty() || robot.links.empty()) return;
  std::vector<std::string> names;
  for (const LinkDescription& link : robot.links) names.push_back(link.name);
  if (!find_link(robot, coupling.link))
    return table.fault("link", "there is no link '" + coupling.link + "'",
                       name_remedy(coupling.link, names, "links"));
  if (coupling.type != CouplingDescription::Type::torsional || coupling.measure != Measure::joint)
    return;
  for (const JointDescription& joint : robot.joints)
    if (joint.child == coupling.link && joint.dofs() == 1 && !joint.mimic) return;
  table.fault("link", "its joint has not one degree of freedom of its own",
              "name a link on a revolute, prismatic or screw joint, or give measure = \"world\"");
}

void read_treatment(SceneTable& table, CouplingDescription& coupling) {
  coupling.rate = table.positive("rate").value_or(0);
  if (const auto chosen = table.choice("treatment", {"explicit", "semi-implicit", "implicit"}))
    coupling.treatment = static_cast<Treatment>(*chosen);
  else if (coupling.rate > 0)
    coupling.treatment = Treatment::explicit_;
  if (coupling.rate > 0 && coupling.treatment != Treatment::explicit_)
    table.fault("rate", "a held force is explicit: it cannot see the end of the step",
                "give treatment = \"explicit\", or leave 'rate' out");
}

void read_target(SceneReader& reader, SceneTable& table, const RobotDescription& robot,
                 CouplingTarget& target) {
  const TomlValue* value = table.find("target");
  if (!value) return;
  if (value->kind == TomlValue::Kind::table) {
    SceneTable state = reader.open(*value, table.where() + ", target");
    target.kind = CouplingTarget::Kind::state;
    target.q = reader.read_joints(state, "q", robot, false);
    return state.done();
  }
  const std::string name = table.text("target").value_or("");
  if (name == "paper") {
    target.kind = CouplingTarget::Kind::paper;
  } else if (name == "device") {
    target.kind = CouplingTarget::Kind::device;
  } else if (!name.empty()) {
    target.kind = CouplingTarget::Kind::trace;
    if (const auto file = reader.find_file(table, "target", name)) target.trace = *file;
  }
}

// How late and how fast the motion of the target is seen.
void read_pace(SceneTable& table, CouplingDescription& coupling) {
  using Kind = CouplingTarget::Kind;
  const Kind target = coupling.target.kind;
  const bool moves = target != Kind::start && target != Kind::state;
  coupling.delay = table.not_negative("delay").value_or(0);
  if (coupling.delay > 0 && !moves)
    table.fault("delay", "the target stands still: seen late, it is the same",
                "leave it out, or give a target that moves");
  const auto speed = table.positive("speed");
  coupling.speed = speed.value_or(1);
  if (speed && target != Kind::paper && target != Kind::trace)
    table.fault("speed", "is of a target that is a motion by name or a trace",
                "leave it out, or give target = \"paper\" or a trace file");
}

}  // namespace

void SceneReader::read_coupling(const TomlValue& value, std::size_t index) {
  SceneTable table = open(value, "coupling");
  CouplingDescription coupling;
  coupling.line = table.line();
  coupling.name = given_name(table, "coupling", index, scene.couplings);
  table.missing("type", "give type = \"linear\" or \"torsional\"");
  if (const auto type = table.choice("type", {"linear", "torsional"}))
    coupling.type = static_cast<CouplingDescription::Type>(*type);
  const bool linear = coupling.type == CouplingDescription::Type::linear;
  if (const auto measure = table.choice("measure", {"world", "joint"})) {
    coupling.measure = static_cast<Measure>(*measure);
    if (linear) table.fault("measure", "is of a torsional coupling", "leave it out");
  }
  coupling.point = table.vector("point").value_or(Vector3::Zero());
  if (!linear && table.has("point"))
    table.fault("point", "a torsional coupling turns the link, and has no point", "leave it out");
  table.missing("stiffness", linear ? "give it in N/m" : "give it in N m/rad");
  coupling.stiffness = table.not_negative("stiffness").value_or(0);
  coupling.damping = table.not_negative("damping").value_or(0);
  read_treatment(table, coupling);
  if (const auto damper = table.choice("damper", {"relative", "absolute"}))
    coupling.absolute_damper = *damper == 1;
  const RobotInScene* robot = read_robot_of(table, scene, coupling);
  const RobotDescription nobody;
  const RobotDescription& description = robot ? robot->description : nobody;
  read_link(table, description, coupling);
  if (robot && !description.links.empty())
    read_target(*this, table, description, coupling.target), read_pace(table, coupling);
  else
    for (const char* key : {"target", "delay", "speed"}) table.find(key);
  table.done();
  scene.couplings.push_back(std::move(coupling));
}

void SceneReader::read_constraint(const TomlValue& value, std::size_t index) {
  using Type = ConstraintDescription::Type;
  SceneTable table = open(value, "constraint");
  ConstraintDescription constraint;
  constraint.line = table.line();
  constraint.name = given_name(table, "constraint", index, scene.constraints);
  table.missing("type", "give type = \"weld\", \"ball\", \"hinge\", \"distance\" or \"gear\"");
  if (const auto type = table.choice("type", {"weld", "ball", "hinge", "distance", "gear"}))
    constraint.type = static_cast<Type>(*type);
  const bool gear = constraint.type == Type::gear;

  const auto read_end = [&](const char* key) -> std::string {
    table.missing(key, gear ? "name a joint: robot/joint" : "name a body, robot/link or world");
    const auto name = table.text(key);
    if (!name) return "";
    if (gear) {
      const auto joint = find_joint(scene, *name);
      if (!joint)
        table.fault(key, "there is no joint '" + *name + "'", "name it as robot/joint");
      else if (joint->joint->dofs() != 1)
        table.fault(key,
                    "the joint has " + std::to_string(joint->joint->dofs()) + " degrees of freedom",
                    "a gear goes between joints of one");
      return *name;
    }
    const auto found = find_reference(scene, *name);
    if (!found || (found->robot >= 0 && found->link.empty()))
      table.fault(key, found ? "a robot has many links" : "there is no body '" + *name + "'",
                  name_remedy(*name, reference_names(scene), "names"));
    return *name;
  };
  constraint.a = read_end("a");
  constraint.b = read_end("b");
  if (!constraint.a.empty() && constraint.a == constraint.b)
    table.fault("b", "is the same as a", "name two");

  const auto place = [&](const char* key, bool allowed) -> std::optional<Vector3> {
    const auto found = table.vector(key);
    if (table.has(key) && !allowed)
      table.fault(key, "has no meaning in this type of constraint", "leave it out");
    return found;
  };
  constraint.point = place("point", !gear);
  constraint.point_b = place("point_b", constraint.type == Type::distance);
  constraint.axis = place("axis", constraint.type == Type::hinge);
  if (constraint.axis && !(constraint.axis->norm() > 0))
    table.fault("axis", "has no direction", "give an axis that is not zero");
  if (constraint.type == Type::ball || constraint.type == Type::hinge)
    table.missing("point", "give the point that both share, in the world at the start");
  if (constraint.type == Type::hinge)
    table.missing("axis", "give the axis of the hinge, in the world at the start");
  if (gear) table.missing("ratio", "give the speed of a as a multiple of that of b");
  if (const auto ratio = table.number("ratio")) {
    constraint.ratio = *ratio;
    if (!gear) table.fault("ratio", "is of a gear", "leave it out");
    if (*ratio == 0) table.fault("ratio", "must not be 0", "");
  }
  table.done();
  scene.constraints.push_back(std::move(constraint));
}

}  // namespace twinarm
