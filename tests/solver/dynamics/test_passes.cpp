// Consistency of ABA, RNEA, CRBA and M^-1 for every joint, scalar and instruction-set level.
#include <limits>

#include "solver/dynamics/dynamics.h"
#include "solver/linear_algebra/dense_algebra.h"
#include "tests/solver/dynamics/every_scalar.h"

using namespace twinarm;
using namespace twinarm::testing;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// M, h = C(q, qd, f_ext) and qdd in the scalar of the algorithms.
template <class S>
struct Dynamics {
  Workspace<S> forward, inverse, bias;
  std::vector<S> M;
  Dynamics(const Packed<S>& p, const Passes<S>& passes)
      : forward(p.model_S), inverse(p.model_S), bias(p.model_S), M(p.model.nv * p.model.nv) {
    passes.aba(p.model_S, p.x_S, p.forces_S, forward);
    passes.rnea(p.model_S, p.x_S, forward.qdd, p.forces_S.f_ext, inverse);
    passes.crba(p.model_S, p.x_S, bias, M);
    passes.rnea(p.model_S, p.x_S, std::vector<S>(p.model.nv), p.forces_S.f_ext, bias);
  }
};

// max |rnea(aba(tau)) - tau| / max(|M||qdd| + |h|) over the lanes.
template <class S>
double round_trip(const Packed<S>& p, const Passes<S>& passes) {
  const Dynamics<S> d(p, passes);
  double worst = 0;
  for (int lane = 0; lane < Scalar<S>::lanes && p.model.nv > 0; ++lane) {
    const MatrixXd M = square_of(d.M, p.model.nv, lane);
    const VectorXd qdd = lane_of(d.forward.qdd, lane), h = lane_of(d.bias.tau, lane);
    const double scale = (M.cwiseAbs() * qdd.cwiseAbs() + h.cwiseAbs()).maxCoeff();
    const VectorXd error = lane_of(d.inverse.tau, lane) - lane_of(p.forces_S.tau, lane);
    worst = std::max(worst, error.cwiseAbs().maxCoeff() / scale);
    if (!error.allFinite()) return std::numeric_limits<double>::infinity();
  }
  return worst;
}

// qdd against M^-1 (tau - h): relative to |qdd|, and in units of the amplified rounding
// eps (cond(M) |qdd| + |M^-1| (|tau| + |h|)).
struct Difference {
  double relative = 0, in_roundings = 0;
};
template <class S>
Difference against_dense(const Packed<S>& p, const Passes<S>& passes) {
  const Dynamics<S> d(p, passes);
  Difference worst;
  for (int lane = 0; lane < Scalar<S>::lanes && p.model.nv > 0; ++lane) {
    const MatrixXd M = square_of(d.M, p.model.nv, lane);
    const VectorXd tau = lane_of(p.forces_S.tau, lane), h = lane_of(d.bias.tau, lane);
    const VectorXd qdd = solve_symmetric(M, tau - h);
    const double difference = (lane_of(d.forward.qdd, lane) - qdd).norm();
    const VectorXd eigenvalues = symmetric_eigenvalues(M);
    const double magnified =
        (eigenvalues.maxCoeff() * qdd.norm() + tau.norm() + h.norm()) / eigenvalues.minCoeff();
    worst.relative = std::max(worst.relative, difference / qdd.norm());
    worst.in_roundings = std::max(
        worst.in_roundings, difference / (std::numeric_limits<double>::epsilon() * magnified));
    if (!std::isfinite(difference)) worst.in_roundings = std::numeric_limits<double>::infinity();
  }
  return worst;
}

}  // namespace

TEST_CASE("rnea inverts aba on 1000 random trees of all joints") {
  Random random(1);
  double worst = 0;
  for (int n = 0; n < 1000; ++n) {
    const Packed<double> p(random, build(uneven_bodies(random, random.integer(1, 50), kAllJoints)));
    for (const Isa isa : levels_of<double>())
      worst = std::max(worst, round_trip(p, passes<double>(isa)));
  }
  MESSAGE("largest |rnea(aba(tau)) - tau| / max(|M||qdd| + |h|) = " << worst);
  CHECK(worst <= 1e-14);
}

TEST_CASE_TEMPLATE("rnea inverts aba: each joint alone, and mixed", S, TWINARM_SCALARS) {
  Random random(2);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 60; ++n) {
      const Packed<S> p(random, build(uneven_bodies(random, random.integer(1, 12), types)));
      for (const Isa isa : levels_of<S>()) worst = std::max(worst, round_trip(p, passes<S>(isa)));
    }
  MESSAGE("largest |rnea(aba(tau)) - tau| / max(|M||qdd| + |h|) = " << worst);
  CHECK(worst <= 1e-14);
}

TEST_CASE_TEMPLATE("aba agrees with M^-1 (tau - h) of crba and rnea: each joint alone, and mixed",
                   S, TWINARM_SCALARS) {
  Random random(3);
  Difference even, uneven;
  const auto keep_larger = [](Difference& worst, const Difference& d) {
    worst.relative = std::max(worst.relative, d.relative);
    worst.in_roundings = std::max(worst.in_roundings, d.in_roundings);
  };
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 60; ++n) {
      const int size = random.integer(1, 12);
      const Packed<S> p(random, random_tree(random, size, types));
      const Packed<S> hard(random, build(uneven_bodies(random, size, types)));
      for (const Isa isa : levels_of<S>()) {
        keep_larger(even, against_dense(p, passes<S>(isa)));
        keep_larger(uneven, against_dense(hard, passes<S>(isa)));
      }
    }
  MESSAGE("up to 12 bodies: " << even.relative << ", " << even.in_roundings << " roundings");
  MESSAGE("masses up to 1e4 apart: " << uneven.relative << ", " << uneven.in_roundings
                                     << " roundings");
  CHECK(even.relative <= 1e-10);
  CHECK(even.in_roundings <= 4.5);  // 1e-15 / eps
  CHECK(uneven.in_roundings <= 4.5);
}

TEST_CASE("aba agrees with M^-1 (tau - h) up to 50 bodies within the condition of M") {
  Random random(4);
  double worst = 0;
  for (int n = 0; n < 150; ++n) {
    const Packed<double> p(random,
                           build(uneven_bodies(random, random.integer(13, 50), kAllJoints)));
    for (const Isa isa : levels_of<double>())
      worst = std::max(worst, against_dense(p, passes<double>(isa)).in_roundings);
  }
  MESSAGE("largest |qdd - M^-1 (tau - h)| = " << worst << " roundings");
  CHECK(worst <= 4.5);
}

TEST_CASE_TEMPLATE("minv_times on unit vectors is the inverse of M and symmetric", S,
                   TWINARM_SCALARS) {
  Random random(5);
  double inverse = 0, symmetric = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 10; ++n) {
      const Packed<S> p(random, random_tree(random, random.integer(1, 12), types));
      const std::size_t nv = p.model.nv;
      if (nv == 0) continue;
      for (const Isa isa : levels_of<S>()) {
        const Passes<S>& pass = passes<S>(isa);
        Workspace<S> w(p.model_S), wM(p.model_S);
        std::vector<S> all_M(nv * nv);
        pass.aba(p.model_S, p.x_S, p.forces_S, w);
        pass.crba(p.model_S, p.x_S, wM, all_M);
        std::vector<S> columns, e(nv);
        const std::vector<Force<S>> none(p.model.parent.size());
        for (std::size_t k = 0; k < nv; ++k) {
          e[k] = S(1);
          pass.minv_times(p.model_S, e, none, w);
          columns.insert(columns.end(), w.y.begin(), w.y.end());
          e[k] = S(0);
        }
        for (int lane = 0; lane < Scalar<S>::lanes; ++lane) {
          const MatrixXd Y = square_of(columns, nv, lane), M = square_of(all_M, nv, lane);
          const auto size = static_cast<Eigen::Index>(nv);
          const double condition = M.norm() * Y.norm();
          inverse = std::max(inverse, (M * Y - MatrixXd::Identity(size, size)).norm() / condition);
          symmetric = std::max(symmetric, (Y - Y.transpose()).norm() / Y.norm());
        }
      }
    }
  MESSAGE("|M Y - 1| / (|M||Y|) = " << inverse << ", |Y - Y^T| / |Y| = " << symmetric);
  CHECK(inverse <= 2e-14);
  CHECK(symmetric <= 1e-12);
}

TEST_CASE("minv_matrix is the inverse of M of either crba to rounding, symmetric to the bit") {
  Random random(8);
  double inverse = 0, forms = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 20; ++n) {
      const Packed<double> p(random, random_tree(random, random.integer(1, 20), types));
      const std::size_t nv = p.model.nv;
      if (nv == 0) continue;
      for (const Isa isa : levels_of<double>()) {
        const Passes<double>& pass = passes<double>(isa);
        Workspace<double> w(p.model);
        MatrixWorkspace<double> m(p.model);
        std::vector<double> inverse_M(nv * nv);
        pass.minv_matrix(p.model, p.x[0], w, m, inverse_M);
        std::vector<double> in_body_axes(nv * nv), in_common_axes(nv * nv);
        pass.crba_in_body_axes(p.model, p.x[0], w, in_body_axes);
        pass.crba_in_common_axes(p.model, p.x[0], w, in_common_axes);
        const MatrixXd M = square_of(in_body_axes, nv, 0), Minv = square_of(inverse_M, nv, 0);
        const auto size = static_cast<Eigen::Index>(nv);
        inverse = std::max(
            inverse, (M * Minv - MatrixXd::Identity(size, size)).norm() / (M.norm() * Minv.norm()));
        forms = std::max(forms, (M - square_of(in_common_axes, nv, 0)).norm() / M.norm());
        CHECK(Minv == Minv.transpose());
      }
    }
  MESSAGE("|M Minv - 1| / (|M||Minv|) = " << inverse << ", forms of M differ by " << forms);
  CHECK(inverse <= 2e-14);
  CHECK(forms <= 1e-14);
}

TEST_CASE("minv_times with wrenches on bodies is M^-1 J^T f, with their accelerations") {
  Random random(6);
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 20; ++n) {
      const Packed<double> p(random, random_tree(random, random.integer(1, 12), types));
      const Forces<double>& with = p.forces[0];
      Forces<double> without(p.model);
      Workspace<double> w1(p.model), w0(p.model);
      aba(p.model, p.x[0], without, w0);
      aba(p.model, p.x[0], with, w1);
      minv_times(p.model, with.tau, with.f_ext, w1);
      const VectorXd by_aba = lane_of(w1.qdd, 0) - lane_of(w0.qdd, 0);
      CHECK((lane_of(w1.y, 0) - by_aba).norm() <= 1e-12 * (1 + lane_of(w0.qdd, 0).norm()));
      for (std::size_t i = 0; i < p.model.parent.size(); ++i) {
        const Motion<double> a = w1.a[i] - w0.a[i] - w1.dv[i];
        CHECK(std::sqrt(dot(a.w, a.w) + dot(a.v, a.v)) <= 1e-10 * (1 + lane_of(w0.qdd, 0).norm()));
      }
    }
}

TEST_CASE("implicit terms: aba solves (M + armature + J^T m* J) qdd = tau - h - J^T m* a_bias") {
  Random random(7);
  double worst = 0;
  for (const auto& types : lists_of_types())
    for (int n = 0; n < 30; ++n) {
      const Model<double> model = random_tree(random, random.integer(1, 10), types);
      const State<double> x = random_state(random, model);
      Forces<double> forces = random_forces(random, model);
      for (double& armature : forces.armature) armature = random.uniform(0, 1);
      const auto nv = static_cast<Eigen::Index>(model.nv);
      if (nv == 0) continue;
      Workspace<double> w(model), wM(model);
      rnea(model, x, std::vector<double>(model.nv), forces.f_ext, wM);
      MatrixXd M = mass_matrix(model, x);
      M.diagonal() += lane_of(forces.armature, 0);
      VectorXd rhs = lane_of(forces.tau, 0) - lane_of(wM.tau, 0);
      kinematics(model, x, w);
      for (std::size_t i = 1; i < model.parent.size(); ++i) {  // a particle on every second body
        if (random.integer(0, 1)) continue;
        const double m = random.uniform(0, 100);
        const Vec3<double> r = from_eigen(random.vector(0.5)), h = m * r;
        const ArticulatedInertia<double> particle(Inertia<double>{
            m, h, Sym3<double>::scaled_identity(m * dot(r, r)) - symmetric_part_of(outer(h, r))});
        forces.add_inertia(i, particle);
        // The particle's 3-D equation of motion in body axes: J its velocity by qd, a its
        // spatial-linear acceleration at qdd = 0 with gravity; wM.a is what rnea left.
        MatrixXd J = MatrixXd::Zero(3, nv);
        Transform<double> X;  // from body b to body i
        for (std::size_t b = i; b > 0; b = static_cast<std::size_t>(model.parent[b])) {
          for (std::size_t k = model.iv[b]; k < model.iv[b] + model.dofs(b); ++k) {
            const Motion<double> s = X * w.S_[k];
            J.col(static_cast<Eigen::Index>(k)) = to_eigen(s.v + cross(s.w, r));
          }
          X = X * w.Xup[b];
        }
        M += m * J.transpose() * J;
        rhs -= m * J.transpose() * to_eigen(wM.a[i].v + cross(wM.a[i].w, r));
      }
      aba(model, x, forces, w);
      const VectorXd qdd = solve_symmetric(M, rhs);
      worst = std::max(worst, (lane_of(w.qdd, 0) - qdd).norm() / qdd.norm());
    }
  MESSAGE("largest relative difference = " << worst);
  CHECK(worst <= 1e-11);
}
