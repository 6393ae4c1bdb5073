// One state of one mechanism under named forces, and what aba() leaves of it.
//
// The acceleration is found once, by the aba() that all runs use, with FullTrace. Whoever pushes
// stands in a list by name; what the passes are given is the sum of the list.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "solver/dynamics/kinematics.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/field_description.h"
#include "solver/model/trace.h"
#include "solver/model/workspace.h"

namespace twinarm {

// One thing that pushes: a wrench, an actuator, a coupling, a contact point, a constraint. The
// implicit parts act against the acceleration that is found: f - impedance a, tau - armature qdd.
struct AppliedForce {
  struct OnBody {
    std::size_t body;
    Force<double> f;  // body axes, about the body's origin
    ArticulatedInertia<double> impedance;
  };
  struct OnJoint {
    std::size_t dof;  // velocity index
    double tau = 0, armature = 0;
  };
  std::string source;  // as in the ledger: "wrench/0", "coupling/NAME", "joint/NAME/damping"
  std::vector<OnBody> bodies;
  std::vector<OnJoint> joints;
  // Where it acts, if at a point; and the normal of a contact. World axes.
  std::optional<Vector3> point_W{}, normal_W{};
  bool is_tie = false;  // a coupling, contact, constraint or wrench; else it acts within a joint
};

// An actor of what a source of forces added to forces that were zero.
AppliedForce actor_of(std::string source, const Forces<double>& added);

struct Inspection {
  const Model<double>& model;
  State<double> x;
  std::vector<AppliedForce> actors;
  std::vector<LoopClosure> loops;  // that `actors` keep closed; for a check
  Forces<double> forces;           // their sum
  Kinematics k;
  Workspace<double> w;
  FullTrace<double> trace;

  // The model must outlive it.
  Inspection(const Model<double>& model, State<double> x, std::vector<AppliedForce> actors,
             std::vector<LoopClosure> loops = {});

  std::size_t body_count() const { return model.parent.size(); }
  std::size_t parent(std::size_t i) const { return static_cast<std::size_t>(model.parent[i]); }
  std::vector<std::size_t> children(std::size_t i) const;
  // What acts, at the acceleration that was found.
  Force<double> force_of(const AppliedForce::OnBody& on) const {
    return on.f - on.impedance * w.a[on.body];
  }
  double torque_of(const AppliedForce::OnJoint& on) const {
    return on.tau - on.armature * w.qdd[on.dof];
  }
};

// The quantities of the passes as users see them: in the axes of the link in their file.
//
// The passes work in body axes, B, and some joints in coordinates of the solver; here
//   motion, force   R_LB of both parts            inertia   R_LB of each 3 x 3 block
//   transform       R_LB E R_BL of the parent; its shift in the parent's link axes
//   joint values    as on the command line: a floating joint has (v; w) in the axes of its frame in
//                   the parent, where the solver has (w in the child's axes; v). T is orthogonal,
//                   so S T, U T, T^T D T, T^T u, T^T qdd.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Where the numbers of a quantity are to be read: Shown::frame.
inline constexpr const char* kLinkFrame = "link axes, about the link's origin";
inline constexpr const char* kParentToLinkFrame = "from the parent's link axes to the link's";
inline constexpr const char* kJointFrame = "joint";

// From the body axes of one body to its link's. Vectors of six are columns, angular part first.
class LinkFrame {
 public:
  LinkFrame(const Model<double>& model, std::size_t body);

  Vector6 show(const Motion<double>& m) const;
  Vector6 show(const Force<double>& f) const;
  Matrix6 show(const ArticulatedInertia<double>& a) const;
  Matrix6 show(const Transform<double>& X) const;               // Xup of the body
  Matrix3 turn_from_parent(const Transform<double>& X) const;   // E of it
  Vector3 shift_from_parent(const Transform<double>& X) const;  // r of it, parent's link axes [m]

 private:
  Matrix3 R_LB_, R_PB_;  // of the body, of its parent
};

// Also the values of its joint.
class LinkAxes : public LinkFrame {
 public:
  LinkAxes(const Inspection& in, std::size_t body);

  // Joint values of the body's joint: a vector by velocity; columns by velocity.
  Eigen::VectorXd joint(const std::vector<double>& by_velocity) const;
  Eigen::MatrixXd square(const std::vector<double>& D) const;
  template <class Six>
  Eigen::MatrixXd columns(const std::vector<Six>& by_velocity) const {
    Eigen::MatrixXd all(6, static_cast<Eigen::Index>(nv_));
    for (std::size_t k = 0; k < nv_; ++k)
      all.col(static_cast<Eigen::Index>(k)) = show(by_velocity[iv_ + k]);
    return all * T_;
  }
  std::size_t nv() const { return nv_; }

 private:
  const Inspection& in_;
  std::size_t body_, iv_, nv_;
  Eigen::MatrixXd T_;  // nv x nv: the solver's velocities of the command line's
};

// One quantity of one body. A number is 1 x 1, what has six parts 6 x 1; S and U are 6 x nv.
struct DisplayedQuantity {
  Quantity quantity;
  const char* frame;
  Eigen::MatrixXd value;
};
// What a pass (1 to 3) leaves of a body, in the order in which it is found; pass 1 begins with the
// inputs that are not zero.
std::vector<DisplayedQuantity> shown_quantities(const Inspection& in, int pass, std::size_t body);

// The force of the body alone, v x* I v - f_ext.
Force<double> own_force(const Inspection& in, std::size_t body);

}  // namespace twinarm
