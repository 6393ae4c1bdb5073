#include "coupling/analysis/target_radius.h"

#include "coupling/analysis/prediction.h"

namespace twinarm {

TargetRadius nearest_target_radius(const Model<double>& model, const State<double>& x,
                                   const Kinematics& D, const Kinematics& K, const Spring& spring,
                                   double h) {
  const Eigen::MatrixXd M = mass_matrix(model, x);
  const Vector3 p_D = D.position(spring.body, spring.p_L);
  const Vector3 p_K = K.position(spring.body, spring.p_L);
  TargetRadius nearest;
  for (int body = spring.body; body > 0; body = model.parent[static_cast<std::size_t>(body)]) {
    const auto i = static_cast<std::size_t>(body);
    if (model.joint[i] != JointType::revolute) continue;
    const auto dof = static_cast<Eigen::Index>(model.iv[i]);
    const Vector3 axis = D.R_WB[i].col(2);  // of a joint of one degree of freedom: z of its body
    const auto radius = [&](const Vector3& p) { return (p - D.X_WL[i].p).cross(axis).norm(); };
    TargetRadius here{body, radius(p_D), radius(p_K), 0};
    here.largest = largest_target_radius(M(dof, dof), here.r, spring.k, spring.b, h);
    if (nearest.body == 0 || here.ratio() > nearest.ratio()) nearest = here;
  }
  return nearest;
}

}  // namespace twinarm
