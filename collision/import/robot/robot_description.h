// What a robot file says, as plain data: links, joints, what is drawn and what collides.
//
// Names, units and frames are those of the file brought to SI: metres, kilograms, radians. A link's
// frame L stands where its joint's child frame C is; the joint's frame stands at `X_PJ` in the
// parent link P. Inertias are about the centre of mass, in the axes of the link. Each item
// remembers its line in the file, so that whoever refuses it later can still say where it stands.
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

// A pose as URDF states it. The three angles are kept, and not the matrix that they make, so that
// a file that is read and written again has the same digits.
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
};

struct MeshGeometry {               // collision/import/robot/robot_model.h loads it
  std::filesystem::path file;       // absolute; empty where it was not found
  Vector3 scale = Vector3::Ones();  // metres per unit of the file, along its axes; < 0 mirrors
  std::string name;                 // as the robot's file calls it; may be empty
  bool convex = true;               // where it collides, its convex hull is meant
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
  std::string material;               // its name; may be empty
  Vector4 color{0.7, 0.7, 0.7, 1.0};  // red, green, blue, opacity in [0, 1]; times the texture
  std::string texture_name;           // as the file calls it; may be empty
  std::filesystem::path texture;      // absolute; empty for none, and where it was not found
};

struct LinkDescription {
  std::string name;
  int line = 0;
  int mass_line = 0;  // of the elements that state them; 0 where unknown
  int inertia_line = 0;
  bool has_inertia = false;  // false: a frame without mass; mass, com and inertia are zero
  double mass = 0;
  Vector3 com = Vector3::Zero();      // in the link frame
  Matrix3 inertia = Matrix3::Zero();  // about the com, in link axes
  std::vector<VisualPart> visuals;
  std::vector<CollisionPart> collisions;
};

struct JointDescription {
  // The solver's, with URDF's word for free; continuous: revolute, and never limited.
  enum class Type : unsigned char {
    TWINARM_JOINTS(TWINARM_JOINT_NAME) continuous,
    floating = free
  };

  struct Mimic {  // q = multiplier * (q of `joint`) + offset, at all times
    std::string joint;
    double multiplier = 1;
    double offset = 0;
  };

  // Where in the file the element stands that states it; 0 where unknown.
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
  Vector3 axis = Vector3::UnitX();  // unit length, in the joint frame; no meaning if !has_axis();
                                    // of a universal joint the first axis, of a planar the normal
  double pitch = 0;                 // [m per revolution], as files have it; screw only
  double lower = 0;                 // [rad] or [m]; may be infinite; see is_limited()
  double upper = 0;
  double effort = 0;         // these two are kept for other programs that read our files;
  double velocity = 0;       // nothing here uses them
  double damping = 0;        // viscous, of each dof [N m s/rad] or [N s/m]
  double friction = 0;       // Coulomb, as URDF states it, alike in both directions [N m] or [N]
  double armature = 0;       // rotor inertia seen at the joint [kg m^2] or [kg]
  double coulomb_plus = 0;   // Coulomb friction for qd > 0 and for qd < 0, both >= 0: equal to
  double coulomb_minus = 0;  // `friction` unless the <twinarm> element says otherwise. Use these.
  std::optional<Mimic> mimic;

  Pose X_PJ() const { return origin.pose(); }
  // A screw may have limits: it has where lower < upper.
  bool is_limited() const {
    constexpr double kNowhere = std::numeric_limits<double>::infinity();
    const bool nowhere = lower == -kNowhere && upper == kNowhere;
    return ((type == Type::revolute || type == Type::prismatic) && !nowhere) ||
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
  std::filesystem::path file;            // absolute; where the description came from
  std::vector<LinkDescription> links;    // in the order of the file
  std::vector<JointDescription> joints;  // in the order of the file
  std::string root;                      // the one link that is no joint's child
  // What was read but is suspicious, or has no effect here; in the order of the lines.
  std::vector<Diagnostic> warnings;
};

}  // namespace twinarm
