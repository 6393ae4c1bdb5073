// What `twinarm modes` linearises: the state, all that pushes smoothly, and the loops that hold.
#pragma once

#include <string>
#include <vector>

#include "app/modes/linear_loops.h"
#include "app/run/simulate_input.h"
#include "app/scene/forces/given_forces.h"

namespace twinarm {

// Everything smooth that pushes: given torques and wrenches, dampers of joints, and couplings with
// their kinematic side held still.
class SmoothPush {
 public:
  explicit SmoothPush(SimulateInput& input);
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
  std::vector<NamedJoint> joints;  // of shapes: those of robots, then bodies that constraints hold
  std::vector<std::string> rows;   // of A: what dq is
  std::vector<std::string> warnings;
};
// At the state of the input, its velocities made such as the constraints allow.
ModesOf find_modes(SimulateInput& input);

// The mode's part of a joint's velocities, as the command line has them.
std::vector<double> shape_part(const SimulateInput& input, const NamedJoint& joint,
                               const Eigen::VectorXd& by_velocity);

// "base" for the joint that carries a floating root.
std::string name_of_part(const SimulateInput& input, const NamedJoint& joint);

std::string modes_json(const SimulateInput& input, const ModesOf& found);
std::string modes_table(const SimulateInput& input, const ModesOf& found);

}  // namespace twinarm
