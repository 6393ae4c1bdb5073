// JSON of joint values by name, the base and the links; names and units for tables and CSV.
#pragma once

#include "app/data/json_writer.h"
#include "app/robot/coordinates.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

// {"j1": 0.1, "ball": [..]}; `rows` as in the mass matrix.
void write_by_joint(JsonWriter& json, const Coordinates& coordinates, const Eigen::VectorXd& rows);
void write_coordinates(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
void write_velocities(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
// As in a state file.
void write_base(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
// Pose and velocity of every link.
void write_links(JsonWriter& json, const Model<double>& model, const Kinematics& k);

Eigen::Vector4d quaternion_of(const Matrix3& R);  // w >= 0, x, y, z

// Units of a column with values of all joints: "rad", "m", or "rad, m".
struct JointUnits {
  std::string q, qd, qdd, tau;
  explicit JointUnits(const Coordinates& coordinates);
};

// Names of the rows of the mass matrix: "j1", "ball/x", "base/vx".
std::vector<std::string> row_names(const Coordinates& coordinates);

// Name of the joint ("base" for the floating base) and label of the component.
std::string component_name(const Coordinates& coordinates, const NamedJoint& joint,
                           const JointComponent& component);

}  // namespace twinarm
