// A robot file as plain data: links, joints, visual and collision shapes.
//
// SI units, names and frames of the file. A link's frame L coincides with its joint's child frame
// C; the joint's frame is at X_PJ in the parent link P. Inertias are about the centre of mass, in
// link axes. Each item has its line in the file for diagnostics.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "collision/shapes/shape.h"
#include "solver/model/joint.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

using Vector4 = Eigen::Vector4d;

// A pose as in URDF. The angles are stored so that a file that is read and written again has the
// same digits.
struct Origin {
  Vector3 xyz = Vector3::Zero();
  Vector3 rpy = Vector3::Zero();  // about the fixed axes x, y, z, in this order

  // R = Rz(yaw) Ry(pitch) Rx(roll)
  Pose pose() const {
    if (rpy.isZero(0.0)) return {Matrix3::Identity(), xyz};  // exactly, without -0
    const double cr = std::cos(rpy.x()), sr = std::sin(rpy.x());
    const double cp = std::cos(rpy.y()), sp = std::sin(rpy.y());
    const double cy = std::cos(rpy.z()), sy = std::sin(rpy.z());
    Matrix3 R;
    R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
        -sp, cp * sr, cp * cr;
    return {R, xyz};
  }
  // Angles of R; at a pitch of +-90 degrees without roll.
  void turn_to(const Matrix3& R) {
    const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
    const double pitch = std::atan2(-R(2, 0), cos_pitch);
    if (cos_pitch < 1e-12)
      rpy = {0, pitch, std::atan2(-R(0, 1), R(1, 1))};
    else
      rpy = {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
  }
};

struct MeshGeometry {               // loaded by collision/import/robot/robot_model.h
  std::filesystem::path file;       // absolute; empty if not found
  Vector3 scale = Vector3::Ones();  // metres per unit of the file, by axis; < 0 mirrors
  std::string name;                 // as in the robot's file; may be empty
  bool convex = true;               // collision shape: its convex hull
};
using ShapeDescription = AnyShape<MeshGeometry>;

struct CollisionPart {
  std::string name;
  int line = 0;
  Origin origin;
  ShapeDescription geometry;
  Pose X_LG() const { return origin.pose(); }
};

struct VisualPart : CollisionPart {
  std::string material;               // may be empty
  Vector4 color{0.7, 0.7, 0.7, 1.0};  // red, green, blue, opacity in [0, 1]; times the texture
  std::string texture_name;           // as in the file; may be empty
  std::filesystem::path texture;      // absolute; empty without texture or if not found
};

struct LinkDescription {
  std::string name;
  int line = 0;
  int mass_line = 0;  // of the elements; 0: unknown
  int inertia_line = 0;
  bool has_inertia = false;  // false: a frame; mass, com and inertia are zero
  double mass = 0;
  Vector3 com = Vector3::Zero();      // in the link frame
  Matrix3 inertia = Matrix3::Zero();  // about the com, in link axes
  std::vector<VisualPart> visuals;
  std::vector<CollisionPart> collisions;
};

struct JointDescription {
  // The solver's, with URDF's names: floating = free; continuous = revolute without limits.
  enum class Type : unsigned char {
    TWINARM_JOINTS(TWINARM_JOINT_NAME) continuous,
    floating = free
  };

  struct Mimic {  // q = multiplier * (q of `joint`) + offset, at all times
    std::string joint;
    double multiplier = 1;
    double offset = 0;
  };

  // Lines of the elements in the file; 0: unknown.
  struct Lines {
    int parent = 0, child = 0, axis = 0, limits = 0, dynamics = 0, extension = 0, mimic = 0;
  };

  std::string name;
  int line = 0;
  Lines lines;
  Type type = Type::fixed;
  std::string parent;
  std::string child;
  Origin origin;                    // of the joint (and child) frame in the parent link's frame
  Vector3 axis = Vector3::UnitX();  // unit, joint frame; unused if !has_axis(); universal joint:
                                    // first axis, planar joint: normal
  double pitch = 0;                 // screw only [m per revolution]
  double lower = 0;                 // [rad] or [m]; may be infinite; see is_limited()
  double upper = 0;
  double effort = 0;         // not used here; kept for other programs
  double velocity = 0;       // likewise
  double damping = 0;        // viscous, of each dof [N m s/rad] or [N s/m]
  double friction = 0;       // URDF's Coulomb friction, both directions [N m] or [N]
  double armature = 0;       // rotor inertia at the joint [kg m^2] or [kg]
  double coulomb_plus = 0;   // Coulomb friction for qd > 0 and qd < 0, >= 0: `friction` unless
  double coulomb_minus = 0;  // the <twinarm> element overrides it. Used by the model.
  std::optional<Mimic> mimic;

  Pose X_PJ() const { return origin.pose(); }
  // A screw is limited if lower < upper.
  bool is_limited() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const bool unbounded = lower == -kInfinity && upper == kInfinity;
    return ((type == Type::revolute || type == Type::prismatic) && !unbounded) ||
           (type == Type::screw && lower < upper);
  }
  bool has_axis() const { return facts().axis != AxisUse::none; }
  int dofs() const { return static_cast<int>(facts().nv); }
  JointFacts facts() const { return facts_of(joint_type()); }
  JointType joint_type() const { return joint_type(type); }
  static constexpr JointType joint_type(Type of) {
    return of == Type::continuous ? JointType::revolute : static_cast<JointType>(of);
  }
};

struct RobotDescription {
  std::string name;
  std::filesystem::path file;            // absolute
  std::vector<LinkDescription> links;    // in the order of the file
  std::vector<JointDescription> joints;  // in the order of the file
  std::string root;                      // root link
  std::vector<Diagnostic> warnings;      // in the order of the lines
};

}  // namespace twinarm
