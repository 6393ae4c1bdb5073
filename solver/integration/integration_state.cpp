#include "solver/integration/integration_state.h"

#include <stdexcept>

#include "solver/dynamics/dynamics.h"
#include "solver/loops/loop_closure.h"
#include "solver/model/configuration.h"
#include "solver/model/mimic.h"

namespace twinarm {

// In child axes, R = R_JL: w = R^T w_J and v = R^T dp/dt, with the component derivatives
//   dw/dt = R^T alpha_J              (w x w = 0)
//   dv/dt = R^T d^2p/dt^2 - w x v.
void store_motion(const Model<double>& model, std::size_t body, const PrescribedMotion& motion,
                  State<double>& x) {
  double *q = x.q.data() + model.iq[body], *given = x.prescribed.data() + model.ip[body];
  const Matrix3 R_LJ = motion.X_JL.R.transpose();
  const Eigen::Quaterniond rotation(motion.X_JL.R);
  const Vector3 w = R_LJ * motion.angular_velocity, v = R_LJ * motion.velocity;
  const Vector3 w_rate = R_LJ * motion.angular_acceleration;
  const Vector3 v_rate = R_LJ * motion.acceleration - w.cross(v);
  Eigen::Map<Eigen::Vector<double, 7>>(q) << motion.X_JL.p, rotation.w(), rotation.vec();
  Eigen::Map<Eigen::Vector<double, 12>>(given) << w, v, w_rate, v_rate;
}

void visit_state(StateArchive& archive, const Model<double>& model, State<double>& x) {
  std::vector<double> q = q_with_prescribed(model, x);
  archive.visit(q, x.qd, x.t);
  if (q.size() != model.nq + model.np || x.qd.size() != model.nv)
    throw std::runtime_error("state size mismatch: the state belongs to another model");
  set_q_with_prescribed(model, q, x);
}

IntegrationState::IntegrationState(const Model<double>& model, State<double> start)
    : x(std::move(start)),
      k(model),
      stage(x),
      k_stage(model),
      w(model),
      forces(model),
      dynamics(model),
      projection(model),
      model_(&model) {
  project_and_update();
}

void IntegrationState::update_kinematics() {
  apply_mimics(*model_, x);
  set_prescribed_joints(x);
  forward_kinematics(*model_, x, k);
}

double IntegrationState::project_loops(State<double>& at, Kinematics& k_at) {
  if (!has_loops()) return 0;
  if (account) account->before_projection(at);
  const double error = projection(dynamics.sticking_dofs(at), at, k_at, w);
  if (account) account->after_projection(at, projection, dynamics.bilateral().loops());
  return error;
}

void IntegrationState::start(State<double> from) {
  apply_mimics(*model_, from);
  set_prescribed_joints(from);
  if (has_loops()) check_loops(*model_, dynamics.bilateral().loops().loops(), from);
  x = std::move(from);
  forward_kinematics(*model_, x, k);
  prepare_projection();
  project_and_update();
}

void IntegrationState::set_loops(LoopClosures loops) {
  if (account) account.emplace(*model_, loops.loops().size(), loops.rows());
  projection.set_loops(loops);
  dynamics.bilateral().set_loops(std::move(loops));
  prepare_projection();
  project_and_update();
}

void IntegrationState::prepare_projection() {
  if (!has_loops()) return;
  dynamics.bilateral().loops().evaluate(x, k);
  forces.clear();
  aba(*model_, x, forces, w);
  dynamics.bilateral().prepare(w);
  start_projection();
}

void IntegrationState::accelerate_stage() {
  stage.prescribed = x.prescribed;  // of joints without a motion function
  set_prescribed_joints(stage);
  forward_kinematics(*model_, stage, k_stage);
  project_loops(stage, k_stage);
  accelerate(stage, k_stage, FrictionRule::frozen_modes, 0);
}

void IntegrationState::accelerate_end(double t) {
  x.t = t;
  project_and_update();
  accelerate(x, k, FrictionRule::frozen_modes, 0);
}

void IntegrationState::accelerate(const State<double>& at, const Kinematics& k_at,
                                  FrictionRule rule, double h) {
  if (has_loops()) dynamics.bilateral().loops().evaluate(at, k_at);
  forces.clear();
  for (ForceSource* source : sources) source->add_forces(at, k_at, forces);
  dynamics(at, forces, w, rule, h);
}

}  // namespace twinarm
