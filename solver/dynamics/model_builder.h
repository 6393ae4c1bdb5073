// Builds and checks a Model: bodies are added one by one, parents before children.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "solver/model/model.h"
#include "solver/spatial/pose.h"
#include "solver/support/diagnostics.h"

namespace twinarm {

// Mass, centre of mass and rotational inertia about it, link axes, SI units. The importer, not the
// builder, warns of inertias that violate the triangle inequality.
struct BodyInertia {
  double mass = 0;
  Vector3 com = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();
};

// The same values for every degree of freedom of a joint.
struct JointProperties {
  double pitch = 0;                            // of a screw [m/rad]
  double armature = 0;                         // [kg m^2, kg]
  double damping = 0;                          // [N m s/rad, N s/m]
  double coulomb_plus = 0, coulomb_minus = 0;  // [N m, N]
};

// Diagnostic::where of the errors of build(); readers map it to file and line.
std::string link_called(const std::string& name);
std::string joint_called(const std::string& name);

// Fills what follows from names, parents and joints: by_body_name, by_joint_name, last_child,
// chain_first, is_deep.
void complete_tree(ModelTree& tree);

class ModelBuilder {
 public:
  // X_PJ: pose of the joint frame in the parent's link frame; at the joint's identity the new link
  // frame coincides with it. `axis`, link axes, nonzero: axis of a revolute, prismatic, screw or
  // cylindrical joint; normal of a planar joint, whose x is the link's x under the shortest
  // rotation from z to the axis; first axis of a universal joint, whose second is y under that
  // rotation. Other joints ignore it. Returns the body's index.
  int add_body(const std::string& body_name, int parent, const std::string& joint_name,
               JointType type, const Pose& X_PJ, const Vector3& axis, const BodyInertia& inertia,
               const JointProperties& properties = {}) {
    bodies_.push_back({body_name, joint_name, parent, type, X_PJ, axis, inertia, properties});
    return static_cast<int>(bodies_.size());
  }
  // q of `follower` = ratio * (q of `leader`) + offset; both joints have one degree of freedom.
  // Chains of mimic joints are resolved: the model refers to the independent joint. At most
  // kMaxMimics, since forward dynamics has a dense row of nv entries for each.
  static constexpr std::size_t kMaxMimics = 1000;
  void add_mimic(const std::string& follower, const std::string& leader, double ratio,
                 double offset) {
    mimics_.push_back({follower, leader, ratio, offset});
  }
  void set_gravity(const Vector3& g_W) { gravity_ = g_W; }

  // Throws one InputError with all errors, including joints with zero articulated inertia; in a
  // kinematic model, of which no dynamics is computed, these get an armature of 1 instead.
  Model<double> build(bool kinematic = false) const;

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
  static void check(const Body& body, int index, Names& names, DiagnosticList& faults);
  static void append(const Body& body, Model<double>& model, std::vector<Matrix3>& R_LB);
  void add_mimics_to(Model<double>& model, DiagnosticList& faults) const;

  std::vector<Body> bodies_;
  std::vector<MimicByName> mimics_;
  Vector3 gravity_{0, 0, -9.81};
};

}  // namespace twinarm
