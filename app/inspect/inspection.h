// One state of one mechanism under named forces, and the quantities of its ABA passes.
//
// Accelerations come from one call of the aba() that all runs use, with FullTrace. `actors` lists
// the forces by name; the passes receive their sum.
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

// A named force: wrench, actuator, coupling, contact point or constraint. Its implicit parts depend
// on the acceleration: f - added_inertia a, tau - armature qdd.
struct AppliedForce {
  struct OnBody {
    std::size_t body;
    Force<double> f;  // body axes, about the body's origin
    ArticulatedInertia<double> added_inertia;
  };
  struct OnJoint {
    std::size_t dof;  // velocity index
    double tau = 0, armature = 0;
  };
  std::string source;  // as in the energy balance: "wrench/0", "coupling/NAME"
  std::vector<OnBody> bodies;
  std::vector<OnJoint> joints;
  // Point of application; normal of a contact, towards its second body.
  std::optional<Vector3> point_W{}, normal_W{};
  bool is_interaction = false;  // coupling, contact, constraint or wrench; not within a joint
  bool is_unique = true;        // false: other constraint forces give the same accelerations
};

// From what a force source has added to zero forces.
AppliedForce actor_of(std::string source, const Forces<double>& added);

Forces<double> sum_of(const Model<double>& model, const std::vector<AppliedForce>& actors);

struct Inspection {
  const Model<double>& model;
  State<double> x;
  std::vector<AppliedForce> actors;
  std::vector<LoopClosure> loops;  // closed by forces in `actors`; for the cross-check
  Forces<double> forces;           // sum of `actors`
  Kinematics k;
  Workspace<double> w;
  FullTrace<double> trace;

  // The model must outlive it.
  Inspection(const Model<double>& model, State<double> x, std::vector<AppliedForce> actors,
             std::vector<LoopClosure> loops = {});

  std::size_t body_count() const { return model.parent.size(); }
  std::size_t parent(std::size_t i) const { return static_cast<std::size_t>(model.parent[i]); }
  std::vector<std::size_t> children(std::size_t i) const;
  // Whether it is a descendant of the ancestor, or the same body.
  bool is_below(std::size_t body, std::size_t ancestor) const {
    while (body > ancestor) body = parent(body);
    return body == ancestor;
  }
  // p'' of the link's origin, world axes [m/s^2] (RBDA section 2.10).
  Vector3 origin_acceleration(std::size_t body) const;
  // At the acceleration of this state.
  Force<double> force_of(const AppliedForce::OnBody& on) const {
    return on.f - on.added_inertia * w.a[on.body];
  }
  double torque_of(const AppliedForce::OnJoint& on) const {
    return on.tau - on.armature * w.qdd[on.dof];
  }
};

// Quantities of the passes in the axes of the link frames of the robot's file.
//
// The passes use body axes B; some joints have other coordinates in the solver. Conversion:
//   motion, force   R_LB of both parts            inertia   R_LB of each 3 x 3 block
//   transform       R_LB E R_BL of the parent; translation in the parent's link axes
//   joint values    as on the command line: a floating joint has (v; w) in the axes of its frame in
//                   the parent, in the solver (w in the child's axes; v). T is orthogonal, so the
//                   quantities become S T, U T, T^T D T, T^T u, T^T qdd.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Frame in which a quantity is expressed: DisplayedQuantity::frame.
inline constexpr const char* kLinkFrame = "link axes, about the link's origin";
inline constexpr const char* kParentToLinkFrame = "from the parent's link axes to the link's";
inline constexpr const char* kJointFrame = "joint";

// Converts from body axes to link axes. Spatial vectors are columns, angular part first.
class LinkFrame {
 public:
  LinkFrame(const Model<double>& model, std::size_t body);

  Vector6 show(const Motion<double>& m) const {
    return (Vector6() << R_LB_ * to_eigen(m.w), R_LB_ * to_eigen(m.v)).finished();
  }
  Vector6 show(const Force<double>& f) const {
    return (Vector6() << R_LB_ * to_eigen(f.n), R_LB_ * to_eigen(f.f)).finished();
  }
  Matrix6 show(const ArticulatedInertia<double>& a) const;
  Matrix6 show(const Transform<double>& Xup) const;
  // E, rotation.
  Matrix3 rotation_from_parent(const Transform<double>& Xup) const {
    return R_LB_ * to_eigen(Xup.E) * R_PB_.transpose();
  }
  // r, parent's link axes [m].
  Vector3 translation_from_parent(const Transform<double>& Xup) const {
    return R_PB_ * to_eigen(Xup.r);
  }

 private:
  Matrix3 R_LB_, R_PB_;  // of the body, of its parent
};

// Converts joint quantities too.
class LinkAxes : public LinkFrame {
 public:
  LinkAxes(const Inspection& in, std::size_t body);

  // Of the body's joint, by its velocities.
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
  Eigen::MatrixXd T_;  // nv x nv: from velocities of the command line to those of the solver
};

// One quantity of one body: 1 x 1, 6 x 1, 6 x 6, or 6 x nv (S, U).
struct DisplayedQuantity {
  Quantity quantity;
  const char* frame;
  Eigen::MatrixXd value;
  std::string unit{};  // of a joint with one degree of freedom: its own of "angular; linear"
};
// Results of a pass (1 to 3) at a body, in the order of computation; pass 1 begins with the
// nonzero inputs.
std::vector<DisplayedQuantity> shown_quantities(const Inspection& in, int pass, std::size_t body);

// Of a unit "angular; linear" that of the body's joint, if it has one degree of freedom.
std::string unit_at_joint(const Model<double>& model, std::size_t body, const std::string& unit);

// Bias force p = v x* I v - f_ext.
Force<double> bias_force(const Inspection& in, std::size_t body);

// Which constraint forces the equations of motion determine. Constraint forces x enter as A x; if A
// has a null space, single forces are not unique (four corners of a resting block, redundant
// loops), though their sum on each body is.
class ConstraintUnknowns {
 public:
  // Unknowns of one force: `by_velocity` (nv, n) is the generalised force of each unit force. No
  // actor: it is only balanced against (mimic joints).
  void add(std::optional<std::size_t> actor, Eigen::MatrixXd by_velocity) {
    all_.push_back({actor, std::move(by_velocity)});
  }
  // Sets is_unique of the actors, by a QR factorization; beyond kMax unknowns it sets none.
  void mark(std::vector<AppliedForce>& actors) const;
  static constexpr Eigen::Index kMax = 300;

 private:
  struct Unknowns {
    std::optional<std::size_t> actor;
    Eigen::MatrixXd by_velocity;
  };
  std::vector<Unknowns> all_;
};

// Equations of the passes with their numbers, term by term (RBDA table 7.1).
//
// Terms are computed here by matrix products in link axes; the left side is aba()'s result, so the
// residual tests the passes. aba() does not store c, p and a': these are the sums of their terms.
// Cost O(children) of a body.

struct EquationTerm {
  std::string symbol;     // "Xup v_p"
  const char* words;      // meaning
  std::size_t of;         // body that contributes it
  Eigen::MatrixXd value;  // 6 x 1, 6 x 6, nv x 1, nv x nv, 6 x nv
  double size = 0;        // of a product: size of its factors, the scale of its rounding error
};

struct Equation {
  std::string name;  // of the left side: "v", "D qdd"
  std::string text;  // "v = Xup v_p + S qd"
  std::vector<EquationTerm> terms;
  Eigen::MatrixXd value;
  bool by_columns = false;  // 6 x nv, a column for each velocity of the joint
  double residual = 0;      // max |sum of terms - value|, relative to the largest size
};

// Of a pass (1 to 3) at a body, in the order of computation. Link axes, about the link's origin;
// joint values as on the command line.
std::vector<Equation> equations_of(const Inspection& in, int pass, std::size_t body);

}  // namespace twinarm
