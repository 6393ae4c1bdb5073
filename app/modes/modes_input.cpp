#include "app/modes/modes_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/data/text_table.h"
#include "app/scene/forces/add_contacts.h"

namespace twinarm {
namespace {

bool is_free_joint(const NamedJoint& joint) {
  return joint.type == JointType::free;
}

// Of the constraints that hold the scene, and the velocities that they allow.
std::vector<LoopClosure> take_loops(SimulateInput& input) {
  if (!input.scene || input.scene->constraints.empty()) return {};
  Simulation sim(input.robot.model, input.robot.state.x);
  const SceneContacts contacts(*input.scene, sim);
  input.robot.state.x = sim.state();
  return sim.mechanism().dynamics.bilateral().loops().loops();
}

// Bodies of the scene that a constraint holds; the rest of them has no joint to swing about.
std::vector<NamedJoint> held_bodies(const SimulateInput& input,
                                    const std::vector<LoopClosure>& loops) {
  std::set<int> bodies;
  for (const LoopClosure& loop : loops) bodies.insert({loop.body_a, loop.body_b});
  std::vector<NamedJoint> held;
  const Model<double>& model = input.robot.model;
  for (const int body : bodies) {
    const auto i = static_cast<std::size_t>(body);
    if (!input.scene || body <= input.scene->robot_bodies) continue;
    if (model.joint[i] == JointType::free)
      held.push_back({model.body_name[i], i, model.joint[i], 7, 6, model.iq[i], model.iv[i], 0});
  }
  return held;
}

// Of a joint's velocities in the solver's order: a free one has (w; v), w in the child's axes.
std::vector<std::string> names_of_velocities(const std::string& name, const NamedJoint& joint) {
  std::vector<std::string> names(joint.nv);
  for (const JointComponent& c : joint.components()) {
    if (c.v < 0) continue;
    const auto v = static_cast<std::size_t>(c.v);
    names[is_free_joint(joint) ? (v + 3) % 6 : v] = *c.label ? name + "/" + c.label : name;
  }
  return names;
}

std::vector<std::string> warnings_of(const SimulateInput& input,
                                     const std::vector<NamedJoint>& joints,
                                     const std::vector<double>& qdd) {
  std::vector<std::string> warnings = input.robot.warnings;
  const Model<double>& model = input.robot.model;
  const auto is_positive = [](double limit) { return limit > 0; };
  if (std::ranges::any_of(model.coulomb_plus, is_positive) ||
      std::ranges::any_of(model.coulomb_minus, is_positive))
    warnings.emplace_back("Coulomb friction of joints has no linear part: it is left out");
  if (input.scene && input.scene->may_touch())
    warnings.emplace_back(
        "contacts are left out, and free bodies that no constraint holds with them");
  constexpr double kStill = 1e-6;  // [rad/s^2, m/s^2]
  double fastest = 0;
  std::string where;
  for (const NamedJoint& joint : joints)
    for (std::size_t v = joint.iv; v < joint.iv + joint.nv; ++v)
      if (std::abs(qdd[v]) > fastest)
        fastest = std::abs(qdd[v]), where = name_of_part(input, joint);
  if (fastest > kStill)
    warnings.push_back(fmt::format(
        "the state is no equilibrium: '{}' accelerates by {} (rad, m)/s^2; the modes tell how a "
        "small departure from the motion grows at first",
        where, cell(fastest)));
  return warnings;
}

}  // namespace

SmoothPush::SmoothPush(SimulateInput& input)
    : input_(input),
      model_(input.robot.model),
      torques_(model_, input.robot.coordinates, input.robot.state.tau) {
  Kinematics k(model_);
  forward_kinematics(model_, input.robot.state.x, k);
  for (const Wrench& wrench : input.robot.state.wrenches) wrenches_.emplace_back(wrench, k);
}

void SmoothPush::operator()(const State<double>& x, const Kinematics& k, Forces<double>& forces) {
  torques_.add_forces(x, k, forces);
  for (GivenWrench& wrench : wrenches_) wrench.add_forces(x, k, forces);
  for (std::size_t dof = 0; dof < model_.nv; ++dof)
    forces.tau[dof] -= model_.damping[dof] * x.qd[dof];
  if (!input_.couplings) return;
  for (std::size_t c = 0; c < input_.couplings->size(); ++c)
    input_.couplings->hold_still(c, x, k, forces);
}

std::string name_of_part(const SimulateInput& input, const NamedJoint& joint) {
  const Coordinates& coordinates = input.robot.coordinates;
  const bool is_base = coordinates.floating() && joint.body == coordinates.base().body;
  return is_base ? "base" : joint.name;
}

std::vector<double> shape_part(const SimulateInput& input, const NamedJoint& joint,
                               const Eigen::VectorXd& by_velocity) {
  return from_solver(joint, input.robot.state.x,
                     {by_velocity.data(), by_velocity.data() + by_velocity.size()});
}

ModesOf find_modes(SimulateInput& input) {
  const std::vector<LoopClosure> loops = take_loops(input);
  ModesOf found;
  found.joints = input.robot.coordinates.all();
  for (NamedJoint& body : held_bodies(input, loops)) found.joints.push_back(std::move(body));
  const Model<double>& model = input.robot.model;
  std::vector<std::string> name_of(model.nv);
  for (const NamedJoint& joint : found.joints) {
    const std::vector<std::string> names = names_of_velocities(name_of_part(input, joint), joint);
    std::copy(names.begin(), names.end(), name_of.begin() + static_cast<std::ptrdiff_t>(joint.iv));
  }
  std::vector<char> is_follower(model.nv);
  for (const Mimic& mimic : model.mimics) is_follower[mimic.follower] = 1;
  std::vector<std::size_t> still;
  for (std::size_t dof = 0; dof < model.nv; ++dof)
    if (name_of[dof].empty() && !is_follower[dof]) still.push_back(dof);

  SmoothPush push(input);
  found.looped = linearise_with_loops(
      model, input.robot.state.x,
      [&](const State<double>& x, const Kinematics& k, Forces<double>& forces) {
        push(x, k, forces);
      },
      loops, still);
  if (!found.looped.system.A.allFinite())
    throw InputError(
        {{input.robot.robot.file.string(), 0, "",
          "the linear system is not finite in this state: there are no modes",
          "`twinarm inspect` shows what is not; give smaller numbers", "state.not-finite"}});
  for (const Mode& mode : modes_of(found.looped.system.A))
    found.modes.push_back(by_all_velocities(found.looped, mode));
  for (const std::size_t dof : found.looped.system.dofs) found.rows.push_back(name_of[dof]);
  found.warnings = warnings_of(input, found.joints, found.looped.qdd);
  return found;
}

}  // namespace twinarm
