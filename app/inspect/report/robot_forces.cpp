#include "app/inspect/report/inspect_input.h"
#include "app/robot/dynamics.h"
#include "solver/loops/constrained_dynamics.h"

namespace twinarm {

void add_by_joint(const Model<double>& model, const std::vector<double>& tau,
                  const std::string& before, const std::string& after, std::vector<Actor>& actors) {
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    const std::string& joint = model.joint_name[i];
    Actor actor{before + (joint.empty() ? "base" : joint) + after, {}, {}};
    for (std::size_t dof = model.iv[i]; dof < model.iv[i] + model.dofs(i); ++dof)
      if (tau[dof] != 0) actor.joints.push_back({dof, tau[dof], 0});
    if (!actor.joints.empty()) actors.push_back(std::move(actor));
  }
}

std::vector<Actor> given_actors(const RobotInput& input) {
  std::vector<Actor> actors;
  std::vector<double> tau(input.model.nv);
  for (const NamedJoint& joint : input.coordinates.all())
    to_solver(joint, input.state.x, input.state.tau.data() + joint.row, tau);
  add_by_joint(input.model, tau, "actuator/", "", actors);
  Kinematics k(input.model);
  forward_kinematics(input.model, input.state.x, k);
  for (std::size_t i = 0; i < input.state.wrenches.size(); ++i) {
    const Wrench& wrench = input.state.wrenches[i];
    Actor actor{"wrench/" + std::to_string(i), {{wrench.body, in_body_axes(wrench, k), {}}}, {}};
    actor.is_tie = true;
    actor.point_W = wrench.in_link_axes ? k.X_WL[wrench.body] * wrench.point : wrench.point;
    actors.push_back(std::move(actor));
  }
  return actors;
}

Inspected inspect_robot(const RobotInput& input) {
  const Model<double>& model = input.model;
  Inspected inspected{input.state.x, given_actors(input), input.warnings, {}, {}};
  Forces<double> forces(model);
  for (const Actor& actor : inspected.actors) {
    for (const Actor::OnBody& on : actor.bodies) forces.f_ext[on.body] += on.f;
    for (const Actor::OnJoint& on : actor.joints) forces.tau[on.dof] += on.tau;
  }
  ForwardDynamics dynamics(model);
  Workspace<double> w(model);
  dynamics(inspected.x, forces, w);
  add_by_joint(model, dynamics.torques().damping, "joint/", "/damping", inspected.actors);
  add_by_joint(model, dynamics.torques().coulomb, "joint/", "/friction", inspected.actors);
  add_by_joint(model, dynamics.torques().mimic, "joint/", "/mimic", inspected.actors);
  return inspected;
}

}  // namespace twinarm
