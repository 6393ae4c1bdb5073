// From a robot's description to the solver's model.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "collision/import/robot_description.h"
#include "solver/model.h"

namespace twinarm {

// A particle fixed to a link: the paper's added masses (its Figure 5), a payload.
struct PointMass {
  std::string link;
  Vector3 p_L = Vector3::Zero();  // link axes, from the link's origin [m]
  double mass = 0;                // [kg]
};

struct ModelOptions {
  std::map<std::string, double> mass_scale;  // by link; scales mass and inertia
  std::vector<PointMass> added_masses;
};

// The root link stands on the world. Throws InputError, with the lines of the description, for
// what the solver cannot carry.
Model<double> build_model(const RobotDescription& robot, const ModelOptions& options = {});

BodyInertia plus_point_mass(const BodyInertia& body, const Vector3& p, double mass);

}  // namespace twinarm
