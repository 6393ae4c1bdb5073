// What `dynamics` and `simulate` both write: joint values by name, the base, the links.
#pragma once

#include <Eigen/Core>

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

}  // namespace twinarm
