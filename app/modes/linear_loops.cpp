
#include "app/modes/linear_system.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "solver/model/configuration.h"
#include "solver/model/mimic.h"

namespace twinarm {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDependentRows = 1e-9;  // relative to the largest pivot

VectorXd as_vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), signed_index(v.size()));
}

State<double> moved(const Model<double>& model, const State<double>& x, const VectorXd& dq,
                    const VectorXd& dqd) {
  State<double> to = x;
  integrate_coordinates(model, x.q, {dq.data(), dq.data() + dq.size()}, to.q);
  for (std::size_t dof = 0; dof < model.nv; ++dof) to.qd[dof] += dqd[signed_index(dof)];
  return to;
}

// Velocity and acceleration conditions of the loops, as functions of the state.
class LoopConditions {
 public:
  LoopConditions(const Model<double>& model, const State<double>& x, LoopClosures loops,
                 const std::vector<double>& qdd)
      : model_(model), x_(x), loops_(std::move(loops)), k_(model), qdd_(as_vector(qdd)) {}

  MatrixXd J() {
    evaluate(x_);
    return loops_.J();
  }
  // d(J qd; J qdd + gamma) along (dq, dqd) for the qd and qdd of x.
  struct Rates {
    VectorXd velocity, acceleration;
  };
  Rates along(const VectorXd& dq, const VectorXd& dqd) {
    const double size = std::max({dq.lpNorm<Eigen::Infinity>(), dqd.lpNorm<Eigen::Infinity>()});
    if (size == 0) return difference(dq, dqd, 1);
    return extrapolated_rate(
        4e-2 / size, [&](double s) { return difference(dq, dqd, s); },
        [](const Rates& a, double by_a, Rates& b, double by_b) {
          b.velocity = by_a * a.velocity + by_b * b.velocity;
          b.acceleration = by_a * a.acceleration + by_b * b.acceleration;
        });
  }

 private:
  void evaluate(const State<double>& x) {
    forward_kinematics(model_, x, k_);
    loops_.evaluate(x, k_);
  }
  Rates conditions(const State<double>& x) {
    evaluate(x);
    return {loops_.J() * as_vector(x_.qd), loops_.J() * qdd_ + loops_.gamma()};
  }
  Rates difference(const VectorXd& dq, const VectorXd& dqd, double s) {
    const Rates after = conditions(moved(model_, x_, s * dq, s * dqd));
    const Rates before = conditions(moved(model_, x_, -s * dq, -s * dqd));
    return {(after.velocity - before.velocity) / (2 * s),
            (after.acceleration - before.acceleration) / (2 * s)};
  }

  const Model<double>& model_;
  const State<double>& x_;
  LoopClosures loops_;
  Kinematics k_;
  VectorXd qdd_;
};

// Independent velocities y', and the dependent ones.
struct Split {
  std::vector<Index> independent, dependent;
  MatrixXd Z;
  MatrixXd J_dependent;

  // d with J d = rows and P d = 0.
  VectorXd lift(const VectorXd& rows) const {
    VectorXd d = VectorXd::Zero(Z.rows());
    if (!dependent.empty()) d(dependent) = min_solution(J_dependent, rows, kDependentRows);
    return d;
  }
};

// Prefers dependent velocities late in the model: a crank is independent, its rod dependent.
Split split_by(const MatrixXd& J) {
  constexpr double kPreference = 3;
  const Index n = J.cols();
  Split split;
  VectorXd weight(n);
  for (Index k = 0; k < n; ++k)
    weight[k] = 1 + kPreference * static_cast<double>(k) / static_cast<double>(n);
  Index rank = 0;
  std::vector<Index> order(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) order[static_cast<std::size_t>(k)] = k;
  if (J.rows() > 0) {
    PivotedColumns columns = pivoted_columns(J * weight.asDiagonal(), kDependentRows);
    rank = columns.rank;
    order = std::move(columns.order);
  }
  split.dependent.assign(order.begin(), order.begin() + rank);
  split.independent.assign(order.begin() + rank, order.end());
  std::ranges::sort(split.independent);
  split.Z = MatrixXd::Zero(n, n - rank);
  split.J_dependent = J(Eigen::all, split.dependent);
  for (std::size_t k = 0; k < split.independent.size(); ++k) {
    split.Z.col(signed_index(k)) = -split.lift(J.col(split.independent[k]));
    split.Z(split.independent[k], signed_index(k)) = 1;
  }
  return split;
}

// qdd at x, and applied forces with constant lambda and constant forces of mimic joints.
struct Held {
  std::vector<double> qdd;
  AppliedForces push;
};
Held hold_at(const Model<double>& model, const State<double>& x, const AppliedForces& push,
             const LoopClosures& loops) {
  const Kinematics k = kinematics_at(model, x);
  Forces<double> forces(model);
  push(x, k, forces);
  ForwardDynamics dynamics(model);
  dynamics.set_friction(false);  // joint damping is in `push`
  Workspace<double> w(model);
  if (loops.any()) {
    dynamics.bilateral().set_loops(loops);
    dynamics.bilateral().loops().evaluate(x, k);
  }
  dynamics(x, forces, w);
  const std::vector<double> mimic =
      model.mimics.empty() ? std::vector<double>(model.nv) : dynamics.torques().mimic;
  const VectorXd lambda = loops.any() ? dynamics.bilateral().lambda_of_loops() : VectorXd();
  const auto held = [&push, mimic, lambda, moving = loops](const State<double>& to,
                                                           const Kinematics& there,
                                                           Forces<double>& sum) mutable {
    push(to, there, sum);
    for (std::size_t dof = 0; dof < mimic.size(); ++dof) sum.tau[dof] += mimic[dof];
    if (!moving.any()) return;
    moving.evaluate(to, there);
    const VectorXd tau = moving.J().transpose() * lambda;
    for (std::size_t dof = 0; dof < mimic.size(); ++dof) sum.tau[dof] += tau[signed_index(dof)];
  };
  return {w.qdd, held};
}

}  // namespace

LoopedSystem linearise_with_loops(const Model<double>& model, const State<double>& x,
                                  const AppliedForces& push,
                                  const std::vector<LoopClosure>& closures,
                                  const std::vector<std::size_t>& still) {
  const LoopClosures loops(model, closures);
  Held held = hold_at(model, x, push, loops);
  const LinearSystem free = linearise(model, x, held.push);
  const Index n = signed_index(free.dofs.size());
  const MatrixXd G = mimic_projection(model);

  LoopConditions conditions(model, x, loops, held.qdd);
  const Index rows = signed_index(loops.rows());
  MatrixXd J = MatrixXd::Zero(rows + signed_index(still.size()), n);
  if (loops.any()) J.topRows(rows) = conditions.J() * G;
  for (std::size_t k = 0; k < still.size(); ++k) {
    const auto found = std::ranges::find(free.dofs, still[k]);
    if (found != free.dofs.end()) J(rows + signed_index(k), found - free.dofs.begin()) = 1;
  }
  const Split split = split_by(J);
  const MatrixXd& Z = split.Z;
  const Index ny = Z.cols();

  MatrixXd L = MatrixXd::Zero(n, ny), N_y = L, N_yd = L;
  VectorXd all = VectorXd::Zero(J.rows());
  const VectorXd none = VectorXd::Zero(signed_index(model.nv));
  for (Index k = 0; k < ny && loops.any(); ++k) {
    const VectorXd along = G * Z.col(k);
    all.head(rows) = -conditions.along(along, none).velocity;
    L.col(k) = split.lift(all);
    all.head(rows) = -conditions.along(along, G * L.col(k)).acceleration;
    N_y.col(k) = split.lift(all);
    all.head(rows) = -conditions.along(none, along).acceleration;
    N_yd.col(k) = split.lift(all);
  }

  LoopedSystem looped;
  looped.Z = G * Z;
  looped.qdd = held.qdd;
  LinearSystem& system = looped.system;
  for (const Index k : split.independent)
    system.dofs.push_back(free.dofs[static_cast<std::size_t>(k)]);
  system.A = MatrixXd::Zero(2 * ny, 2 * ny);
  system.B = MatrixXd::Zero(2 * ny, ny);
  if (ny == 0) return looped;
  const MatrixXd M = inverse_of(free.B.bottomRows(n));
  const MatrixXd a_q = free.A.bottomLeftCorner(n, n), a_qd = free.A.bottomRightCorner(n, n);
  const MatrixXd W_Z = free.A.topLeftCorner(n, n) * Z;
  const MatrixXd inverse = inverse_of(Z.transpose() * M * Z);
  system.A.topLeftCorner(ny, ny) = W_Z(split.independent, Eigen::all);
  system.A.topRightCorner(ny, ny).setIdentity();
  system.A.bottomLeftCorner(ny, ny) = inverse * Z.transpose() * M * (a_q * Z + a_qd * L - N_y);
  system.A.bottomRightCorner(ny, ny) = inverse * Z.transpose() * M * (a_qd * Z - N_yd);
  system.B.bottomRows(ny) = inverse;
  return looped;
}

Mode by_all_velocities(const LoopedSystem& looped, const Mode& mode) {
  return scaled({mode.eigenvalue, looped.Z.cast<std::complex<double>>() * mode.shape});
}

}  // namespace twinarm
