// Interface of the algorithms, for the scalars double, Dual<8>, Batch<4>, Batch<8>.
//
// Implemented in solver/passes/ and compiled for plain x86-64 (`generic`) and for newer
// instruction-set levels; the highest level of the processor is selected at program start. The
// environment variable TWINARM_ISA=generic|v3|v4 limits it. Results of different levels differ by
// rounding (fused multiply-add); at one level they are bit-identical.
// All quantities are in body axes (Workspace). No function throws; zero inertia about a joint gives
// non-finite numbers (ModelBuilder rejects such models). Only mass_matrix() allocates.
#pragma once

#include <Eigen/Core>
#include <span>
#include <type_traits>
#include <vector>

#include "solver/model/trace.h"
#include "solver/passes/pass_table.h"
#include "solver/spatial/batch.h"
#include "solver/spatial/dual.h"

namespace twinarm {

enum class Isa { generic, v3, v4 };  // x86-64, and its levels 3 (AVX2, FMA) and 4 (AVX-512)
const char* name_of(Isa isa);
Isa best_isa();  // of this processor and build, capped by TWINARM_ISA

// The algorithms at `isa`, or at the highest lower level that is built and supported.
template <class S>
const Passes<S>& passes(Isa isa);
template <class S>
const Passes<S>& passes();  // at best_isa()

// Forward dynamics, solver/passes/aba.h: w.qdd and all variables of its passes.
template <class S>
void aba(const Model<S>& model, const State<S>& x, const Forces<S>& forces, Workspace<S>& w) {
  passes<S>().aba(model, x, forces, w);
}
// The same, and records Ia and pa (generic level).
void aba(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
         Workspace<double>& w, FullTrace<double>& trace);
// Inverse dynamics, solver/passes/rnea.h: w.tau and w.f for given qdd.
template <class S>
void rnea(const Model<S>& model, const State<S>& x, const std::vector<S>& qdd,
          const std::vector<Force<S>>& f_ext, Workspace<S>& w) {
  passes<S>().rnea(model, x, qdd, f_ext, w);
}
// Mass matrix, solver/passes/crba.h: M, nv x nv, row-major.
template <class S>
void crba(const Model<S>& model, const State<S>& x, Workspace<S>& w,
          std::type_identity_t<std::span<S>> M) {
  passes<S>().crba(model, x, w, M);
}
// The same as an Eigen matrix. Allocates.
Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x);
// Inverse mass matrix, solver/passes/minv_matrix.h: Minv, nv x nv, row-major.
inline void minv_matrix(const Model<double>& model, const State<double>& x, Workspace<double>& w,
                        MatrixWorkspace<double>& m, std::span<double> Minv) {
  passes<double>().minv_matrix(model, x, w, m, Minv);
}
// M^-1 (b + J^T f), solver/passes/minv.h: w.y, after aba() at the same q.
template <class S>
void minv_times(const Model<S>& model, const std::vector<S>& b, const std::vector<Force<S>>& f,
                Workspace<S>& w) {
  passes<S>().minv_times(model, b, f, w);
}
// Forward kinematics, solver/passes/kinematics_pass.h: w.X0, w.v. World axes:
// solver/dynamics/world_kinematics.h.
template <class S>
void kinematics(const Model<S>& model, const State<S>& x,
                std::type_identity_t<BodyKinematics<S>>& w) {
  passes<S>().kinematics(model, x, w);
}

}  // namespace twinarm
