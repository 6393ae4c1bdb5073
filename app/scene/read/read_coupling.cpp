// Couplings: spring-dampers and other pulls after a kinematic twin.
#include <algorithm>
#include <cmath>

#include "app/scene/read/scene_names.h"
#include "app/scene/read/scene_reader.h"
#include "app/support/nearest_name.h"
#include "coupling/target/recorded_trace.h"

namespace twinarm {
namespace {

using Law = CouplingSpec::Type;

// The robot that carries the link; nullptr, told, where it cannot be found.
const RobotInScene* read_robot_of(TableReader& table, const SceneDescription& scene,
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
                name_remedy(coupling.robot, names, "robots"), "scene.unknown-name");
  return nullptr;
}

void read_link(TableReader& table, const RobotDescription& robot, CouplingDescription& coupling) {
  table.missing("link", "name the link that is pulled");
  coupling.link = table.text("link").value_or("");
  if (coupling.link.empty() || robot.links.empty()) return;
  std::vector<std::string> names;
  for (const LinkDescription& link : robot.links) names.push_back(link.name);
  if (!find_link(robot, coupling.link))
    return table.fault("link", "there is no link '" + coupling.link + "'",
                       name_remedy(coupling.link, names, "links"), "scene.unknown-name");
  if (coupling.type != CouplingDescription::Type::torsional || coupling.measure != Measure::joint)
    return;
  for (const JointDescription& joint : robot.joints)
    if (joint.child == coupling.link && joint.dofs() == 1 && !joint.mimic) return;
  table.fault("link", "its joint has not one degree of freedom of its own",
              "name a link on a revolute, prismatic or screw joint, or give measure = \"world\"",
              "scene.degrees-of-freedom");
}

// Whether the key is one of the law's; told where it stands and is not.
bool fits(TableReader& table, const char* key, bool is_of_law, const char* rule) {
  if (!is_of_law && table.has(key)) table.fault(key, rule, "leave it out", "scene.key-useless");
  return is_of_law;
}

void read_treatment(TableReader& table, const CouplingFacts& facts, CouplingDescription& coupling) {
  using Treatments = CouplingFacts::Treatments;
  if (fits(table, "rate", facts.can_hold, "this type of coupling is computed at every step"))
    coupling.rate = table.positive("rate").value_or(0);
  if (facts.treatments == Treatments::own) {
    coupling.treatment = Treatment::semi_implicit;
    fits(table, "treatment", false, "this type of coupling is a treatment of its own");
    return;
  }
  const bool is_explicit = coupling.rate > 0 || facts.treatments == Treatments::explicit_only ||
                           coupling.law == Law::weld_like;
  if (is_explicit) coupling.treatment = Treatment::explicit_;
  if (const auto chosen = table.choice("treatment", {"explicit", "semi-implicit", "implicit"}))
    coupling.treatment = static_cast<Treatment>(*chosen);
  if (coupling.treatment == Treatment::explicit_) return;
  if (facts.treatments == Treatments::explicit_only)
    table.fault("treatment", "this type of coupling is explicit: it sees the start of the step",
                "leave it out, or choose another type", "scene.treatment");
  if (coupling.rate > 0)
    table.fault("rate", "a held force is explicit: it cannot see the end of the step",
                "give treatment = \"explicit\", or leave 'rate' out", "scene.treatment");
}

void read_gains(TableReader& table, CouplingDescription& coupling) {
  const char* none = "this type of coupling has no such gain";
  const bool has_gains = coupling.law != Law::weld_like && coupling.law != Law::god_object,
             is_linear = coupling.type == CouplingDescription::Type::linear;
  if (fits(table, "stiffness", has_gains, none)) {
    table.missing("stiffness", is_linear ? "give it in N/m" : "give it in N m/rad");
    coupling.stiffness = table.not_negative("stiffness").value_or(0);
  }
  if (fits(table, "damping", has_gains, none))
    coupling.damping = table.not_negative("damping").value_or(0);
  const bool is_bushing = coupling.law == Law::bushing;
  if (fits(table, "turn_stiffness", is_bushing, "is of a bushing")) {
    table.missing("turn_stiffness", "give it in N m/rad");
    coupling.turn_stiffness = table.not_negative("turn_stiffness").value_or(0);
  }
  if (fits(table, "turn_damping", is_bushing, "is of a bushing"))
    coupling.turn_damping = table.not_negative("turn_damping").value_or(0);
  const bool is_weld = coupling.law == Law::weld_like;
  WeldReference& weld = coupling.reference;
  const std::pair<const char*, double*> references[] = {{"time_constant", &weld.time_constant},
                                                        {"damping_ratio", &weld.damping_ratio},
                                                        {"impedance", &weld.impedance}};
  for (const auto& [key, value] : references)
    if (fits(table, key, is_weld, "is of a weld")) *value = table.positive(key).value_or(*value);
  if (is_weld && weld.impedance >= 1)
    table.fault("impedance", "must be below 1: at 1 the weld would be rigid",
                "give a number between 0 and 1, or a [[constraint]] of type \"weld\"",
                "scene.range");
}

// How it pulls, and where.
void read_pull(TableReader& table, const CouplingFacts& facts, CouplingDescription& coupling) {
  coupling.type =
      facts.at_point ? CouplingDescription::Type::linear : CouplingDescription::Type::torsional;
  if (facts.at_joint) coupling.measure = Measure::joint;
  if (fits(table, "measure", facts.has_measure, "is of a torsional coupling"))
    if (const auto measure = table.choice("measure", {"world", "joint"}))
      coupling.measure = static_cast<Measure>(*measure);
  if (fits(table, "point", facts.at_point, "this type of coupling turns the link: it has no point"))
    coupling.point = table.vector("point").value_or(Vector3::Zero());
  coupling.absolute_damper = coupling.law == Law::weld_like;
  const bool has_damper =
      !facts.printed && coupling.law != Law::god_object && coupling.law != Law::weld_like;
  if (fits(table, "damper", has_damper, "this type of coupling has a damper of its own, or none"))
    if (const auto damper = table.choice("damper", {"relative", "absolute"}))
      coupling.absolute_damper = *damper == 1;
}

// A soft stop: the spring-damper acts outside of these two coordinates of the joint.
void read_outside(TableReader& table, CouplingDescription& coupling) {
  const auto ends = table.numbers("outside", 2);
  if (!ends) return;
  coupling.outside = {(*ends)[0], (*ends)[1]};
  if (!((*ends)[0] <= (*ends)[1]))
    table.fault("outside", "the first is above the second", "give [lower, upper]", "scene.order");
  const bool at_joint =
      coupling.type == CouplingDescription::Type::torsional && coupling.measure == Measure::joint;
  if (!at_joint || coupling.treatment != Treatment::implicit || table.has("target"))
    table.fault("outside", "a stop is a torsional coupling at a joint, implicit, without a target",
                "give type = \"torsional\", measure = \"joint\", and leave the others out",
                "scene.stop");
}

// The joint that the button of the hand moves.
void read_gripper(SceneReader& reader, TableReader& table, const RobotDescription& robot,
                  CouplingTarget& target) {
  const Value* value = table.table("gripper");
  if (!value) return;
  if (!target.is_hand())
    table.fault("gripper", "no hand moves this target", "give one, as target = \"paper\"",
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
  if (!target.gripper.empty() &&
      std::find(names.begin(), names.end(), target.gripper) == names.end())
    gripper.fault("joint", "there is no such joint of one degree of freedom",
                  name_remedy(target.gripper, names, "joints"), "scene.unknown-name");
}

void read_synthetic(TableReader& hand, CouplingTarget& target) {
  target.kind = CouplingTarget::Kind::synthetic;
  const double seed = hand.not_negative("seed").value_or(1);
  if (!(seed <= 4294967295.0) || seed != std::floor(seed))
    hand.fault("seed", "must be a whole number below 2^32", "give seed = 1", "scene.range");
  else
    target.seed = static_cast<unsigned>(seed);
  target.duration = hand.positive("duration").value_or(20);
  if (target.duration > 1e5)
    hand.fault("duration", "must be at most 100000 s", "give a shorter one", "scene.range");
}

// What should be known of a trace before a run on it. Its faults are told where it is played.
void look_at_trace(const std::filesystem::path& file, std::vector<std::string>& warnings) {
  try {
    const RecordedTrace trace(file);
    for (const std::string& warning : trace.quality().warnings)
      warnings.push_back(file.string() + ": " + warning);
  } catch (const InputError&) {
    return;
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
      look_at_trace(*file, reader.scene.warnings);
    }
  }
}

// How late and how fast the motion of the target is seen.
void read_pace(TableReader& table, CouplingDescription& coupling) {
  using Kind = CouplingTarget::Kind;
  const Kind target = coupling.target.kind;
  const bool moves = coupling.target.is_hand();
  coupling.delay = table.not_negative("delay").value_or(0);
  if (coupling.delay > 0 && !moves)
    table.fault("delay", "the target stands still: seen late, it is the same",
                "leave it out, or give a target that moves", "scene.key-useless");
  const auto speed = table.positive("speed");
  coupling.speed = speed.value_or(1);
  if (speed && target != Kind::paper && target != Kind::trace && target != Kind::synthetic)
    table.fault("speed", "is of a target that is a motion by name or a trace",
                "leave it out, or give target = \"paper\" or a trace file", "scene.key-useless");
}

}  // namespace

void SceneReader::read_coupling(const Value& value, std::size_t index) {
  TableReader table = open(value, "coupling");
  CouplingDescription coupling;
  coupling.line = table.line();
  coupling.name = read_item_name(table, "coupling", index, scene.couplings);
  std::vector<std::string> types;
  for (const CouplingFacts& facts : all_couplings) types.emplace_back(facts.name);
  table.missing("type", "give type = \"linear\", \"torsional\" or another of docs/scenes.md");
  const std::size_t chosen = table.choice("type", types).value_or(0);
  const CouplingFacts& facts = all_couplings[chosen];
  coupling.law = facts.type;
  coupling.printed = facts.printed;
  read_pull(table, facts, coupling);
  read_gains(table, coupling);
  read_treatment(table, facts, coupling);
  const RobotInScene* robot = read_robot_of(table, scene, coupling);
  const RobotDescription nobody;
  const RobotDescription& description = robot ? robot->description : nobody;
  if (fits(table, "link", coupling.law != Law::god_object, "a god object drives all joints"))
    read_link(table, description, coupling);
  read_outside(table, coupling);
  if (robot && !description.links.empty()) {
    read_target(*this, table, description, coupling.target);
    read_gripper(*this, table, description, coupling.target);
    read_pace(table, coupling);
  } else {
    for (const char* key : {"target", "delay", "speed", "gripper"}) table.find(key);
  }
  table.done();
  scene.couplings.push_back(std::move(coupling));
}

}  // namespace twinarm
