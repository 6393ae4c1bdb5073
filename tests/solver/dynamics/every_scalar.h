// All scalars and instruction-set levels of the algorithms, for parametrized tests. A scalar with
// lanes has several states of one model.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <vector>

#include "solver/dynamics/dynamics.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/convert_model.h"
#include "tests/solver/dynamics/random_tree.h"

#define TWINARM_SCALARS double, twinarm::Dual<8>, twinarm::Batch<4>, twinarm::Batch<8>
TYPE_TO_STRING(twinarm::Dual<8>);
TYPE_TO_STRING(twinarm::Batch<4>);
TYPE_TO_STRING(twinarm::Batch<8>);

namespace twinarm::testing {

template <class S>
struct Scalar {  // double
  static constexpr int lanes = 1;
  static void set(S& s, int, double x) { s = x; }
  static double get(const S& s, int) { return s; }
};
template <int N>
struct Scalar<Dual<N>> {
  static constexpr int lanes = 1;
  static void set(Dual<N>& s, int, double x) { s.value = x; }
  static double get(const Dual<N>& s, int) { return s.value; }
};
template <int N>
struct Scalar<Batch<N>> {
  static constexpr int lanes = N;
  static void set(Batch<N>& s, int lane, double x) { s.set(lane, x); }
  static double get(const Batch<N>& s, int lane) { return s[lane]; }
};

// Levels with code for this scalar that this processor supports.
template <class S>
std::vector<Isa> levels_of() {
  std::vector<Isa> levels;
  for (const Isa isa : {Isa::generic, Isa::v3, Isa::v4})
    if (isa <= best_isa() && (levels.empty() || &passes<S>(isa) != &passes<S>(levels.back())))
      levels.push_back(isa);
  return levels;
}

template <class S>
void set(Vec3<S>& to, int lane, const Vec3<double>& from) {
  Scalar<S>::set(to.x, lane, from.x);
  Scalar<S>::set(to.y, lane, from.y);
  Scalar<S>::set(to.z, lane, from.z);
}
template <class S>
void set(Sym3<S>& to, int lane, const Sym3<double>& from) {
  Scalar<S>::set(to.xx, lane, from.xx), Scalar<S>::set(to.yy, lane, from.yy);
  Scalar<S>::set(to.zz, lane, from.zz), Scalar<S>::set(to.xy, lane, from.xy);
  Scalar<S>::set(to.xz, lane, from.xz), Scalar<S>::set(to.yz, lane, from.yz);
}
template <class S>
void set(std::vector<S>& to, int lane, const std::vector<double>& from) {
  for (std::size_t k = 0; k < to.size(); ++k) Scalar<S>::set(to[k], lane, from[k]);
}
template <class S>
void set(Forces<S>& to, int lane, const Forces<double>& from) {
  set(to.tau, lane, from.tau);
  set(to.armature, lane, from.armature);
  to.has_added_inertia = from.has_added_inertia;
  for (std::size_t i = 0; i < to.f_ext.size(); ++i) {
    set(to.f_ext[i].n, lane, from.f_ext[i].n);
    set(to.f_ext[i].f, lane, from.f_ext[i].f);
    set(to.added_inertia[i].I, lane, from.added_inertia[i].I);
    set(to.added_inertia[i].M, lane, from.added_inertia[i].M);
    set(to.added_inertia[i].H.r0, lane, from.added_inertia[i].H.r0);
    set(to.added_inertia[i].H.r1, lane, from.added_inertia[i].H.r1);
    set(to.added_inertia[i].H.r2, lane, from.added_inertia[i].H.r2);
  }
}
template <class S>
Eigen::VectorXd lane_of(const std::vector<S>& v, int lane) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(v.size()));
  for (std::size_t k = 0; k < v.size(); ++k)
    out[static_cast<Eigen::Index>(k)] = Scalar<S>::get(v[k], lane);
  return out;
}
template <class S>
Eigen::MatrixXd square_of(const std::vector<S>& v, std::size_t n, int lane) {
  const auto size = static_cast<Eigen::Index>(n);
  return lane_of(v, lane).reshaped(size, size).transpose();  // row by row
}

inline Forces<double> random_forces(Random& random, const Model<double>& model) {
  Forces<double> forces(model);
  for (double& tau : forces.tau) tau = random.uniform(-5, 5);
  for (Force<double>& f : forces.f_ext)
    f = {from_eigen(random.vector(3)), from_eigen(random.vector(3))};
  return forces;
}

// One model; each lane has its own state and forces.
template <class S>
struct Packed {
  Model<double> model;
  std::vector<State<double>> x;
  std::vector<Forces<double>> forces;
  Model<S> model_S;
  State<S> x_S;
  Forces<S> forces_S;

  Packed(Random& random, Model<double> m)
      : model(std::move(m)), model_S(convert<S>(model)), x_S(model_S), forces_S(model_S) {
    for (int lane = 0; lane < Scalar<S>::lanes; ++lane) {
      x.push_back(random_state(random, model));
      forces.push_back(random_forces(random, model));
    }
    pack();
  }
  void pack() {
    for (int lane = 0; lane < Scalar<S>::lanes; ++lane) {
      const auto k = static_cast<std::size_t>(lane);
      set(x_S.q, lane, x[k].q);
      set(x_S.qd, lane, x[k].qd);
      set(x_S.prescribed, lane, x[k].prescribed);
      set(forces_S, lane, forces[k]);
    }
  }
};

}  // namespace twinarm::testing
