#include "benchmarks/analytic/support/smooth_parts.h"

#include <limits>

#include "solver/dynamics/derivatives.h"
#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/loops/constrained_dynamics.h"

namespace twinarm {

Model<double> weightless(Model<double> model) {
  model.gravity = {};
  return model;
}

Model<double> free_body(double mass, const Vector3& moments) {
  return weightless(
      one_body(JointType::free, Vector3::UnitZ(), {mass, Vector3::Zero(), moments.asDiagonal()}));
}

Model<double> one_body(JointType type, const Vector3& axis, const BodyInertia& inertia,
                       const JointProperties& properties) {
  ModelBuilder builder;
  builder.add_body("body", 0, "joint", type, {}, axis, inertia, properties);
  return builder.build();
}

Model<double> point_pendulum() {
  return one_body(JointType::revolute, Vector3::UnitY(), {1, {0, 0, -1}, Matrix3::Zero()});
}

CaseScene at_rest(Model<double> model) {
  CaseScene scene;
  scene.start = State<double>(model);
  scene.model = std::move(model);
  return scene;
}

CaseScene not_conserving(CaseScene scene) {
  scene.conserves = false;
  return scene;
}

CaseScene start_at(Model<double> model, std::vector<double> q, std::vector<double> qd) {
  CaseScene scene = at_rest(std::move(model));
  scene.start.q = std::move(q);
  scene.start.qd = std::move(qd);
  return scene;
}

Workspace<double> evaluate(ModelRef model, StateRef x, const std::vector<double>& tau) {
  Workspace<double> w(model);
  Forces<double> forces(model);
  if (!tau.empty()) forces.tau = tau;
  kinematics(model, x, w);
  ForwardDynamics dynamics(model);
  dynamics(x, forces, w);
  return w;
}

std::vector<double> inverse_dynamics(const Model<double>& model, const State<double>& x,
                                     const std::vector<double>& qdd) {
  Workspace<double> w(model);
  rnea(model, x, qdd, std::vector<Force<double>>(model.parent.size()), w);
  return w.tau;
}

Vector3 reaction(ModelRef model, StateRef x) {
  Workspace<double> w = evaluate(model, x);
  const std::vector<double> qdd = w.qdd;
  rnea(model, x, qdd, std::vector<Force<double>>(model.parent.size()), w);
  return to_eigen(w.X0[1].E).transpose() * to_eigen(w.f[1].f);
}

std::vector<double> squared_frequencies_of(ModelRef model, StateRef x) {
  const Eigen::MatrixXd dq = forward_dynamics_derivatives(model, x, Forces<double>(model)).dq;
  const Eigen::VectorXcd values = eigenvalues_of(dq);
  std::vector<double> all;
  for (const std::complex<double>& value : values) all.push_back(-value.real());
  std::ranges::sort(all);
  return all;
}

// By M x = mu K x, mu = 1 / w^2: exact to rounding for the slow ones, as those of M^-1 K are not.
std::vector<double> small_frequencies(ModelRef model, StateRef x) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto nv = static_cast<Eigen::Index>(model.nv);
  const std::vector<double> at_rest(model.nv);
  const Forces<double> forces(model);
  Workspace<double> w(model);
  MatrixWorkspace<double> m(model);
  RowMajor rates(nv, 2 * nv);
  rnea(model, x, at_rest, forces.f_ext, w);
  rnea_derivatives(model, x, forces, at_rest, w, m,
                   {rates.data(), static_cast<std::size_t>(rates.size())});
  std::vector<double> all;
  for (const double mu : generalized_eigenvalues(mass_matrix(model, x), rates.leftCols(nv)))
    all.push_back(1 / std::sqrt(mu));
  std::ranges::reverse(all);
  return all;
}

CaseReadings attitude_and_rate(const Eigen::Quaterniond& attitude, const Vector3& rate) {
  return {attitude.w(), attitude.x(), attitude.y(), attitude.z(), rate.x(), rate.y(), rate.z()};
}

CaseReadings observe_attitude_and_rate(ModelRef, StateRef x) {
  return {x.q[3], x.q[4], x.q[5], x.q[6], x.qd[0], x.qd[1], x.qd[2]};
}

double attitude_and_rate_error(const CaseReadings& seen, const CaseReadings& exact) {
  const auto attitude = [](const CaseReadings& r) {
    return Eigen::Quaterniond(r[0], r[1], r[2], r[3]);
  };
  const auto rate = [](const CaseReadings& r) { return Vector3(r[4], r[5], r[6]); };
  return nan_max(attitude(seen).angularDistance(attitude(exact)),
                 (rate(seen) - rate(exact)).norm());
}

double relative_each(const CaseReadings& seen, const CaseReadings& exact) {
  if (seen.size() != exact.size()) return std::numeric_limits<double>::quiet_NaN();
  double error = 0;
  for (std::size_t i = 0; i < seen.size(); ++i)
    error = nan_max(error, std::abs(seen[i] / exact[i] - 1));
  return error;
}

Model<double> plane_chain(const std::vector<ChainLink>& links, double gravity) {
  ModelBuilder builder;
  builder.set_gravity({0, 0, -gravity});
  int parent = 0;
  double down = 0;
  for (const ChainLink& link : links) {
    const std::string number = std::to_string(parent + 1);
    const Vector3 moments(link.inertia, link.inertia, link.in_line ? 0 : link.inertia);
    parent = builder.add_body("link" + number, parent, "joint" + number, JointType::revolute,
                              {Matrix3::Identity(), {0, 0, -down}}, -Vector3::UnitY(),
                              {link.mass, {0, 0, -link.com}, moments.asDiagonal()});
    down = link.length;
  }
  return builder.build();
}

Model<double> plane_chain(const ChainLink& link, int count) {
  return plane_chain(std::vector<ChainLink>(static_cast<std::size_t>(count), link));
}

CaseObserver absolute_angles() {
  return [](ModelRef, StateRef x) {
    CaseReadings all;
    for (const std::vector<double>& joints : {x.q, x.qd}) {
      double sum = 0;
      for (const double joint : joints) all.push_back(sum += joint);
    }
    return all;
  };
}

std::function<CaseReadings(double)> solution_of(special::Rates rates, special::Numbers start) {
  return [rates = std::move(rates), start = std::move(start)](double t) {
    CaseReadings all;
    for (const long double value : special::solution(rates, start, t))
      all.push_back(static_cast<double>(value));
    return all;
  };
}

}  // namespace twinarm
