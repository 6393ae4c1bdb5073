#include "coupling/matched.h"

#include <utility>

#include "coupling/linear.h"

namespace twinarm {

MatchedTorsional::MatchedTorsional(std::string name, const Model<double>& model,
                                   KinematicRobot& kvr, std::vector<Spring> springs)
    : Coupling(std::move(name), model, kvr, std::move(springs)) {}

void MatchedTorsional::begin_step(const Kinematics&, double t, double h) noexcept {
  kvr_.begin_step(t, h);
}

void MatchedTorsional::add_forces(const State<double>& x, const Kinematics&,
                                  Forces<double>& forces) noexcept {
  const KvrSample& target = kvr_.at(x.t);
  at_kvr_ = joint_space_of_points(model_, target.k, springs_);
  const auto n = static_cast<Eigen::Index>(model_.nv);
  for (Eigen::Index r = 0; r < n; ++r) {
    double tau = 0;
    for (Eigen::Index c = 0; c < n; ++c) {
      const auto j = static_cast<std::size_t>(c);
      tau +=
          at_kvr_.K(r, c) * (target.x.q[j] - x.q[j]) + at_kvr_.B(r, c) * (target.x.qd[j] - x.qd[j]);
    }
    forces.tau[static_cast<std::size_t>(r)] += tau;
    if (static_cast<std::size_t>(r) < readings_.size())
      readings_[static_cast<std::size_t>(r)].size = tau;  // a torque of joint r, not of a spring
  }
}

Coupling::JointSpace MatchedTorsional::joint_space(const Kinematics& k) const {
  return joint_space_of_points(model_, k, springs_);
}

}  // namespace twinarm
