// `twinarm modes`: linearisation of a robot or scene about its state, with its constraints.
#pragma once

#include <string>
#include <vector>

#include "app/modes/linear_system.h"
#include "app/run/simulate_input.h"
#include "app/scene/forces/given_forces.h"

namespace twinarm {

// Differentiable applied forces: given torques and wrenches, joint damping, and couplings with
// fixed targets.
class SmoothForces {
 public:
  explicit SmoothForces(SimulateInput& input);
  void operator()(const State<double>& x, const Kinematics& k, Forces<double>& forces);

 private:
  SimulateInput& input_;
  const Model<double>& model_;
  GivenTorques torques_;
  std::vector<GivenWrench> wrenches_;
};

struct ModesOf {
  LoopedSystem looped;
  std::vector<Mode> modes;         // by all velocities of the model
  std::vector<NamedJoint> joints;  // of shapes: those of robots, then bodies with constraints
  std::vector<std::string> rows;   // names of dq, the rows of A
  std::vector<std::string> warnings;
};
// At the state of the input, its velocities projected on the constraints.
ModesOf find_modes(SimulateInput& input);

// The mode's components of a joint's velocities, in the coordinates of the command line.
std::vector<double> shape_part(const SimulateInput& input, const NamedJoint& joint,
                               const Eigen::VectorXd& by_velocity);

// "base" for the free joint of a floating base.
std::string name_of_part(const SimulateInput& input, const NamedJoint& joint);

std::string modes_json(const SimulateInput& input, const ModesOf& found);
std::string modes_table(const SimulateInput& input, const ModesOf& found);

}  // namespace twinarm
