#include "app/scene/forces/given_forces.h"

namespace twinarm {

GivenWrench::GivenWrench(const Wrench& wrench, const Kinematics& start) : wrench_(wrench) {
  const Pose& X_WL = start.X_WL[wrench.body];
  p_L_ = wrench.in_link_axes ? wrench.point : X_WL.inverse() * wrench.point;
}

double GivenWrench::power(const Kinematics& k) const {
  const Wrench wrench = now(k);
  const Vector3 v = k.velocity(static_cast<int>(wrench.body), wrench.point);
  return wrench.force.dot(v) + wrench.torque.dot(k.w_WL[wrench.body]);
}

Wrench GivenWrench::now(const Kinematics& k) const {
  const Pose& X_WL = k.X_WL[wrench_.body];
  Wrench wrench = wrench_;
  wrench.in_link_axes = false;
  wrench.point = X_WL * p_L_;
  if (wrench_.in_link_axes) {
    wrench.force = X_WL.R * wrench_.force;
    wrench.torque = X_WL.R * wrench_.torque;
  }
  return wrench;
}

GivenForces::GivenForces(const RobotInput& input)
    : input_(input), springs_(input.springs), by_velocity_(input.model.nv) {
  const Kinematics start = kinematics_at(input.model, input.state.x);
  for (const Wrench& wrench : input.state.wrenches) wrenches_.emplace_back(wrench, start);
}

void GivenForces::add_forces(const State<double>& x, const Kinematics& k,
                             Forces<double>& forces) noexcept {
  for (const NamedJoint& joint : input_.coordinates.all())
    to_solver(joint, x, input_.state.tau.data() + joint.row, by_velocity_);
  for (std::size_t i = 0; i < by_velocity_.size(); ++i) forces.tau[i] += by_velocity_[i];
  for (const GivenWrench& wrench : wrenches_)
    forces.f_ext[wrench.body()] += in_body_axes(wrench.now(k), k);
  springs_.add_forces(x, k, forces);
}

}  // namespace twinarm
