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
#include <string>
#include <variant>
#include <vector>

#include "solver/pose.h"

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

struct BoxGeometry {
  Vector3 size = Vector3::Ones();  // full edges [m]
};
struct SphereGeometry {
  double radius = 1;
};
struct CylinderGeometry {  // axis z, centre at the origin
  double radius = 1;
  double length = 1;
};
struct CapsuleGeometry {  // axis z, centre at the origin
  double radius = 1;
  double length = 1;  // of the cylinder between the two half balls
};
struct MeshGeometry {
  std::filesystem::path file;  // absolute
  double scale = 1;            // metres per unit of the file
};
using PartGeometry =
    std::variant<BoxGeometry, SphereGeometry, CylinderGeometry, CapsuleGeometry, MeshGeometry>;

struct VisualPart {
  std::string name;
  int line = 0;
  Origin origin;
  PartGeometry geometry;
  std::string material;               // its name; may be empty
  Vector4 color{0.7, 0.7, 0.7, 1.0};  // red, green, blue, opacity in [0, 1]
  Pose X_LG() const { return origin.pose(); }
};

struct CollisionPart {  // a mesh here means its convex hull
  std::string name;
  int line = 0;
  Origin origin;
  PartGeometry geometry;
  Pose X_LG() const { return origin.pose(); }
};

struct LinkDescription {
  std::string name;
  int line = 0;
  int mass_line = 0;  // of the elements that state them; 0 where unknown
  int inertia_line = 0;
  bool has_inertia = false;  // false: mass, com and inertia are zero and mean nothing
  double mass = 0;
  Vector3 com = Vector3::Zero();      // in the link frame
  Matrix3 inertia = Matrix3::Zero();  // about the com, in link axes
  std::vector<VisualPart> visuals;
  std::vector<CollisionPart> collisions;
};

struct JointDescription {
  enum class Type { fixed, revolute, continuous, prismatic, floating };

  // Where in the file the element stands that states it; 0 where unknown.
  struct Lines {
    int parent = 0, child = 0, axis = 0, limits = 0, dynamics = 0, extension = 0;
  };

  std::string name;
  int line = 0;
  Lines lines;
  Type type = Type::fixed;
  std::string parent;
  std::string child;
  Origin origin;                    // of the joint (and child) frame in the parent link's frame
  Vector3 axis = Vector3::UnitX();  // unit length, in the joint frame; no meaning if fixed/floating
  double lower = 0;                 // [rad] or [m]; revolute and prismatic only
  double upper = 0;
  double effort = 0;         // these two are kept for other programs that read our files;
  double velocity = 0;       // nothing here uses them
  double damping = 0;        // viscous [N m s/rad] or [N s/m]
  double friction = 0;       // Coulomb, as URDF states it, alike in both directions [N m] or [N]
  double armature = 0;       // rotor inertia seen at the joint [kg m^2] or [kg]
  double coulomb_plus = 0;   // Coulomb friction for qd > 0 and for qd < 0, both >= 0: equal to
  double coulomb_minus = 0;  // `friction` unless the <twinarm> element says otherwise. Use these.

  Pose X_PJ() const { return origin.pose(); }
  bool is_limited() const { return type == Type::revolute || type == Type::prismatic; }
  bool has_axis() const { return type != Type::fixed && type != Type::floating; }
};

struct RobotDescription {
  std::string name;
  std::filesystem::path file;            // absolute; where the description came from
  std::vector<LinkDescription> links;    // in the order of the file
  std::vector<JointDescription> joints;  // in the order of the file
  std::string root;                      // the one link that is no joint's child
};

}  // namespace twinarm
