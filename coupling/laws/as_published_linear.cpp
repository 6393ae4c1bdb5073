#include <algorithm>
#include <utility>

#include "coupling/laws/as_published.h"
#include "coupling/laws/spring_force.h"
#include "solver/forces/spring.h"

namespace twinarm {

PrintedLinear::PrintedLinear(std::string name, const Model<double>& model, KinematicRobot& kvr,
                             std::vector<Spring> springs, PrintedOptions options)
    : Coupling(std::move(name), model, kvr, std::move(springs)),
      options_(options),
      past_(springs_.size()) {
  options_.hold_steps = std::max(1, options_.hold_steps);
}

void PrintedLinear::begin_step(const Kinematics& k, double t, double h) noexcept {
  kvr_.begin_step(t, h);
  const bool first = steps_ == 0, due = steps_ % options_.hold_steps == 0;
  ++steps_;
  if (!due) return;
  const double interval =
      options_.difference == Difference::per_frame ? 1.0 : h * options_.hold_steps;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    const Spring& spring = springs_[s];
    Past& past = past_[s];
    const Vector3 p_K = kvr_.start().k.position(spring.body, spring.p_L);
    const Vector3 p_D = k.position(spring.body, spring.p_L);
    const Vector3 old_step_K = past.step_K, old_step_D = past.step_D;
    past.step_K = first ? Vector3::Zero() : Vector3(p_K - past.p_K);
    past.step_D = first ? Vector3::Zero() : Vector3(p_D - past.p_D);
    past.p_K = p_K;
    past.p_D = p_D;

    const bool older = options_.difference == Difference::older;
    const Vector3 v_K = (older ? old_step_K : past.step_K) / interval;
    const Vector3 v_D = (older ? old_step_D : past.step_D) / interval;
    SpringReading& reading = readings_[s];
    reading.p_K = p_K;
    reading.p_D = p_D;
    reading.pull = spring.k * (p_K - p_D) - spring.b * (v_D - v_K);
    reading.size = reading.pull.norm();
  }
}

void PrintedLinear::add_forces(const State<double>&, const Kinematics& k,
                               Forces<double>& forces) noexcept {
  for (std::size_t s = 0; s < springs_.size(); ++s)
    add_point_force(k, springs_[s].body, k.position(springs_[s].body, springs_[s].p_L),
                    readings_[s].pull, forces);
}

Coupling::JointSpace PrintedLinear::joint_space(const Kinematics& k) const {
  return joint_space_of_points(model_, k, springs_);
}

void PrintedLinear::visit_memory(Memory& memory) {
  Coupling::visit_memory(memory);
  memory.visit(steps_);
  for (Past& past : past_)
    for (Vector3* v : {&past.p_K, &past.p_D, &past.step_K, &past.step_D}) memory.visit(*v);
}

}  // namespace twinarm
