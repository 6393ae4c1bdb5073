// Table of function pointers: the algorithms for one scalar and one instruction-set level.
#pragma once

#include <span>
#include <vector>

#include "solver/model/matrix_workspace.h"

namespace twinarm {

struct ConstraintWorkspace;

// Those whose results are matrices, of double only.
template <class S>
struct MatrixPasses {};
template <>
struct MatrixPasses<double> {
  void (*rnea_derivatives)(const Model<double>&, const State<double>&, const Forces<double>&,
                           const std::vector<double>&, Workspace<double>&, MatrixWorkspace<double>&,
                           std::span<double>);
  void (*minv_matrix)(const Model<double>&, const State<double>&, Workspace<double>&,
                      MatrixWorkspace<double>&, std::span<double>);
  void (*constraint_factors)(const Model<double>&, const Workspace<double>&, ConstraintWorkspace&,
                             std::size_t, std::size_t);
  void (*constraint_forces)(const Model<double>&, ConstraintWorkspace&, const std::vector<double>&,
                            std::size_t, std::size_t);
  void (*constraint_accelerations)(const Model<double>&, ConstraintWorkspace&, std::size_t,
                                   std::size_t);
  void (*aba_derivatives)(const Model<double>&, const State<double>&, const Forces<double>&,
                          Workspace<double>&, MatrixWorkspace<double>&, AbaDerivatives<double>&);
};

template <class S>
struct Passes : MatrixPasses<S> {
  void (*aba)(const Model<S>&, const State<S>&, const Forces<S>&, Workspace<S>&);
  void (*rnea)(const Model<S>&, const State<S>&, const std::vector<S>&,
               const std::vector<Force<S>>&, Workspace<S>&);
  using MassMatrix = void(const Model<S>&, const State<S>&, Workspace<S>&, std::span<S>);
  MassMatrix *crba_in_body_axes, *crba_in_common_axes;
  void (*minv_times)(const Model<S>&, const std::vector<S>&, const std::vector<Force<S>>&,
                     Workspace<S>&);
  void (*kinematics)(const Model<S>&, const State<S>&, BodyKinematics<S>&);

  void crba(const Model<S>& model, const State<S>& x, Workspace<S>& w, std::span<S> M) const {
    (model.is_deep ? crba_in_common_axes : crba_in_body_axes)(model, x, w, M);
  }
};

}  // namespace twinarm
