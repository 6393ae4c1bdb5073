#include "coupling/laws/spring_damper.h"

#include <stdexcept>

#include "solver/forces/spring.h"

namespace twinarm {

SpringDamperCoupling::SpringDamperCoupling(const CouplingSpec& spec, const Model<double>& model,
                                           TargetRobot& kvr, Space space)
    : Coupling(spec, model, kvr),
      space_(space),
      discretization_(spec.discretization),
      hold_steps_(spec.hold_steps) {
  if (hold_steps_ > 0 && discretization_ != Discretization::explicit_)
    throw std::invalid_argument("a held force must be explicit");
  if (space == Space::joint) check_one_dof();
  if (space == Space::frame) readings_.resize(2 * springs_.size());  // forces, then torques
}

void SpringDamperCoupling::add_forces(const State<double>& x, const Kinematics& k,
                                      Forces<double>& forces) noexcept {
  const DiscretizationTerms terms = discretization_terms(discretization_, kvr_, x.t, h_);
  const bool at_point = space_ == Space::point || space_ == Space::frame;
  const bool torsional = space_ == Space::orientation || space_ == Space::frame;
  for (std::size_t s = 0; s < springs_.size(); ++s) {
    if (space_ == Space::joint) apply_joint_spring(s, terms, x, k, forces);
    const Spring& spring = springs_[s];
    SpringState &force = readings_[s],
                &torque = readings_[at_point && torsional ? springs_.size() + s : s];
    if (is_fresh_) {
      if (at_point) apply_point_spring(spring, terms, k, force, forces);
      if (torsional && at_point)
        apply_torsional_spring(spring.body, spring.k_rotational, spring.b_rotational, terms, k,
                               torque, forces);
      else if (torsional)
        apply_torsional_spring(spring.body, spring.k, spring.b, terms, k, torque, forces);
    }
    if (at_point)
      add_point_force(k, spring.body, k.position(spring.body, spring.p_L), force.force_W, forces);
    if (torsional) add_couple(k, spring.body, torque.force_W, forces);
  }
  if (hold_steps_ > 0) is_fresh_ = false;
}

void SpringDamperCoupling::apply_joint_spring(std::size_t s, const DiscretizationTerms& terms,
                                              const State<double>& x, const Kinematics& k,
                                              Forces<double>& forces) {
  const Spring& spring = springs_[s];
  const auto i = static_cast<std::size_t>(spring.body);
  const std::size_t iq = model_.iq[i], iv = model_.iv[i];
  SpringState& reading = readings_[s];
  if (is_fresh_) {
    const double e = terms.spring_target->x.q[iq] - x.q[iq] - terms.position_lead * x.qd[iv];
    reading.size = spring.k * e + spring.b * (terms.damper_target->x.qd[iv] - x.qd[iv]);
    reading.p_K = terms.spring_target->k.X_WL[i].p;
    reading.p_D = k.X_WL[i].p;
    reading.m_star = terms.m_star(spring.k, spring.b);
    forces.armature[iv] += reading.m_star;
  }
  forces.tau[iv] += reading.size;
}

Coupling::JointSpace SpringDamperCoupling::joint_space(const Kinematics& k) const {
  if (space_ == Space::point) return joint_space_of_points(model_, k, springs_);
  if (space_ == Space::frame) return joint_space_of_frames(model_, k, springs_);
  if (space_ == Space::joint) return joint_space_of_joints();
  JointSpace sum(model_.nv);
  for (const Spring& spring : springs_)
    sum.add(spring.k, spring.b, rotation_jacobian(model_, k, spring.body));
  return sum;
}

void apply_point_spring(const Spring& spring, const DiscretizationTerms& terms, const Kinematics& D,
                        SpringState& reading, Forces<double>& forces) {
  const Kinematics &K = terms.spring_target->k, &K_damper = terms.damper_target->k;
  reading.p_K = K.position(spring.body, spring.p_L);
  reading.p_D = D.position(spring.body, spring.p_L);
  const Vector3 v_D = D.velocity(spring.body, reading.p_D);
  Vector3 v_K = Vector3::Zero();
  if (terms.is_relative_damper)
    v_K = K_damper.velocity(spring.body, K_damper.position(spring.body, spring.p_L));
  reading.force_W =
      spring.k * (reading.p_K - reading.p_D - terms.position_lead * v_D) + spring.b * (v_K - v_D);
  reading.size = reading.force_W.norm();
  reading.m_star = terms.m_star(spring.k, spring.b);
  if (reading.m_star > 0) add_particle(D, spring.body, reading.p_D, reading.m_star, forces);
}

void apply_torsional_spring(int body, double k, double b, const DiscretizationTerms& terms,
                            const Kinematics& D, SpringState& reading, Forces<double>& forces) {
  const auto i = static_cast<std::size_t>(body);
  const Kinematics& K = terms.spring_target->k;
  const Vector3 phi =
      rotation_vector(K.X_WL[i].R * D.X_WL[i].R.transpose()) - terms.position_lead * D.w_WL[i];
  Vector3 w_K = Vector3::Zero();
  if (terms.is_relative_damper) w_K = terms.damper_target->k.w_WL[i];
  reading.force_W = k * phi + b * (w_K - D.w_WL[i]);
  reading.size = reading.force_W.norm();
  reading.p_K = K.X_WL[i].p;
  reading.p_D = D.X_WL[i].p;
  reading.m_star = terms.m_star(k, b);
  if (reading.m_star > 0) add_flywheel(D, body, reading.m_star, forces);
}

Coupling::JointSpace joint_space_of_points(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs) {
  Coupling::JointSpace sum(model.nv);
  for (const Spring& spring : springs)
    sum.add(spring.k, spring.b,
            point_jacobian(model, k, spring.body, k.position(spring.body, spring.p_L)));
  return sum;
}

Coupling::JointSpace joint_space_of_frames(const Model<double>& model, const Kinematics& k,
                                           const std::vector<Spring>& springs) {
  Coupling::JointSpace sum = joint_space_of_points(model, k, springs), torsional(model.nv);
  for (const Spring& spring : springs)
    torsional.add(spring.k_rotational, spring.b_rotational,
                  rotation_jacobian(model, k, spring.body));
  sum.K += torsional.K;
  sum.B += torsional.B;
  return sum;
}

}  // namespace twinarm
