#include "coupling/laws/stable_pd.h"

#include <utility>

namespace twinarm {

StablePd::StablePd(std::string name, const Model<double>& model, KinematicRobot& kvr,
                   std::vector<Spring> springs)
    : Coupling(std::move(name), model, kvr, std::move(springs)) {
  check_one_dof();
}

void StablePd::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
}

void StablePd::add_forces(const State<double>& x, const Kinematics& k,
                          Forces<double>& forces) noexcept {
  const KvrSample& end = kvr_.end();
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    const auto i = static_cast<std::size_t>(spring.body);
    const std::size_t iq = model_.iq[i], iv = model_.iv[i];
    const double e = end.x.q[iq] - (x.q[iq] + h_ * x.qd[iv]), e_dot = end.x.qd[iv] - x.qd[iv];
    SpringReading& reading = readings_[s];
    reading.size = spring.k * e + spring.b * e_dot;
    reading.m_star = h_ * spring.b;
    reading.p_K = end.k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    forces.tau[iv] += reading.size;
    forces.armature[iv] += reading.m_star;
  }
}

Coupling::JointSpace StablePd::joint_space(const Kinematics&) const {
  JointSpace sum(model_.nv);
  for (const Spring& spring : springs_) sum.add(spring.k, spring.b, joint_row(spring.body));
  return sum;
}

}  // namespace twinarm
