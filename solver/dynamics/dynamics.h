// The passes, for every scalar: double, float, Dual<8>, Batch<4>, Batch<8>.
//
// Their text is in the headers named beside them. Each is compiled for plain x86-64 (`generic`) and
// for newer levels of the instruction set; the best that the processor has is chosen when the
// program starts. TWINARM_ISA=generic|v3|v4 in the environment caps the choice: results of two
// levels differ by rounding (fused multiply-add), at one level they are the same to the bit.
// All quantities in body axes (Workspace). None of them throws or fails: where bodies have no
// inertia about a joint, numbers become non-finite (ModelBuilder refuses such models). Only
// mass_matrix() allocates.
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

// The passes at a level, or at the highest one below it that they were built for and that this
// processor has.
template <class S>
const Passes<S>& passes(Isa isa);
template <class S>
const Passes<S>& passes();  // at best_isa()

// Forward dynamics, solver/passes/aba.h: w.qdd and all of the fields of its passes.
template <class S>
void aba(const Model<S>& model, const State<S>& x, const Forces<S>& forces, Workspace<S>& w) {
  passes<S>().aba(model, x, forces, w);
}
// The same text, with what lives only while a body is handed on (generic level).
void aba(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
         Workspace<double>& w, FullTrace<double>& trace);
// Inverse dynamics, solver/passes/rnea.h: w.tau for given qdd, w.f.
template <class S>
void rnea(const Model<S>& model, const State<S>& x, const std::vector<S>& qdd,
          const std::vector<Force<S>>& f_ext, Workspace<S>& w) {
  passes<S>().rnea(model, x, qdd, f_ext, w);
}
// The mass matrix, solver/passes/crba.h: M, nv x nv row by row.
template <class S>
void crba(const Model<S>& model, const State<S>& x, Workspace<S>& w,
          std::type_identity_t<std::span<S>> M) {
  passes<S>().crba(model, x, w, M);
}
// The same as an Eigen matrix, for analyses: allocates.
Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x);
// M^-1 (b + J^T f), solver/passes/minv.h: w.y, after aba() at the same q.
template <class S>
void minv_times(const Model<S>& model, const std::vector<S>& b, const std::vector<Force<S>>& f,
                Workspace<S>& w) {
  passes<S>().minv_times(model, b, f, w);
}
// Forward kinematics, solver/passes/kinematics_pass.h: w.X0, w.v. World axes:
// solver/dynamics/world_kinematics.h.
template <class S>
void kinematics(const Model<S>& model, const State<S>& x, Workspace<S>& w) {
  passes<S>().kinematics(model, x, w);
}

}  // namespace twinarm
