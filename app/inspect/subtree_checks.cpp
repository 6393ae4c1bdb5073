// D, U, u and pA from the equations of motion of each subtree; tau, a, f and qdd from those of all.
#include <tuple>

#include "app/inspect/cross_checks.h"
#include "solver/linear_algebra/dense_algebra.h"

namespace twinarm {
namespace {

// Zero velocities, prescribed motions included.
State<double> at_rest(State<double> x) {
  std::ranges::fill(x.qd, 0);
  std::ranges::fill(x.prescribed, 0);
  return x;
}

// Equations of motion by CRBA and RNEA, implicit terms included:
//   M = M_crba + sum J^T added_inertia J + armature,   h = RNEA at qdd = 0 with f - added_inertia
//   a_0.
class CrbaRneaReference {
 public:
  explicit CrbaRneaReference(const Inspection& in)
      : in_(in), weightless_(in.model), rest_(at_rest(in.x)), w_(in.model) {
    weightless_.gravity = {};
    const auto nv = static_cast<Eigen::Index>(in.model.nv);
    M_.resize(nv, nv);
    crba(in.model, in.x, w_, {M_.data(), in.model.nv * in.model.nv});
    add_implicit();
  }

  const Eigen::MatrixXd& M() const { return M_; }

  struct Result {
    Eigen::VectorXd tau;            // by velocity
    std::vector<Motion<double>> a;  // by body
    std::vector<Force<double>> f;   // through each joint
  };
  // Inverse dynamics tau = M qdd + h. With `subtree` = i > 0, of the subtree of body i for a parent
  // motion such that a_i = S qdd_i: its rigid acceleration is subtracted.
  Result inverse(const Eigen::VectorXd& qdd, std::size_t subtree = 0) {
    Result first = run(in_.model, in_.x, qdd, in_.forces.f_ext);
    if (subtree == 0 && !in_.forces.has_added_inertia) return first;
    std::vector<Force<double>> f_ext = in_.forces.f_ext;
    std::vector<Motion<double>> rigid(in_.body_count());  // of the subtree, with body i
    if (subtree > 0) {
      rigid[subtree] = first.a[subtree];
      for (std::size_t dof = in_.model.iv[subtree];
           dof < in_.model.iv[subtree] + in_.model.dofs(subtree); ++dof)
        rigid[subtree] += -qdd[static_cast<Eigen::Index>(dof)] * w_.S_[dof];
    }
    for (std::size_t b = 1; b < in_.body_count(); ++b) {
      if (subtree > 0 && b > subtree && in_.is_below(b, subtree))
        rigid[b] = w_.Xup[b] * rigid[in_.parent(b)];
      f_ext[b] += in_.model.I[b] * rigid[b];
      if (in_.forces.has_added_inertia)
        f_ext[b] += -(in_.forces.added_inertia[b] * (first.a[b] - rigid[b]));
    }
    return run(in_.model, in_.x, qdd, f_ext);
  }
  // At rest, without gravity or forces: tau = M qdd.
  Result inertial(const Eigen::VectorXd& qdd) {
    const std::vector<Force<double>> none(in_.body_count());
    Result result = run(weightless_, rest_, qdd, none);
    if (!in_.forces.has_added_inertia) return result;
    std::vector<Force<double>> implicit(in_.body_count());
    for (std::size_t b = 1; b < in_.body_count(); ++b)
      implicit[b] = -(in_.forces.added_inertia[b] * result.a[b]);
    return run(weightless_, rest_, qdd, implicit);
  }

  // Velocity indices of joint i, and of its descendants.
  struct Rows {
    std::vector<Eigen::Index> own, below;
  };
  Rows rows_of(std::size_t body) const {
    Rows rows;
    for (std::size_t j = body; j < in_.body_count(); ++j) {
      if (!in_.is_below(j, body)) continue;
      for (std::size_t dof = in_.model.iv[j]; dof < in_.model.iv[j] + in_.model.dofs(j); ++dof)
        (j == body ? rows.own : rows.below).push_back(static_cast<Eigen::Index>(dof));
    }
    return rows;
  }

 private:
  // J of body b in its own axes has the columns X S_j of its ancestors' joints, X from j to b.
  void add_implicit() {
    for (std::size_t dof = 0; dof < in_.model.nv; ++dof)
      M_(static_cast<Eigen::Index>(dof), static_cast<Eigen::Index>(dof)) +=
          in_.forces.armature[dof];
    if (!in_.forces.has_added_inertia) return;
    std::vector<std::pair<std::size_t, Motion<double>>> columns;
    for (std::size_t b = 1; b < in_.body_count(); ++b) {
      columns.clear();
      Transform<double> X;
      for (std::size_t j = b; j > 0; j = in_.parent(j)) {
        for (std::size_t dof = in_.model.iv[j]; dof < in_.model.iv[j] + in_.model.dofs(j); ++dof)
          columns.emplace_back(dof, X * w_.S_[dof]);
        X = X * w_.Xup[j];
      }
      for (const auto& [row, J_row] : columns)
        for (const auto& [col, J_col] : columns)
          M_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(col)) +=
              dot(J_row, in_.forces.added_inertia[b] * J_col);
    }
  }

  Result run(const Model<double>& model, const State<double>& x, const Eigen::VectorXd& qdd,
             const std::vector<Force<double>>& f_ext) {
    rnea(model, x, {qdd.begin(), qdd.end()}, f_ext, w_);
    Result result{Eigen::Map<const Eigen::VectorXd>(w_.tau.data(), qdd.size()), w_.a, w_.f};
    for (Eigen::Index k = 0; k < qdd.size(); ++k)
      result.tau[k] += in_.forces.armature[static_cast<std::size_t>(k)] * qdd[k];
    return result;
  }

  const Inspection& in_;
  Model<double> weightless_;
  State<double> rest_;
  Workspace<double> w_;
  Eigen::MatrixXd M_;
};

Vector6 as_vector(const Force<double>& f) {
  return (Vector6() << f.n.x, f.n.y, f.n.z, f.f.x, f.f.y, f.f.z).finished();
}

template <class A, class B>
double relative_difference(const A& a, const B& b, double scale) {
  if (a.size() == 0) return 0;
  const double error = (a - b).template lpNorm<Eigen::Infinity>();
  return error == 0 ? 0 : error / scale;
}
template <class A>
double size_of(const A& a) {
  return a.size() == 0 ? 0 : a.template lpNorm<Eigen::Infinity>();
}

// Errors of one body, relative to the terms of the Schur complement: the apparent inertia through
// free joints may be small compared with that through locked joints.
class Subtree {
 public:
  Subtree(const Inspection& in, CrbaRneaReference& reference, std::size_t body)
      : in_(in), reference_(reference), body_(body), rows_(reference.rows_of(body)) {
    M_ii_ = reference.M()(rows_.own, rows_.own);
    M_id_ = reference.M()(rows_.own, rows_.below);
    M_dd_ = reference.M()(rows_.below, rows_.below);
  }

  double D_error() const {
    const auto nv = static_cast<Eigen::Index>(rows_.own.size());
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> D(in_.w.D.data() + in_.w.iD[body_], nv, nv);
    const Eigen::MatrixXd expected = M_ii_ - M_id_ * solve_below(M_id_.transpose());
    return relative_difference(D, expected, size_of(M_ii_));
  }

  double U_error() const {
    double worst = 0;
    const Eigen::MatrixXd below = solve_below(M_id_.transpose());
    for (std::size_t k = 0; k < rows_.own.size(); ++k) {
      Eigen::VectorXd qdd = Eigen::VectorXd::Zero(reference_.M().rows());
      qdd[rows_.own[k]] = 1;
      const CrbaRneaReference::Result locked = reference_.inertial(qdd);
      for (std::size_t d = 0; d < rows_.below.size(); ++d)
        qdd[rows_.below[d]] = -below(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(k));
      const Vector6 expected = as_vector(reference_.inertial(qdd).f[body_]);
      const Vector6 U = as_vector(in_.w.U[static_cast<std::size_t>(rows_.own[k])]);
      worst =
          std::max(worst, relative_difference(U, expected, size_of(as_vector(locked.f[body_]))));
    }
    return worst;
  }

  // Errors of u and of pA, relative to `load` at least.
  std::pair<double, double> bias_errors(double load) const {
    const Eigen::VectorXd all_tau = Eigen::Map<const Eigen::VectorXd>(
        in_.forces.tau.data(), static_cast<Eigen::Index>(in_.forces.tau.size()));
    Eigen::VectorXd qdd = Eigen::VectorXd::Zero(reference_.M().rows());
    const CrbaRneaReference::Result locked = reference_.inverse(qdd, body_);
    const Eigen::VectorXd net = all_tau - locked.tau;
    const Eigen::VectorXd below = solve_below(net(rows_.below));
    qdd(rows_.below) = below;
    const CrbaRneaReference::Result free = reference_.inverse(qdd, body_);
    const Vector6 expected_pA = as_vector(free.f[body_]), pA = as_vector(in_.w.pA[body_]);
    const double scale =
        std::max({size_of(expected_pA), size_of(as_vector(locked.f[body_])), load});

    const Eigen::VectorXd reaction = M_id_ * below;
    const Eigen::VectorXd expected_u = Eigen::VectorXd(net(rows_.own)) - reaction;
    const Eigen::Map<const Eigen::VectorXd> u(in_.w.u.data() + in_.model.iv[body_],
                                              expected_u.size());
    return {relative_difference(u, expected_u,
                                std::max({scale, size_of(expected_u), size_of(reaction)})),
            relative_difference(pA, expected_pA, scale)};
  }

 private:
  Eigen::MatrixXd solve_below(const Eigen::MatrixXd& b) const {
    return rows_.below.empty() ? b : solve_symmetric(M_dd_, b);
  }

  const Inspection& in_;
  CrbaRneaReference& reference_;
  std::size_t body_;
  CrbaRneaReference::Rows rows_;
  Eigen::MatrixXd M_ii_, M_id_, M_dd_;
};

// Scale of the wrenches at a body, which may cancel in the results that are compared.
double load_on(const Inspection& in, const CrbaRneaReference::Result& without_qdd, std::size_t i) {
  const Force<double> inertial = in.model.I[i] * in.w.a[i];
  const double weight = in.model.I[i].m * to_eigen(in.model.gravity).norm();
  return std::max({size_of(as_vector(without_qdd.f[i])), size_of(as_vector(inertial)),
                   size_of(as_vector(in.w.pA[i])), weight, 1e-300});
}

}  // namespace

ReferenceErrors reference_errors(const Inspection& in) {
  CrbaRneaReference reference(in);
  const auto nv = static_cast<Eigen::Index>(in.model.nv);
  const Eigen::Map<const Eigen::VectorXd> qdd(in.w.qdd.data(), nv), tau(in.forces.tau.data(), nv);
  const CrbaRneaReference::Result with_qdd = reference.inverse(qdd),
                                  without_qdd = reference.inverse(Eigen::VectorXd::Zero(nv));
  const Eigen::VectorXd M_qdd = reference.M() * qdd;
  const Errors zero(in.body_count());
  ReferenceErrors errors{zero, zero, zero, zero, zero, zero, zero, zero};
  for (std::size_t i = 1; i < in.body_count(); ++i) {
    const Subtree subtree(in, reference, i);
    errors.D[i] = subtree.D_error();
    errors.U[i] = subtree.U_error();
    const double own_load = load_on(in, without_qdd, i);
    std::tie(errors.u[i], errors.pA[i]) = subtree.bias_errors(own_load);
    const auto first = static_cast<Eigen::Index>(in.model.iv[i]);
    const auto count = static_cast<Eigen::Index>(in.model.dofs(i));
    const Vector6 f = as_vector(with_qdd.f[i]);
    const double load = std::max(own_load, size_of(f));
    if (count > 0) {
      const Eigen::VectorXd t = tau.segment(first, count);
      const double size = std::max(size_of(t), load);
      errors.tau[i] =
          relative_difference(t, Eigen::VectorXd(with_qdd.tau.segment(first, count)), size);
      const Eigen::VectorXd sum =
          M_qdd.segment(first, count) + without_qdd.tau.segment(first, count);
      const double terms = (reference.M().middleRows(first, count).cwiseAbs() * qdd.cwiseAbs())
                               .lpNorm<Eigen::Infinity>();
      errors.qdd[i] = relative_difference(sum, t, std::max(terms, size));
    }
    const Motion<double>&a = in.w.a[i], &b = with_qdd.a[i];
    const Vector6 a6 = (Vector6() << to_eigen(a.w), to_eigen(a.v)).finished();
    const Vector6 b6 = (Vector6() << to_eigen(b.w), to_eigen(b.v)).finished();
    const double g = to_eigen(in.model.gravity).norm();
    errors.a[i] = relative_difference(a6, b6, std::max({size_of(b6), size_of(qdd), g, 1e-300}));
    errors.f[i] = relative_difference(as_vector(in.w.IA[i] * in.w.a[i] + in.w.pA[i]), f, load);
  }
  return errors;
}

}  // namespace twinarm
