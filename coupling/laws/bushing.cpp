#include "coupling/laws/bushing.h"

#include <utility>

#include "coupling/laws/spring_force.h"
#include "solver/forces/spring.h"

namespace twinarm {

Bushing::Bushing(std::string name, const Model<double>& model, KinematicRobot& kvr,
                 std::vector<Spring> springs, Treatment treatment, int hold_steps)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      treatment_(treatment),
      hold_(hold_steps, treatment) {
  readings_.resize(2 * springs_.size());  // forces, then couples
}

void Bushing::begin_step(const Kinematics&, double t, double h) noexcept {
  h_ = h;
  kvr_.begin_step(t, h);
  hold_.begin_step();
}

void Bushing::add_forces(const State<double>& x, const Kinematics& k,
                         Forces<double>& forces) noexcept {
  const TreatmentTerms terms = terms_of(treatment_, kvr_, x.t, h_);
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    SpringReading &force = readings_[s], &couple = readings_[springs_.size() + s];
    if (hold_.is_fresh()) {
      pull_point(spring, terms, k, force, forces);
      turn_link(spring.body, spring.k_turn, spring.b_turn, terms, k, couple, forces);
    }
    add_point_force(k, spring.body, k.position(spring.body, spring.p_L), force.pull, forces);
    add_couple(k, spring.body, couple.pull, forces);
  }
  hold_.computed();
}

Coupling::JointSpace Bushing::joint_space(const Kinematics& k) const {
  JointSpace sum = joint_space_of_points(model_, k, springs_);
  const JointSpace turns = joint_space_of_turns(model_, k, springs_);
  sum.K += turns.K;
  sum.B += turns.B;
  return sum;
}

void Bushing::visit_memory(Memory& memory) {
  Coupling::visit_memory(memory);
  hold_.visit_memory(memory);
}

}  // namespace twinarm
