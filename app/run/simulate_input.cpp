#include "app/run/simulate_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/scene/forces/add_contacts.h"
#include "app/scene/read/change_scene.h"
#include "app/scene/read/read_scene.h"
#include "app/support/text.h"

namespace twinarm {
namespace {

constexpr double kRealTimeAccuracy = 1e-4;  // of impulses with a budget [m/s]

RunDefaults defaults_of(const SceneDescription& scene) {
  return {scene.duration, scene.step, scene.integrator.value_or(Integrator::semi_implicit),
          scene.contact == ContactMode::event};
}

void reject_robot_options(const RobotOptions& options, DiagnosticList& faults) {
  if (options.floating)
    faults.add("--floating", "applies to a URDF only", "write base = \"floating\" in [[robot]]",
               "option.useless");
  if (options.missing.any())
    faults.add("--density, --min-mass", "apply to a URDF only", "give mass and inertia in its file",
               "option.useless");
  if (options.strict)
    faults.add("--strict", "applies to a URDF only", "leave it out", "option.useless");
}

void check_discretizations(const SceneModel& scene, const RunPlan& plan, DiagnosticList& faults) {
  for (const SceneCoupling& coupling : scene.couplings) {
    if (!coupling.is_first_component()) continue;
    const auto fault = [&](std::string problem, std::string fix) {
      faults.add({scene.description.file.string(), coupling.line,
                  "coupling '" + coupling.coupling + "'", std::move(problem), std::move(fix),
                  "run.integrator"});
    };
    if (coupling.needs_semi_implicit() && !facts_of(plan.integrator).implicit_force)
      fault(std::string("an implicit coupling needs a semi-implicit integrator, not ") +
                integrator_name(plan.integrator),
            std::string(facts_of(coupling.law, coupling.printed).discretizations ==
                                    CouplingFacts::Discretizations::all &&
                                coupling.law != CouplingSpec::Type::weld
                            ? "give discretization = \"explicit\", or "
                            : "give ") +
                "--integrator semi-implicit");
    if (coupling.rate > 0 && plan.is_adaptive())
      fault("'rate' needs a fixed step", "leave it out, or change --integrator");
  }
}

// All joints of all robots, with their names in the scene.
RobotDescription all_robots(const SceneDescription& scene) {
  RobotDescription all;
  all.name = scene.file.stem().string();
  all.file = scene.file;
  for (std::size_t r = 0; r < scene.robots.size(); ++r)
    for (JointDescription joint : scene.robots[r].description.joints) {
      joint.name = name_in_scene(scene, r, joint.name);
      if (joint.mimic) joint.mimic->joint = name_in_scene(scene, r, joint.mimic->joint);
      all.joints.push_back(std::move(joint));
    }
  return all;
}

// A force on the axes of all joints below does no work.
void add_lever_warnings(const SceneModel& scene, std::vector<std::string>& warnings) {
  const Kinematics k = kinematics_at(scene.model, scene.start);
  for (const SceneCoupling& c : scene.couplings)
    if (const int body = c.spring.body;
        c.type == CouplingDescription::Type::linear &&
        point_jacobian(scene.model, k, body, k.position(body, c.spring.p_L)).norm() < 1e-9)
      warnings.push_back(
          fmt::format("coupling '{}' moves nothing: its point is on the axis of each joint that "
                      "moves '{}'; give a 'point' away from the axis",
                      c.coupling, scene.model.body_name[static_cast<std::size_t>(body)]));
}

SimulateInput scene_input(const SceneDescription& description, const SimulateOptions& options,
                          const RunPlan& plan, DiagnosticList& faults) {
  const RobotOptions& given = options.robot;
  ModelOptions model_options;
  model_options.friction = given.friction;
  model_options.armature = given.armature;
  auto scene = attempt(faults, [&] {
    return std::make_unique<SceneModel>(build_scene(description, model_options));
  });
  if (!scene) faults.check();
  const SceneModel& made = **scene;
  check_discretizations(made, plan, faults);
  check_contacts(made, plan.integrator, faults);

  const bool floating = description.robots.size() == 1 && description.robots[0].floating;
  const Coordinates coordinates(made.model, floating, made.robot_bodies);
  const RobotDescription robots = all_robots(description);
  GivenState state = default_state(made.model, coordinates);
  state.x = made.start;
  for (std::size_t r = 0; r < description.robots.size(); ++r)
    for (const auto& [name, given_torque] : description.robots[r].torque) {
      const NamedJoint& joint = *coordinates.find(name_in_scene(description, r, name));
      for (std::size_t k = 0; k < joint.nv; ++k)
        state.tau[static_cast<Eigen::Index>(joint.row + k)] = given_torque.values[k];
    }
  if (!given.state.empty())
    if (const auto json = attempt(faults, [&] { return read_json(given.state); }))
      state = read_state(*json, given.state, robots, made.model, coordinates, state, faults);
  auto couplings =
      attempt(faults, [&] { return std::make_unique<SceneCouplings>(made, plan.step); });
  faults.check();
  std::vector<std::string> warnings = made.description.warnings;
  if (!options.has_operator && std::ranges::any_of(made.couplings, [](const SceneCoupling& c) {
        return c.target.kind == CouplingTarget::Kind::device;
      }))
    warnings.push_back(
        "couplings with target = \"device\" stay at rest in this command; `twinarm hand` runs the "
        "scene with a device");
  add_lever_warnings(made, warnings);
  warnings.insert(warnings.end(), state.warnings.begin(), state.warnings.end());
  add_gravity_warning(made.model, warnings);
  return {{robots, made.model, coordinates, std::move(state), std::move(warnings), made.springs},
          std::move(*scene),
          std::move(*couplings)};
}

void add_step_warnings(const RunPlan& plan, std::vector<std::string>& warnings) {
  constexpr double kLongStep = 1;  // [s]
  if (plan.is_adaptive()) return;
  if (plan.step > kLongStep)
    warnings.push_back(
        fmt::format("the step is {:g} s; robots need steps of 0.0001 to 0.01 s", plan.step));
  if (plan.step > plan.duration * (1 + 1e-9))
    warnings.push_back(
        fmt::format("the run of {:g} s is shorter than the step of {:g} s: it is one step",
                    plan.duration, plan.step));
}

}  // namespace

Value scene_tree(const SimulateOptions& options, DiagnosticList& faults) {
  Value tree = options.scene ? *options.scene : read_toml(options.robot.model);
  for (const std::string& text : options.robot.changes) apply(parse_change(text), 0, tree, faults);
  return tree;
}

SimulatePlan prepare_simulation(const SimulateOptions& options) {
  DiagnosticList faults;
  if (options.robot.model.extension() != ".toml" && !options.scene) {
    const RunPlan plan = plan_run(options, {}, faults);
    if (!options.contact.empty())
      faults.add("--contact", "applies to a scene only", "give a scene", "option.useless");
    SimulatePlan prepared{{read_robot_input(options.robot, faults), nullptr, nullptr}, plan};
    add_step_warnings(plan, prepared.input.robot.warnings);
    return prepared;
  }
  reject_robot_options(options.robot, faults);
  auto description = attempt(faults, [&] {
    Value tree = scene_tree(options, faults);
    if (options.change_scene) options.change_scene(tree, faults);
    return read_scene(tree, options.robot.model, options.robot.roots);
  });
  if (!options.contact.empty()) {
    const auto mode = choose("--contact", options.contact, kContactModes, "possible", faults);
    if (mode && description) description->contact = static_cast<ContactMode>(*mode);
  }
  if (options.budget && description) {
    if (description->budget == 0) description->budget = *options.budget;
    description->accuracy = description->accuracy.value_or(kRealTimeAccuracy);
  }
  const RunPlan plan =
      plan_run(options, description ? defaults_of(*description) : RunDefaults{1.0}, faults);
  if (!options.robot.gravity.empty())
    if (const auto gravity = parse_gravity(options.robot.gravity, faults); gravity && description)
      description->gravity = *gravity;
  if (!description) faults.check();
  SimulatePlan prepared{scene_input(*description, options, plan, faults), plan};
  add_step_warnings(plan, prepared.input.robot.warnings);
  return prepared;
}

}  // namespace twinarm
