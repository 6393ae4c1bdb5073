// What `dynamics` and `simulate` both write: joint values by name, the base, the links.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/data/json_writer.h"
#include "app/robot/coordinates.h"
#include "solver/dynamics/kinematics.h"

namespace twinarm {

// {"j1": 0.1, "ball": [..]} of the joints' parts; rows as in the mass matrix.
void write_by_joint(JsonWriter& json, const Coordinates& coordinates, const Eigen::VectorXd& rows);
void write_coordinates(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
void write_velocities(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
// As in a state file, so that it can be read again.
void write_base(JsonWriter& json, const Coordinates& coordinates, const State<double>& x);
// Pose and velocity of every link of the robot.
void write_links(JsonWriter& json, const Model<double>& model, const Kinematics& k);

// w >= 0
Eigen::Vector4d quaternion_of(const Matrix3& R);  // w, x, y, z

// Names and units of joint values in tables and CSV.

// Of a column that holds values of all joints: "rad", "m", or "rad, m" where there are both.
struct JointUnits {
  std::string q, qd, qdd, tau;
  explicit JointUnits(const Coordinates& coordinates);
};

// Of the rows of the mass matrix: "j1", "ball/x", "base/vx".
std::vector<std::string> row_names(const Coordinates& coordinates);

// "base" for the joint that carries a floating root, else the joint's name; and which number of it.
std::string component_name(const Coordinates& coordinates, const NamedJoint& joint,
                           const JointComponent& component);

}  // namespace twinarm
