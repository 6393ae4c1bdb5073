// Couplings between a robot and its target robot.
#include <fmt/format.h>

#include "app/scene/read/read_scene.h"
#include "app/scene/read/scene_keys.h"
#include "app/scene/read/scene_reader.h"
#include "app/support/text.h"
#include "coupling/target/recorded_trace.h"

namespace twinarm {
namespace {

// The robot of the coupling; nullptr with a diagnostic if there is none.
const RobotInScene* read_robot_of(TableReader& table, const SceneDescription& scene,
                                  CouplingDescription& coupling) {
  const std::vector<std::string> names = names_of(scene.robots);
  if (!table.has("robot") && names.size() == 1)
    coupling.robot = names[0];
  else
    table.missing("robot", name_remedy("", names, "robots"));
  if (const auto name = table.text("robot")) coupling.robot = *name;
  for (const RobotInScene& robot : scene.robots)
    if (robot.name == coupling.robot) return &robot;
  if (!coupling.robot.empty())
    table.fault("robot", "there is no robot '" + coupling.robot + "'",
                name_remedy(coupling.robot, names, "robots"), "scene.unknown-name");
  return nullptr;
}

void read_link(TableReader& table, const RobotDescription& robot, CouplingDescription& coupling) {
  table.missing("link", "name the link on which it acts");
  coupling.link = table.text("link").value_or("");
  if (coupling.link.empty() || robot.links.empty()) return;
  if (!find_link(robot, coupling.link))
    return table.fault("link", "there is no link '" + coupling.link + "'",
                       name_remedy(coupling.link, names_of(robot.links), "links"),
                       "scene.unknown-name");
  if (coupling.at_joint() && !own_joint(robot, coupling.link))
    table.fault("link", "its joint is a mimic joint, or does not have one degree of freedom",
                "name the child of a revolute, prismatic or screw joint, or give measure = "
                "\"world\"",
                "scene.degrees-of-freedom");
}

// Whether the type has the key; a diagnostic if it is given and the type does not have it.
bool fits(TableReader& table, const char* key, const CouplingFacts& facts) {
  const CouplingKey& row = coupling_key(key);
  if (row.has(facts)) return true;
  if (table.has(key)) table.fault(key, row.useless, "leave it out", "scene.key-useless");
  return false;
}

void read_discretization(TableReader& table, const CouplingFacts& facts,
                         CouplingDescription& coupling) {
  using Discretizations = CouplingFacts::Discretizations;
  if (facts.discretizations == Discretizations::own) {
    coupling.discretization = Discretization::semi_implicit;
    fits(table, "discretization", facts);
    return;
  }
  const bool is_explicit = coupling.rate > 0 ||
                           facts.discretizations == Discretizations::explicit_only ||
                           facts.gains == CouplingFacts::Gains::reference;
  if (is_explicit) coupling.discretization = Discretization::explicit_;
  if (const auto chosen = table.choice("discretization", {"explicit", "semi-implicit", "implicit"}))
    coupling.discretization = static_cast<Discretization>(*chosen);
  if (coupling.discretization == Discretization::explicit_) return;
  if (facts.discretizations == Discretizations::explicit_only)
    table.fault("discretization", "this type of coupling is explicit",
                "leave it out, or choose another type", "scene.discretization");
  if (coupling.rate > 0)
    table.fault("rate", "a force that is held between evaluations is explicit",
                "give discretization = \"explicit\", or leave 'rate' out", "scene.discretization");
}

// The numbers that depend on the type, not on the target.
void read_numbers(TableReader& table, const CouplingFacts& facts, CouplingDescription& coupling) {
  for (const CouplingKey& row : coupling_keys()) {
    if (!row.number || row.of_target || !fits(table, row.key, facts)) continue;
    if (row.is_required())
      table.missing(row.key, std::string("give it in ") + row.unit_of(!coupling.is_linear()));
    double& number = row.number(coupling);
    number = read_number(table, row.key, row.range).value_or(number);
  }
}

// Type, measure, point and damper.
void read_law(TableReader& table, const CouplingFacts& facts, CouplingDescription& coupling) {
  coupling.type =
      facts.at_point ? CouplingDescription::Type::linear : CouplingDescription::Type::torsional;
  if (facts.at_joint) coupling.measure = SpringSpace::joint;
  if (fits(table, "measure", facts))
    if (const auto measure = table.choice("measure", {"world", "joint"}))
      coupling.measure = static_cast<SpringSpace>(*measure);
  if (fits(table, "point", facts)) coupling.point = table.vector("point").value_or(Vector3::Zero());
  coupling.absolute_damper = facts.gains == CouplingFacts::Gains::reference;
  if (fits(table, "damper", facts))
    if (const auto damper = table.choice("damper", {"relative", "absolute"}))
      coupling.absolute_damper = *damper == 1;
}

// Soft limits: the spring-damper acts outside this range of joint positions.
void read_soft_limits(TableReader& table, CouplingDescription& coupling) {
  const auto limits = table.numbers("soft_limits", 2);
  if (!limits) return;
  coupling.soft_limits = {(*limits)[0], (*limits)[1]};
  if (!((*limits)[0] <= (*limits)[1]))
    table.fault("soft_limits", "the first number exceeds the second", "give [lower, upper]",
                "scene.order");
  if (!coupling.at_joint() || coupling.discretization != Discretization::implicit ||
      table.has("target"))
    table.fault("soft_limits", "needs an implicit torsional coupling at a joint, without a target",
                "give type = \"torsional\", measure = \"joint\", and no discretization and target",
                "scene.stop");
}

// The joint that the device's button moves.
void read_gripper(SceneReader& reader, TableReader& table, const RobotDescription& robot,
                  CouplingTarget& target) {
  const Value* value = table.table("gripper");
  if (!value) return;
  if (!target.is_operator())
    table.fault("gripper", "needs an operator motion", "give one, as target = \"paper\"",
                "scene.key-useless");
  TableReader gripper = reader.open(*value, table.where() + ", gripper");
  for (const char* key : {"joint", "open", "closed"})
    gripper.missing(key, "give { joint = \"..\", open = 0, closed = 0.06 }");
  target.gripper = gripper.text("joint").value_or("");
  target.open = gripper.number("open").value_or(0);
  target.closed = gripper.number("closed").value_or(0);
  gripper.done();
  std::vector<std::string> names;
  for (const JointDescription& joint : robot.joints)
    if (joint.dofs() == 1 && !joint.mimic) names.push_back(joint.name);
  if (!target.gripper.empty() && std::ranges::find(names, target.gripper) == names.end())
    gripper.fault("joint", "there is no such joint of one degree of freedom",
                  name_remedy(target.gripper, names, "joints"), "scene.unknown-name");
}

// [low, high] of a synthetic operator.
void read_range(TableReader& motion, const char* key, double upper, std::array<double, 2>& range) {
  const auto given = motion.numbers(key, 2);
  if (!given) return;
  const double low = given->front(), high = given->back();
  if (low > 0 && low <= high && high <= upper)
    range = {low, high};
  else
    motion.fault(key, fmt::format("must be [low, high] with 0 < low <= high <= {:g}", upper),
                 fmt::format("give {} = [{:g}, {:g}]", key, range[0], range[1]), "scene.range");
}

void read_synthetic(TableReader& motion, CouplingTarget& target) {
  target.kind = CouplingTarget::Kind::synthetic;
  const double seed = motion.not_negative("seed").value_or(1);
  if (!(seed <= 4294967295.0) || seed != std::floor(seed))
    motion.fault("seed", "must be a whole number below 2^32", "give seed = 1", "scene.range");
  else
    target.seed = static_cast<unsigned>(seed);
  target.duration = motion.positive("duration").value_or(20);
  if (target.duration > 1e5)
    motion.fault("duration", "must be at most 100000 s", "give a shorter one", "scene.range");
  read_range(motion, "peak_speed", 100, target.ranges.peak_speed);
  read_range(motion, "tremor", 1, target.ranges.tremor);
}

// Adds the warnings of a trace. Its errors are reported when it is used.
void add_trace_warnings(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  try {
    const RecordedTrace trace(file);
    for (const std::string& warning : trace.quality().warnings)
      warnings.push_back(file.string() + ": " + warning);
  } catch (const InputError&) {
  }
}

void read_target(SceneReader& reader, TableReader& table, const RobotDescription& robot,
                 CouplingTarget& target) {
  const Value* value = table.find("target");
  if (!value) return;
  if (value->kind == Value::Kind::table) {
    TableReader state = reader.open(*value, table.where() + ", target");
    if (state.has("seed")) {
      read_synthetic(state, target);
      return state.done();
    }
    target.kind = CouplingTarget::Kind::state;
    target.q = reader.read_joints(state, "q", robot, JointRows::coordinates);
    return state.done();
  }
  const std::string name = table.text("target").value_or("");
  if (name == "paper") {
    target.kind = CouplingTarget::Kind::paper;
  } else if (name == "device") {
    target.kind = CouplingTarget::Kind::device;
  } else if (!name.empty()) {
    target.kind = CouplingTarget::Kind::trace;
    if (const auto file = reader.find_file(table, "target", name)) {
      target.trace = *file;
      add_trace_warnings(*file, reader.scene.warnings);
    }
  }
}

// Delay and speed of the target's motion.
void read_timing(TableReader& table, CouplingDescription& coupling) {
  for (const CouplingKey& row : coupling_keys()) {
    if (!row.of_target) continue;
    const double given = read_number(table, row.key, row.range).value_or(0);
    if (given != 0) row.number(coupling) = given;
    if (given != 0 && !row.of_target(coupling.target.kind))
      table.fault(row.key, row.useless, row.help, "scene.key-useless");
  }
}

}  // namespace

void SceneReader::read_coupling(const Value& value, std::size_t index) {
  TableReader table = open(value, "coupling");
  CouplingDescription coupling;
  coupling.line = table.line();
  coupling.name = read_item_name(table, "coupling", index);
  table.missing("type",
                "give type = \"linear\", \"torsional\" or another (docs/reference/scene_file.md)");
  const std::size_t chosen = table.choice("type", names_of(all_couplings)).value_or(0);
  const CouplingFacts& facts = all_couplings[chosen];
  coupling.law = facts.type;
  coupling.printed = facts.printed;
  read_law(table, facts, coupling);
  read_numbers(table, facts, coupling);
  read_discretization(table, facts, coupling);
  const RobotInScene* robot = read_robot_of(table, scene, coupling);
  const RobotDescription none;
  const RobotDescription& description = robot ? robot->description : none;
  if (fits(table, "link", facts)) read_link(table, description, coupling);
  read_soft_limits(table, coupling);
  if (robot && !description.links.empty()) {
    read_target(*this, table, description, coupling.target);
    read_gripper(*this, table, description, coupling.target);
    read_timing(table, coupling);
  } else {
    for (const char* key : {"target", "delay", "speed", "gripper"}) table.find(key);
  }
  table.done();
  scene.couplings.push_back(std::move(coupling));
}

}  // namespace twinarm
