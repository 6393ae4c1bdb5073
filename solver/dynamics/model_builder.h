// Makes a Model: adds bodies one by one, a parent before its children, and checks everything.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "solver/model/model.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Mass, centre of mass and rotational inertia about it, in link axes, SI. Taken as it is: an
// inertia that no body has (A + B < C) is the importer's to warn of.
struct BodyInertia {
  double mass = 0;
  Vector3 com = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

// Of every dof of a joint.
struct JointProperties {
  double pitch = 0;                            // of a screw [m/rad]
  double armature = 0;                         // [kg m^2, kg]
  double damping = 0;                          // [N m s/rad, N s/m]
  double coulomb_plus = 0, coulomb_minus = 0;  // [N m, N]
};

// Fault::where of what build() finds: who knows files and lines looks for it by these.
std::string link_called(const std::string& name);
std::string joint_called(const std::string& name);

class ModelBuilder {
 public:
  // Places joint `joint_name` at X_PJ in the parent's link frame; at the joint's identity the new
  // link's frame coincides with it. `axis` in link axes, any length but zero: of revolute,
  // prismatic, screw and cylindrical joints; the normal of a planar joint, whose x is the link's x
  // turned by the shortest rotation that takes z to the axis; the first axis of a universal joint,
  // whose second is y turned likewise. Unused by the others. Returns the body's index.
  int add_body(const std::string& body_name, int parent, const std::string& joint_name,
               JointType type, const Pose& X_PJ, const Vector3& axis, const BodyInertia& inertia,
               const JointProperties& properties = {});
  // The follower's joint keeps q = ratio * (leader's q) + offset; both have one dof. The leader may
  // itself follow: what the model gets is resolved to the first leader.
  void add_mimic(const std::string& follower, const std::string& leader, double ratio,
                 double offset);
  void set_gravity(const Vector3& g_W) { gravity_ = g_W; }

  // Throws ONE InputError that lists all faults; among them joints about which the bodies that they
  // move have no inertia, for which there is no acceleration.
  Model<double> build() const;

 private:
  struct Body {
    std::string name, joint_name;
    int parent;
    JointType type;
    Pose X_PJ;
    Vector3 axis;
    BodyInertia inertia;
    JointProperties properties;
  };
  struct MimicByName {
    std::string follower, leader;
    double ratio, offset;
  };
  struct Names {
    std::unordered_set<std::string> links, joints;
  };
  static void check(const Body& body, int index, Names& taken, DiagnosticList& faults);
  static void append(const Body& body, Model<double>& model, std::vector<Matrix3>& R_LB);
  void add_mimics_to(Model<double>& model, DiagnosticList& faults) const;

  std::vector<Body> bodies_;
  std::vector<MimicByName> mimics_;
  Vector3 gravity_{0, 0, -9.81};
};

}  // namespace twinarm
