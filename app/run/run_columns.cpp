#include "app/run/run_columns.h"

#include "app/robot/robot_output.h"
#include "solver/dynamics/energy_momentum.h"

namespace twinarm {

std::vector<RunColumn> run_columns(const RobotInput& input) {
  std::vector<RunColumn> columns;
  const Coordinates& coordinates = input.coordinates;
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components()) {
      const std::string of = component_name(coordinates, joint, c);
      columns.push_back({"q/" + of, c.unit(), "coordinate", of});
    }
  for (const NamedJoint& joint : coordinates.all())
    for (const JointComponent& c : joint.components())
      if (c.v >= 0) {
        const std::string of = component_name(coordinates, joint, c);
        columns.push_back({"qd/" + of, c.is_angle ? "rad/s" : "m/s", "rate", of});
      }
  for (std::size_t i = 1; i < input.model.parent.size(); ++i)
    for (const char* axis : {"x", "y", "z"}) {
      const std::string& of = input.model.body_name[i];
      columns.push_back({"links/" + of + "/" + axis, "m", "position", of});
    }
  for (const std::string of : {"kinetic", "potential"})
    columns.push_back({of + "_energy", "J", "energy", of});
  return columns;
}

std::vector<double> run_values(const RobotInput& input, const State<double>& x,
                               const Kinematics& k) {
  std::vector<double> values;
  const auto add = [&](const auto& several) {
    values.insert(values.end(), several.begin(), several.end());
  };
  for (const NamedJoint& joint : input.coordinates.all()) add(coordinates_of(joint, x));
  for (const NamedJoint& joint : input.coordinates.all()) add(from_solver(joint, x, x.qd));
  for (std::size_t i = 1; i < input.model.parent.size(); ++i) add(k.X_WL[i].p);
  values.push_back(kinetic_energy(input.model, x));
  values.push_back(potential_energy(input.model, x));
  return values;
}

}  // namespace twinarm
