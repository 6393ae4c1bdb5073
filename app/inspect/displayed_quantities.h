// The quantities of the passes as users see them: in the axes of the link in their file.
//
// The passes work in body axes, B, and some joints in coordinates of the solver; here
//   motion, force   R_LB of both parts            inertia   R_LB of each 3 x 3 block
//   transform       R_LB E R_BL of the parent; its shift in the parent's link axes
//   joint values    as on the command line: a floating joint has (v; w) in the axes of its frame in
//                   the parent, where the solver has (w in the child's axes; v). T is orthogonal,
//                   so S T, U T, T^T D T, T^T u, T^T qdd.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"
#include "solver/model/field_description.h"

namespace twinarm {

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
struct Shown {
  Quantity quantity;
  const char* frame;
  Eigen::MatrixXd value;
};
// What a pass (1 to 3) leaves of a body, in the order in which it is found; pass 1 begins with the
// inputs that are not zero.
std::vector<Shown> shown_quantities(const Inspection& in, int pass, std::size_t body);

// The force of the body alone, v x* I v - f_ext.
Force<double> own_force(const Inspection& in, std::size_t body);

}  // namespace twinarm
