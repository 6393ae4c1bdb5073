// The same mechanism by CRBA and RNEA, implicit terms included:
//   M = M_crba + sum J^T impedance J + armature,   h = RNEA at qdd = 0 with f - impedance a_0.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "app/inspect/inspection.h"

namespace twinarm {

class SecondWay {
 public:
  explicit SecondWay(const Inspection& in);

  const Eigen::MatrixXd& M() const { return M_; }

  struct Answer {
    Eigen::VectorXd tau;            // by velocity
    std::vector<Motion<double>> a;  // by body
    std::vector<Force<double>> f;   // through each joint
  };
  // What it takes to move with qdd: tau = M qdd + h.
  Answer inverse(const Eigen::VectorXd& qdd) { return inverse(qdd, 0); }
  // The same for the subtree of body i, as if its parent moved so that a_i is S qdd_i: what the
  // subtree feels of a rigid acceleration is taken away.
  Answer inverse(const Eigen::VectorXd& qdd, std::size_t subtree);
  // At rest, without gravity or forces: tau = M qdd.
  Answer inertial(const Eigen::VectorXd& qdd);

  // i's velocities, and those of its descendants.
  struct Rows {
    std::vector<Eigen::Index> own, below;
  };
  Rows rows_of(std::size_t body) const;
  bool is_below(std::size_t body, std::size_t ancestor) const;  // or the same

 private:
  void add_implicit();
  Answer run(const Model<double>& model, const State<double>& x, const Eigen::VectorXd& qdd,
             const std::vector<Force<double>>& f_ext);

  const Inspection& in_;
  Model<double> weightless_;
  State<double> rest_;
  Workspace<double> w_;
  Eigen::MatrixXd M_;
};

}  // namespace twinarm
