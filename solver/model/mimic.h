// Mimic joints: q_f = ratio q_l + offset and qd_f = ratio qd_l, l the mimicked joint
// (Model::mimics).
//
// Each is a velocity constraint A qd = 0 with the row e_f - ratio e_l; loop_forces.h solves for its
// force.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "solver/model/model.h"

namespace twinarm {

// Sets position and velocity of all mimic joints.
void apply_mimics(const Model<double>& model, State<double>& x);

// qd = G y, y the velocities of the independent joints. In y the mass matrix is G^T M G and a
// generalised force b becomes G^T b.
Eigen::SparseMatrix<double> mimic_projection(const Model<double>& model);  // G, nv x ny
std::vector<std::size_t> independent_dofs(const Model<double>& model);     // ny indices, ascending

}  // namespace twinarm
