// The dynamics of a robot in one state, in the coordinates of coordinates.h.
#pragma once

#include "app/robot/robot_input.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

struct Dynamics {
  Eigen::VectorXd qdd;              // forward dynamics with tau and wrenches
  Eigen::VectorXd tau_inverse;      // inverse dynamics with the given qdd and wrenches
  Eigen::MatrixXd mass_matrix;      // M qdd + bias = tau; empty above kMaxDense
  Eigen::VectorXd bias, gravity;    // gravity: the bias at rest
  Vector3 base_force, base_torque;  // on the root link for the given qdd, about its origin, world
  double kinetic_energy = 0, potential_energy = 0, mass = 0;
  std::string first_bad;  // the first quantity of ABA that is not finite; may be empty
  Vector3 com, linear_momentum, angular_momentum;  // about the world's origin
};

Dynamics compute_dynamics(const RobotInput& input);

// The wrench in body axes about the body's origin, in the state of k.
Force<double> in_body_axes(const Wrench& wrench, const Kinematics& k);

// Sets the state. The points of wrenches in world axes move with their links.
void set_pose(RobotInput& input, const State<double>& x);

}  // namespace twinarm
