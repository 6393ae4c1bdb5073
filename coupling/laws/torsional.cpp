#include "coupling/laws/torsional.h"

#include <utility>

#include "coupling/laws/spring_force.h"
#include "solver/forces/spring.h"

namespace twinarm {

TorsionalCoupling::TorsionalCoupling(std::string name, const Model<double>& model,
                                     KinematicRobot& kvr, std::vector<Spring> springs,
                                     Measure measure, Treatment treatment, int hold_steps)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      measure_(measure),
      treatment_(treatment),
      hold_(hold_steps, treatment) {
  if (measure == Measure::joint) check_one_dof();
}

void TorsionalCoupling::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
  hold_.begin_step();
}

void TorsionalCoupling::add_forces(const State<double>& x, const Kinematics& k,
                                   Forces<double>& forces) noexcept {
  const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    if (measure_ == Measure::joint) {
      pull_joint(s, terms, x, k, forces);
      continue;
    }
    if (hold_.is_fresh())
      turn_link(spring.body, spring.k, spring.b, terms, k, readings_[s], forces);
    add_couple(k, spring.body, readings_[s].pull, forces);
  }
  hold_.computed();
}

void TorsionalCoupling::pull_joint(std::size_t s, const TreatmentTerms& terms,
                                   const State<double>& x, const Kinematics& k,
                                   Forces<double>& forces) {
  const Spring& spring = springs_[s];
  const auto i = static_cast<std::size_t>(spring.body);
  const std::size_t iq = model_.iq[i], iv = model_.iv[i];
  SpringReading& reading = readings_[s];
  if (hold_.is_fresh()) {
    const double e = terms.spring_target->x.q[iq] - x.q[iq] - terms.look_ahead * x.qd[iv];
    reading.size = spring.k * e + spring.b * (terms.damper_target->x.qd[iv] - x.qd[iv]);
    reading.p_K = terms.spring_target->k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    reading.m_star = terms.m_star(spring.k, spring.b);
    forces.armature[iv] += reading.m_star;
  }
  forces.tau[iv] += reading.size;
}

Coupling::JointSpace TorsionalCoupling::joint_space(const Kinematics& k) const {
  JointSpace sum(model_.nv);
  for (const Spring& spring : springs_)
    if (measure_ == Measure::world)
      sum.add(spring.k, spring.b, rotation_jacobian(model_, k, spring.body));
    else
      sum.add(spring.k, spring.b, joint_row(spring.body));
  return sum;
}

void TorsionalCoupling::visit_memory(Memory& memory) {
  Coupling::visit_memory(memory);
  hold_.visit_memory(memory);
}

}  // namespace twinarm
