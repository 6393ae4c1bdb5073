#include "app/robot/dynamics.h"

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/world_kinematics.h"
#include "solver/loops/constrained_dynamics.h"
#include "solver/model/non_finite.h"

namespace twinarm {
namespace {

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

// Joint forces that balance damping and Coulomb friction; zero at rest.
std::vector<double> friction_forces(const Model<double>& model, const State<double>& x) {
  std::vector<double> tau(model.nv);
  for (std::size_t i = 0; i < model.nv; ++i) {
    const double qd = x.qd[i];
    tau[i] = model.damping[i] * qd;
    if (qd > 0) tau[i] += model.coulomb_plus[i];
    if (qd < 0) tau[i] -= model.coulomb_minus[i];
  }
  return tau;
}

// A vector of the solver by rows of the mass matrix.
Eigen::VectorXd by_rows(const Coordinates& coordinates, const State<double>& x,
                        const std::vector<double>& by_velocity) {
  Eigen::VectorXd rows(coordinates.rows());
  for (const NamedJoint& joint : coordinates.all()) {
    const std::vector<double> values = from_solver(joint, x, by_velocity);
    for (std::size_t k = 0; k < joint.nv; ++k)
      rows[static_cast<Eigen::Index>(joint.row + k)] = values[k];
  }
  return rows;
}

void forward(const RobotInput& input, const std::vector<Force<double>>& f_ext, Dynamics& d) {
  const State<double>& x = input.state.x;
  Workspace<double> w(input.model);
  Forces<double> forces(input.model);
  forces.f_ext = f_ext;
  for (const NamedJoint& joint : input.coordinates.all())
    to_solver(joint, x, input.state.tau.data() + joint.row, forces.tau);
  ForwardDynamics forward_dynamics(input.model);
  forward_dynamics(x, forces, w);
  d.qdd = by_rows(input.coordinates, x, w.qdd);
  if (const NonFiniteField bad = first_bad_quantity(input.model, forces, w); bad.body > 0)
    d.first_bad =
        std::string("'") + bad.name + "' of link '" + input.model.body_name[bad.body] + "'";
}

void inverse(const RobotInput& input, const std::vector<Force<double>>& f_ext, const Kinematics& k,
             const Eigen::SparseMatrix<double>& P, Dynamics& d) {
  const Model<double>& model = input.model;
  const State<double>& x = input.state.x;
  Workspace<double> w(model);
  const Eigen::VectorXd qdd = P * input.state.qdd;
  rnea(model, x, {qdd.begin(), qdd.end()}, f_ext, w);
  const std::vector<double> friction = friction_forces(model, x);
  d.tau_inverse = P.transpose() * (as_vector(w.tau) + as_vector(friction));
  d.base_force = k.R_WB[1] * to_eigen(w.f[1].f);
  d.base_torque = k.R_WB[1] * to_eigen(w.f[1].n);

  const std::vector<double> no_qdd(model.nv);
  const std::vector<Force<double>> no_forces(model.parent.size());
  rnea(model, x, no_qdd, no_forces, w);
  d.bias = P.transpose() * as_vector(w.tau);
  State<double> at_rest = x;
  at_rest.qd.assign(model.nv, 0);
  rnea(model, at_rest, no_qdd, no_forces, w);
  d.gravity = P.transpose() * as_vector(w.tau);
}

}  // namespace

Force<double> in_body_axes(const Wrench& wrench, const Kinematics& k) {
  const Pose& X_WL = k.X_WL[wrench.body];
  const bool rotate = wrench.in_link_axes;
  const Vector3 f_W = rotate ? X_WL.R * wrench.force : wrench.force;
  const Vector3 n_W = rotate ? X_WL.R * wrench.torque : wrench.torque;
  const Vector3 r_W = rotate ? X_WL.R * wrench.point : Vector3(wrench.point - X_WL.p);
  const Matrix3 R_BW = k.R_WB[wrench.body].transpose();
  return {from_eigen(R_BW * (n_W + r_W.cross(f_W))), from_eigen(R_BW * f_W)};
}

Dynamics compute_dynamics(const RobotInput& input) {
  const Model<double>& model = input.model;
  const State<double>& x = input.state.x;
  const Eigen::SparseMatrix<double> P = input.coordinates.P(model, x);
  const Kinematics k = kinematics_at(model, x);
  std::vector<Force<double>> f_ext(model.parent.size());
  for (const Wrench& wrench : input.state.wrenches) f_ext[wrench.body] += in_body_axes(wrench, k);

  Dynamics d;
  forward(input, f_ext, d);
  inverse(input, f_ext, k, P, d);

  if (model.nv <= kMaxDense) {
    const Eigen::MatrixXd M = P.transpose() * mass_matrix(model, x) * P;
    d.mass_matrix = 0.5 * (M + M.transpose());  // symmetric to the last digit
  }

  Workspace<double> w(model);
  kinematics(model, x, w);
  d.kinetic_energy = kinetic_energy(model, x, w);
  d.potential_energy = potential_energy(model, w);
  const MassAndCom<double> weight = mass_and_com(model, w);
  d.mass = weight.mass;
  d.com = to_eigen(weight.com);
  const Force<double> total = momentum(model, w);
  d.linear_momentum = to_eigen(total.f);
  d.angular_momentum = to_eigen(total.n);
  return d;
}

void set_pose(RobotInput& input, const State<double>& x) {
  const Kinematics before = kinematics_at(input.model, input.state.x);
  const Kinematics now = kinematics_at(input.model, x);
  for (Wrench& wrench : input.state.wrenches) {
    if (wrench.in_link_axes) continue;
    const Pose &was = before.X_WL[wrench.body], &is = now.X_WL[wrench.body];
    const Vector3 p_L = was.R.transpose() * (wrench.point - was.p);
    wrench.point = is * p_L;
  }
  input.state.x = x;
}

}  // namespace twinarm
