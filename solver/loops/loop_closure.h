// Loop closures: bilateral constraints between two bodies, or between two joints.
//
// A Model is a tree. A loop closure is a constraint g(q, t) = 0 with m rows (RBDA section 8.2),
//   g' = J qd + (velocity of prescribed joints) = 0,      g'' = J qdd + gamma = 0,
// where gamma is g'' at qdd = 0: J' qd and the accelerations of prescribed joints. g, g', J and
// gamma are computed from kinematics (loop_types.h); loop_forces.h solves for accelerations,
// loop_projection.h for positions and velocities.
//
// Frames C_a on link a and C_b on link b. Rows of g, and multipliers lambda (force J^T lambda):
//   ball      3  p_CaCb = 0, axes of C_a                   [m]       force on a at C_b [N]
//   hinge     5  ball, and z_b . x_a = z_b . y_a = 0       [rad]     couple on a about x, y [N m]
//   weld      6  ball, and the axes of C_a and C_b agree   [rad]     couple on a [N m]
//   prismatic 5  x, y of p_CaCb, and the axes agree        [m, rad]  force at C_b, couple on a
//   cylindrical 4  x, y of p_CaCb, and z_b . x_a = z_b . y_a = 0     likewise
//   universal 4  ball, and z_a . y_b = 0                   [rad]     couple on a about x [N m]
//   point_on_line 2, point_on_plane 1
//                x, y (z) of p_CaCb, axes of C_a           [m]       force on a at C_b [N]
//   distance  1  |p_Ca - p_Cb| - length                    [m]       repulsive force [N]
//   gear      1  q_a - ratio q_b - offset, one dof each    [rad, m]  joint force on a
//   locked    1  q_a - offset, one dof                     [rad, m]  joint force on a
//                with a motion q_a - f(t): a joint whose motion is prescribed
// J is nonzero only for dofs between a and b. Cost O(depth) per loop; no allocation after the
// constructor.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/expressions/expression_tape.h"
#include "solver/model/model.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// List of loop types. A new type is one line here and one struct in loop_types.h.
#define TWINARM_LOOPS(LOOP)              \
  LOOP(weld, WeldLoop)                   \
  LOOP(ball, SphericalLoop)              \
  LOOP(hinge, RevoluteLoop)              \
  LOOP(prismatic, PrismaticLoop)         \
  LOOP(cylindrical, CylindricalLoop)     \
  LOOP(universal, UniversalLoop)         \
  LOOP(point_on_line, PointOnLineLoop)   \
  LOOP(point_on_plane, PointOnPlaneLoop) \
  LOOP(distance, DistanceLoop)           \
  LOOP(gear, GearLoop)                   \
  LOOP(locked, LockedLoop)

#define TWINARM_LOOP_NAME(name, Loop) name,
enum class LoopType : unsigned char { TWINARM_LOOPS(TWINARM_LOOP_NAME) };
#undef TWINARM_LOOP_NAME
enum class LoopBetween : unsigned char { bodies, joints, one_joint };  // one_joint: of a
// Constants of a type's struct.
struct LoopTypeFacts {
  LoopType type;
  const char* name;
  std::size_t rows;
  LoopBetween ends;
  bool slides;  // the origins of C_a and C_b move relative to each other
  // Cross-check of g between bodies, from the pose of C_b in C_a (distance: and its length), to be
  // differentiated numerically. Same zeros and, there, same g''.
  Eigen::VectorXd (*g_of_pose)(const Pose& X_CaCb, double length);
};
std::span<const LoopTypeFacts> all_loop_types();
inline const LoopTypeFacts& facts_of(LoopType type) {
  return all_loop_types()[static_cast<std::size_t>(type)];
}

struct LoopClosure {
  std::string name;
  LoopType type = LoopType::ball;
  int body_a = 0, body_b = 0;    // 0: world. gear: child bodies of the joints; locked: of joint a
  Pose X_LaC{}, X_LbC{};         // C_a, C_b in the link frames; a hinge rotates about z
  double length = 0;             // distance [m]
  double ratio = 1, offset = 0;  // gear; locked: offset is the joint position [rad, m]
  std::optional<ExpressionTape> motion = std::nullopt;  // locked: f, f', f'' of t, for `offset`
  double offset_at(double t) const {
    return motion ? ExpressionTape(*motion)(std::array{t})[0] : offset;
  }
};

// Wrench of a loop on link a at C_b (distance: at C_a), world axes; the opposite acts on link b.
struct LoopWrench {
  Vector3 couple = Vector3::Zero();  // [N m]
  Vector3 force = Vector3::Zero();   // [N]
};

struct LoopEnds {
  std::size_t first_row = 0;
  std::size_t shared = 0;              // deepest body whose joints move both ends
  std::vector<std::size_t> dofs;       // velocities of one end only
  Matrix3 R_WC = Matrix3::Identity();  // axes of C_a
  Vector3 p_WC = Vector3::Zero();      // origin of C_b
  std::array<Vector3, 3> n;            // directions of the rotational rows, or of the distance
  std::array<double, 3> offset{};      // between joints: with its first and second derivative
};
using LoopJacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

class LoopClosures {
 public:
  LoopClosures() = default;
  // Throws InputError (check_loops). The model must outlive it.
  LoopClosures(const Model<double>& model, std::vector<LoopClosure> loops);

  bool any() const { return !loops_.empty(); }
  const std::vector<LoopClosure>& loops() const { return loops_; }
  std::size_t rows() const { return loop_of_row_.size(); }
  std::size_t first_row(std::size_t loop) const { return ends_[loop].first_row; }
  std::size_t loop_of(std::size_t row) const { return loop_of_row_[row]; }
  // Velocities with nonzero entries of J in this row.
  const std::vector<std::size_t>& dofs_of(std::size_t row) const {
    return ends_[loop_of_row_[row]].dofs;
  }

  // Computes the following quantities at x; k: kinematics of x.
  void evaluate(const State<double>& x, const Kinematics& k) noexcept;
  const Eigen::VectorXd& g() const { return g_; }
  const Eigen::VectorXd& rate() const { return rate_; }    // g'
  const Eigen::VectorXd& gamma() const { return gamma_; }  // g'' at qdd = 0
  const LoopJacobian& J() const { return J_; }
  // Point of application of a loop's force.
  const Vector3& point(std::size_t loop) const { return ends_[loop].p_WC; }
  // For lambda of all rows, at the state of the last evaluate().
  LoopWrench wrench(std::size_t loop, const Eigen::VectorXd& lambda) const;

 private:
  const Model<double>* model_ = nullptr;
  std::vector<LoopClosure> loops_;
  std::vector<LoopEnds> ends_;
  std::vector<std::size_t> loop_of_row_;
  Eigen::VectorXd g_, rate_, gamma_;
  LoopJacobian J_;
};

// Allowed position error of loops in the initial state [m, rad]; removed by the first projection.
inline constexpr double kMaxInitialError = 1e-6;

// Bound on constraint rows x velocities: the size of J, which is dense, and of the factors if all
// loops overlap (together 1 GiB).
inline constexpr std::size_t kMaxLoopEntries = 2400000;

// Throws one InputError with all errors: more entries than kMaxLoopEntries, body indices, ends
// without a joint between them, frames, lengths, joints with more than one degree of freedom,
// duplicate loops.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops);
// The same, and position errors above kMaxInitialError at x.
void check_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                 const State<double>& x);

// Assembly (loop_assembly.cpp): a state near x with closed loops, by Gauss-Newton steps of minimum
// norm in the metric of M with a line search. Velocities are projected, mimic joints set. Position
// error 1e-12, or rounding. Throws InputError for invalid loops (check_loops), and if the iteration
// does not converge.
State<double> close_loops(const Model<double>& model, const std::vector<LoopClosure>& loops,
                          State<double> x);

}  // namespace twinarm
