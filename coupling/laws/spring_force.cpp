#include "coupling/laws/spring_force.h"

#include "solver/forces/spring.h"

namespace twinarm {

void pull_point(const Spring& spring, const TreatmentTerms& terms, const Kinematics& D,
                SpringReading& reading, Forces<double>& forces) {
  const Kinematics &K = terms.spring_target->k, &K_damper = terms.damper_target->k;
  reading.p_K = K.position(spring.body, spring.p_L);
  reading.p_D = D.position(spring.body, spring.p_L);
  const Vector3 v_D = D.velocity(spring.body, reading.p_D);
  Vector3 v_K = Vector3::Zero();
  if (terms.sees_target_moves)
    v_K = K_damper.velocity(spring.body, K_damper.position(spring.body, spring.p_L));
  reading.pull =
      spring.k * (reading.p_K - reading.p_D - terms.look_ahead * v_D) + spring.b * (v_K - v_D);
  reading.size = reading.pull.norm();
  reading.m_star = terms.m_star(spring.k, spring.b);
  if (reading.m_star > 0) add_particle(D, spring.body, reading.p_D, reading.m_star, forces);
}

void turn_link(int body, double k, double b, const TreatmentTerms& terms, const Kinematics& D,
               SpringReading& reading, Forces<double>& forces) {
  const auto i = static_cast<std::size_t>(body);
  const Kinematics& K = terms.spring_target->k;
  const Vector3 phi =
      rotation_vector(K.X_WL[i].R * D.X_WL[i].R.transpose()) - terms.look_ahead * D.w_WL[i];
  Vector3 w_K = Vector3::Zero();
  if (terms.sees_target_moves) w_K = terms.damper_target->k.w_WL[i];
  reading.pull = k * phi + b * (w_K - D.w_WL[i]);
  reading.size = reading.pull.norm();
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

Coupling::JointSpace joint_space_of_turns(const Model<double>& model, const Kinematics& k,
                                          const std::vector<Spring>& springs) {
  Coupling::JointSpace sum(model.nv);
  for (const Spring& spring : springs)
    sum.add(spring.k_turn, spring.b_turn, rotation_jacobian(model, k, spring.body));
  return sum;
}

}  // namespace twinarm
