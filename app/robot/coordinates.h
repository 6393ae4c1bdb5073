// Joint values as people and files have them (docs/reference/state_file.md), and the way to the
// solver's.
//
// Each joint that is neither fixed nor a follower (URDF's mimic) is named once, in the order of the
// model. Its values are those of the solver, but for joints of six degrees of freedom (URDF's
// floating, and the base where the root floats), whose velocity is
//   here    (v, w)    v of the child's origin, w; both in the axes of the joint's frame in the
//   parent solver  (E w, v)  the angular velocity in the child's axes, E = R_CP
// The map between them, T, is orthogonal, so forces go by the same T. Accelerations too: T' qd is
// E' w = -(E w) x (E w) = 0. Followers come in through G (solver/model/mimic.h), which is constant.
// So with qd_solver = P qd, P = G T, nothing but P is needed:
//   M = P^T M_solver P,   bias = P^T bias_solver,   qdd_solver = P qdd,   tau = P^T tau_solver.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "app/data/table_reader.h"
#include "collision/import/robot/robot_description.h"
#include "solver/model/model.h"

namespace twinarm {

// One number of q and what moves it; labels and units for tables and CSV.
struct JointComponent {
  const char* label;   // "" where the joint has one number
  int q = -1, v = -1;  // which of the joint's coordinates and velocities; -1: none
  bool is_angle = true;
  bool is_quaternion = false;

  const char* unit() const { return is_quaternion ? "1" : is_angle ? "rad" : "m"; }
};

struct NamedJoint {
  std::string name;
  std::size_t body;  // that it carries
  JointType type;
  std::size_t nq, nv;
  std::size_t iq, iv;  // of the solver
  std::size_t row;     // of the mass matrix: its first

  std::vector<JointComponent> components() const;
};

class Coordinates {
 public:
  Coordinates(const Model<double>& model, bool floating)
      : Coordinates(model, floating, model.body_count() - 1) {}
  // Of the joints of bodies 1 .. last alone; those after them have no joint values to be named.
  Coordinates(const Model<double>& model, bool floating, int last);

  const std::vector<NamedJoint>& all() const { return all_; }  // the base first, where it floats
  bool floating() const { return floating_; }
  const NamedJoint& base() const { return all_.front(); }  // of a floating robot
  std::size_t first_joint() const { return floating_ ? 1 : 0; }
  const NamedJoint* find(const std::string& name) const;  // among the joints; the base is none
  std::vector<std::string> names() const;                 // of the joints, without the base
  Eigen::Index rows() const { return rows_; }

  Eigen::MatrixXd P(const Model<double>& model, const State<double>& x) const;

 private:
  bool floating_;
  std::vector<NamedJoint> all_;
  Eigen::Index rows_ = 0;
};

std::vector<double> coordinates_of(const NamedJoint& joint, const State<double>& x);
// The joint's part of a velocity, acceleration or force by the solver's velocities; and back.
std::vector<double> from_solver(const NamedJoint& joint, const State<double>& x,
                                const std::vector<double>& by_velocity);
void to_solver(const NamedJoint& joint, const State<double>& x, const double* values,
               std::vector<double>& by_velocity);

// Coordinates and velocities of joints by name, as scenes and state files give them
// (docs/reference/state_file.md).
struct JointValues {
  std::vector<double> values;
  int line = 0;
};
using JointValueMap = std::map<std::string, JointValues>;

enum class JointRows { coordinates, velocities };

// Of each joint that is named: as many numbers as it has coordinates or velocities, quaternions of
// length 1. Faults for the others. `warnings`: where a quaternion was off by more than rounding.
JointValueMap read_joint_values(TableReader& joints, const RobotDescription& robot, JointRows rows,
                                std::vector<std::string>* warnings = nullptr);

// A quaternion in place: its length brought to 1, or a fault.
void normalise(TableReader& table, const std::string& key, std::span<double, 4> q,
               std::vector<std::string>* warnings);

}  // namespace twinarm
