#include "coupling/linear.h"

#include <stdexcept>
#include <utility>

#include "coupling/treatment.h"
#include "solver/spring.h"

namespace twinarm {

LinearCoupling::LinearCoupling(std::string name, const Model<double>& model, KinematicRobot& kvr,
                               std::vector<Spring> springs, Treatment treatment, int hold_steps)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      treatment_(treatment),
      hold_steps_(hold_steps) {
  if (hold_steps > 0 && treatment != Treatment::explicit_)
    throw std::invalid_argument("a held force is explicit: it cannot see the end of the step");
}

void LinearCoupling::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
  fresh_ = hold_steps_ == 0 || steps_ % hold_steps_ == 0;
  ++steps_;
}

void LinearCoupling::add_forces(const State<double>& x, const Kinematics& k,
                                Forces<double>& forces) noexcept {
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    SpringReading& reading = readings_[s];
    const Vector3 p_D = k.position(spring.body, spring.p_L);
    if (fresh_) {
      const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
      const Vector3 p_K = terms.spring_target->k.position(spring.body, spring.p_L);
      const Vector3 v_D = k.velocity(spring.body, p_D);
      const Kinematics& k_K = terms.damper_target->k;
      const Vector3 v_K = k_K.velocity(spring.body, k_K.position(spring.body, spring.p_L));
      reading.p_K = p_K;
      reading.p_D = p_D;
      reading.pull = spring.k * (p_K - p_D - terms.look_ahead * v_D) + spring.b * (v_K - v_D);
      reading.size = reading.pull.norm();
      const double m_star = terms.m_star(spring.k, spring.b);
      if (m_star > 0) add_particle(k, spring.body, p_D, m_star, forces);
    }
    add_point_force(k, spring.body, p_D, reading.pull, forces);
  }
  if (hold_steps_ > 0) fresh_ = false;
}

Coupling::JointSpace joint_space_of_points(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs) {
  const auto n = static_cast<Eigen::Index>(model.nv);
  Coupling::JointSpace sum{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (const Spring& spring : springs) {
    const Eigen::Matrix3Xd J =
        point_jacobian(model, k, spring.body, k.position(spring.body, spring.p_L));
    sum.K += spring.k * J.transpose() * J;
    sum.B += spring.b * J.transpose() * J;
  }
  return sum;
}

Coupling::JointSpace LinearCoupling::joint_space(const Kinematics& k) const {
  return joint_space_of_points(model_, k, springs_);
}

}  // namespace twinarm
