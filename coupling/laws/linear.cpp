#include "coupling/laws/linear.h"

#include <utility>

#include "coupling/laws/spring_force.h"
#include "solver/forces/spring.h"

namespace twinarm {

LinearCoupling::LinearCoupling(std::string name, const Model<double>& model, KinematicRobot& kvr,
                               std::vector<Spring> springs, Treatment treatment, int hold_steps)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      treatment_(treatment),
      hold_(hold_steps, treatment) {}

void LinearCoupling::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
  hold_.begin_step();
}

void LinearCoupling::add_forces(const State<double>& x, const Kinematics& k,
                                Forces<double>& forces) noexcept {
  const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    if (hold_.is_fresh()) pull_point(spring, terms, k, readings_[s], forces);
    add_point_force(k, spring.body, k.position(spring.body, spring.p_L), readings_[s].pull, forces);
  }
  hold_.computed();
}

Coupling::JointSpace LinearCoupling::joint_space(const Kinematics& k) const {
  return joint_space_of_points(model_, k, springs_);
}

void LinearCoupling::visit_memory(Memory& memory) {
  Coupling::visit_memory(memory);
  hold_.visit_memory(memory);
}

}  // namespace twinarm
