// The dynamics of a robot at one state, in the coordinates of the command line.
#pragma once

#include <Eigen/Core>

#include "app/robot/robot_input.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/workspace.h"

namespace twinarm {

struct Dynamics {
  Eigen::VectorXd qdd;            // forward, under tau and the wrenches; by rows, the base's first
  Eigen::VectorXd tau_inverse;    // for the given qdd, under the wrenches; the same rows
  Eigen::MatrixXd mass_matrix;    //   M qdd + bias = generalised force
  Eigen::VectorXd bias, gravity;  // gravity: the bias at rest
  Vector3 base_force, base_torque;  // on the root link for the given qdd, about its origin, world
  double kinetic_energy = 0, potential_energy = 0, mass = 0;
  std::string first_bad;  // what is not finite first in the order of the passes; empty: nothing
  Vector3 com, linear_momentum, angular_momentum;  // the latter about the world's origin
};

Dynamics compute_dynamics(const RobotInput& input);

// A wrench in body axes about the body's origin, as the passes have it; `point` and axes as the
// wrench says, in the state that k belongs to.
Force<double> in_body_axes(const Wrench& wrench, const Kinematics& k);

// The state is x from now on. A wrench in world axes acts on the point of its link that stood at
// its point before, and goes along.
void set_pose(RobotInput& input, const State<double>& x);

}  // namespace twinarm
