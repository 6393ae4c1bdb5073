// Joint values as in files and output (docs/reference/state_file.md), and their conversion to
// the solver's.
//
// Each joint that is neither fixed nor a mimic joint is listed once, in the order of the model. Its
// values are those of the solver, except the velocities of joints with six degrees of freedom
// (URDF's floating joint, and the floating base):
//
//   files and output  (v, w)    velocity of the child's origin, angular velocity; both in the axes
//                               of the joint's frame in the parent
//   solver            (E w, v)  angular velocity in the child's axes, E = R_CP, first
//
// The map T between them is orthogonal, so forces transform by the same T. So do accelerations:
// T' qd is E' w = -(E w) x (E w) = 0. Mimic joints come in through the constant matrix G
// (solver/model/mimic.h). With qd_solver = P qd, P = G T:
//
//   M = P^T M_solver P    bias = P^T bias_solver    qdd_solver = P qdd    tau = P^T tau_solver
#pragma once

#include <Eigen/SparseCore>
#include <map>
#include <string>
#include <vector>

#include "app/data/table_reader.h"
#include "collision/import/robot/robot_description.h"
#include "solver/model/model.h"

namespace twinarm {

// One coordinate of a joint and its velocity, with label and unit for tables and CSV.
struct JointComponent {
  const char* label;   // "" if the joint has one coordinate
  int q = -1, v = -1;  // indices among the joint's coordinates and velocities; -1: none
  bool is_angle = true;
  bool is_quaternion = false;

  const char* unit() const { return is_quaternion ? "1" : is_angle ? "rad" : "m"; }
};

struct NamedJoint {
  std::string name;
  std::size_t body;  // its child
  JointType type;
  std::size_t nq, nv;
  std::size_t iq, iv;  // in the solver's vectors
  std::size_t row;     // its first row of the mass matrix

  std::vector<JointComponent> components() const;
};

class Coordinates {
 public:
  Coordinates(const Model<double>& model, bool floating)
      : Coordinates(model, floating, model.body_count() - 1) {}
  // Joints of bodies 1 .. last only.
  Coordinates(const Model<double>& model, bool floating, int last);

  const std::vector<NamedJoint>& all() const { return all_; }  // a floating base first
  bool floating() const { return floating_; }
  const NamedJoint& base() const { return all_.front(); }  // of a floating robot
  std::size_t first_joint() const { return floating_ ? 1 : 0; }
  const NamedJoint* find(const std::string& name) const;  // without the base
  std::vector<std::string> names() const;                 // without the base
  Eigen::Index rows() const { return rows_; }

  Eigen::SparseMatrix<double> P(const Model<double>& model, const State<double>& x) const;

 private:
  bool floating_;
  std::vector<NamedJoint> all_;
  Eigen::Index rows_ = 0;
};

std::vector<double> coordinates_of(const NamedJoint& joint, const State<double>& x);
// The joint's part of a velocity, acceleration or force vector of the solver; and back.
std::vector<double> from_solver(const NamedJoint& joint, const State<double>& x,
                                const std::vector<double>& by_velocity);
void to_solver(const NamedJoint& joint, const State<double>& x, const double* values,
               std::vector<double>& by_velocity);

// Coordinates or velocities of joints by name, as in scenes and state files.
struct JointValues {
  std::vector<double> values;
  int line = 0;
};
using JointValueMap = std::map<std::string, JointValues>;

enum class JointRows { coordinates, velocities };

// For each joint as many numbers as it has coordinates or velocities; quaternions are normalised,
// with a warning if their length differs by more than rounding.
JointValueMap read_joint_values(TableReader& joints, const RobotDescription& robot, JointRows rows,
                                std::vector<std::string>* warnings = nullptr);

// Normalises a quaternion, or adds a diagnostic.
void normalise(TableReader& table, const std::string& key, std::span<double, 4> q,
               std::vector<std::string>* warnings);

}  // namespace twinarm
