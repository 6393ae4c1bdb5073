// Loop closures: bilateral constraints between two bodies, or between two joints.
//
// A Model is a tree. What closes a loop in it is a condition g(q, t) = 0 of m rows (RBDA
// section 8.2),
//   g' = J qd + (what prescribed joints do) = 0,      g'' = J qdd + gamma = 0,
// gamma = J' qd, with the accelerations of prescribed joints, is g'' at qdd = 0. Here g, g', J and
// gamma come from kinematics alone (loop_types.h); loop_forces.h solves with them for
// accelerations, loop_projection.h for positions and velocities.
//
// C is a frame on link a and another one on link b; where the loop is closed the two agree, in
// what the type asks for. Rows and their multipliers lambda, J^T lambda being the force:
//   ball      3  origins of C_a and C_b, in the axes of C_a      [m]    force on a at C_b [N]
//   hinge     5  ball, and z of C_b has no x, y in C_a     [rad]     couple on a about x, y [N m]
//   weld      6  ball, and the axes of C_a and C_b agree   [rad]     couple on a [N m]
//   distance  1  |p_Ca - p_Cb| - length                    [m]       force that drives them apart
//   gear      1  q_a - ratio q_b - offset, one dof each    [rad, m]  torque on joint a
//   locked    1  q_a - offset, a joint of one dof          [rad, m]  torque on joint a
// Rows hold the dofs between a and b alone; what both share drops out. Cost O(depth) a loop; no
// allocation after the constructor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// The list of the types. A new one is a line here and its struct in loop_types.h.
#define TWINARM_LOOPS(LOOP)    \
  LOOP(weld, WeldLoop)         \
  LOOP(ball, SphericalLoop)    \
  LOOP(hinge, RevoluteLoop)    \
  LOOP(distance, DistanceLoop) \
  LOOP(gear, GearLoop)         \
  LOOP(locked, LockedLoop)

#define TWINARM_LOOP_NAME(name, Loop) name,
enum class LoopType : unsigned char { TWINARM_LOOPS(TWINARM_LOOP_NAME) };
#undef TWINARM_LOOP_NAME
enum class LoopBetween : unsigned char { bodies, joints, one_joint };  // the last: a's alone
// The constants of a type's struct, for those who have its type at run time.
struct LoopTypeFacts {
  LoopType type;
  const char* name;
  std::size_t rows;
  LoopBetween ends;
  // g a second time, from the pose of C_b in C_a alone (between bodies; a distance: its length):
  // what a check differences that does not trust J and gamma. Same zeros and, there, same g''.
  Eigen::VectorXd (*g_of_pose)(const Pose& X_CaCb, double length);
};
std::span<const LoopTypeFacts> all_loop_types();
inline const LoopTypeFacts& facts_of(LoopType type) {
  return all_loop_types()[static_cast<std::size_t>(type)];
}

struct LoopClosure {
  std::string name;
  LoopType type = LoopType::ball;
  int body_a = 0, body_b = 0;    // 0: the world. gear: whose joints; locked: a's alone
  Pose X_LaC{}, X_LbC{};         // C in the axes of either link; a hinge turns about z of C
  double length = 0;             // of a distance [m]
  double ratio = 1, offset = 0;  // of a gear, and the place of a locked joint [rad, m]
};

// The wrench that a loop puts on link a at C_b (distance: at C_a), world axes; link b feels the
// opposite.
struct LoopWrench {
  Vector3 couple = Vector3::Zero();  // [N m]
  Vector3 force = Vector3::Zero();   // [N]
};

// What a loop keeps from one evaluation to the next.
struct LoopEnds {
  std::size_t first_row = 0;
  std::size_t shared = 0;              // velocities below this move both ends
  std::vector<std::size_t> dofs;       // of the others, on either side
  Matrix3 R_WC = Matrix3::Identity();  // axes of C_a
  Vector3 p_WC = Vector3::Zero();      // origin of C_b
  std::array<Vector3, 3> n;            // of the rotational rows, or the distance
};
using LoopJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class LoopClosures {
 public:
  LoopClosures() = default;  // none
  // Throws InputError with all faults (check_loops). The model must outlive it.
  LoopClosures(const Model<double>& model, std::vector<LoopClosure> loops);

  bool any() const { return !loops_.empty(); }
  const std::vector<LoopClosure>& loops() const { return loops_; }
  std::size_t rows() const { return loop_of_row_.size(); }
  std::size_t first_row(std::size_t loop) const { return ends_[loop].first_row; }
  std::size_t loop_of(std::size_t row) const { return loop_of_row_[row]; }
  // The velocities that a row depends on; J is zero in all others.
  const std::vector<std::size_t>& dofs_of(std::size_t row) const {
    return ends_[loop_of_row_[row]].dofs;
  }

  // Sets what follows at x, of which k is the kinematics.
  void evaluate(const State<double>& x, const Kinematics& k) noexcept;
  const Eigen::VectorXd& g() const { return g_; }
  const Eigen::VectorXd& rate() const { return rate_; }    // g'
  const Eigen::VectorXd& gamma() const { return gamma_; }  // g'' at qdd = 0
  const LoopJacobian& J() const { return J_; }
  // Where the force of a loop acts; of a distance any point of its line will do.
  const Vector3& point(std::size_t loop) const { return ends_[loop].p_WC; }
  // For lambda of all rows, where evaluate() was last.
  LoopWrench wrench(std::size_t loop, const Eigen::VectorXd& lambda) const;

 private:
  const Model<double>* model_ = nullptr;
  std::vector<LoopClosure> loops_;
  std::vector<LoopEnds> ends_;
  std::vector<std::size_t> loop_of_row_;
  Eigen::VectorXd g_, rate_, gamma_;
  LoopJacobian J_;
};

// What a start may be open by; the first step closes the rest [m, rad].
inline constexpr double kOpenAtStart = 1e-6;

// Throws one InputError with all faults: bodies that are not there, ends that cannot move against
// each other, frames that are none, lengths, joints of more than one dof, two loops that are the
// same.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops);
// The same, and which loops are open at x by more than kOpenAtStart.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                 const State<double>& x);

// Puts a mechanism together (loop_assembly.cpp): a state nearby in which its loops are closed. It
// comes from x by Gauss-Newton steps that are the shortest in the metric of M, each as long as it
// brings the loops nearer. Velocities go to the nearest that the loops allow. Followers go to their
// leaders. Closed to 1e-12, or to rounding where that is more.
// Throws InputError: loops that are no loops (check_loops), or that cannot be closed from there.
State<double> close_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                          State<double> x);

}  // namespace twinarm
