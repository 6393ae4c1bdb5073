#include "coupling/torsional.h"

#include <stdexcept>
#include <utility>

#include "coupling/treatment.h"
#include "solver/spring.h"

namespace twinarm {

TorsionalCoupling::TorsionalCoupling(std::string name, const Model<double>& model,
                                     KinematicRobot& kvr, std::vector<Spring> springs,
                                     Measure measure, Treatment treatment, int hold_steps)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      measure_(measure),
      treatment_(treatment),
      hold_steps_(hold_steps) {
  if (hold_steps > 0 && treatment != Treatment::explicit_)
    throw std::invalid_argument("a held force is explicit: it cannot see the end of the step");
}

void TorsionalCoupling::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
  fresh_ = hold_steps_ == 0 || steps_ % hold_steps_ == 0;
  ++steps_;
}

void TorsionalCoupling::add_forces(const State<double>& x, const Kinematics& k,
                                   Forces<double>& forces) noexcept {
  for (std::size_t s = 0; s < springs_.size(); ++s)
    measure_ == Measure::world ? pull_world(s, x, k, forces) : pull_joint(s, x, k, forces);
  if (hold_steps_ > 0) fresh_ = false;
}

void TorsionalCoupling::pull_world(std::size_t s, const State<double>& x, const Kinematics& k,
                                   Forces<double>& forces) {
  const Spring& spring = springs_[s];
  const auto i = static_cast<std::size_t>(spring.body);
  SpringReading& reading = readings_[s];
  if (fresh_) {
    const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
    const Matrix3 R_DK = terms.spring_target->k.X_WL[i].R * k.X_WL[i].R.transpose();
    const Vector3 phi = rotation_vector(R_DK) - terms.look_ahead * k.w_WL[i];
    reading.pull = spring.k * phi + spring.b * (terms.damper_target->k.w_WL[i] - k.w_WL[i]);
    reading.size = reading.pull.norm();
    reading.p_K = terms.spring_target->k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    const double m_star = terms.m_star(spring.k, spring.b);
    if (m_star > 0) add_flywheel(k, spring.body, m_star, forces);
  }
  add_couple(k, spring.body, reading.pull, forces);
}

void TorsionalCoupling::pull_joint(std::size_t s, const State<double>& x, const Kinematics& k,
                                   Forces<double>& forces) {
  const Spring& spring = springs_[s];
  const auto i = static_cast<std::size_t>(spring.body);
  const std::size_t iq = model_.iq[i], iv = model_.iv[i];
  SpringReading& reading = readings_[s];
  if (fresh_) {
    const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
    const double e = terms.spring_target->x.q[iq] - x.q[iq] - terms.look_ahead * x.qd[iv];
    reading.size = spring.k * e + spring.b * (terms.damper_target->x.qd[iv] - x.qd[iv]);
    reading.p_K = terms.spring_target->k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    forces.armature[iv] += terms.m_star(spring.k, spring.b);
  }
  forces.tau[iv] += reading.size;
}

Coupling::JointSpace TorsionalCoupling::joint_space(const Kinematics& k) const {
  const auto n = static_cast<Eigen::Index>(model_.nv);
  JointSpace sum{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (const Spring& spring : springs_) {
    Eigen::MatrixXd J;  // d(measured angle)/dq
    if (measure_ == Measure::world) {
      J = rotation_jacobian(model_, k, spring.body);
    } else {
      J = Eigen::MatrixXd::Zero(1, n);
      J(0, static_cast<Eigen::Index>(model_.iv[static_cast<std::size_t>(spring.body)])) = 1;
    }
    sum.K += spring.k * J.transpose() * J;
    sum.B += spring.b * J.transpose() * J;
  }
  return sum;
}

}  // namespace twinarm
