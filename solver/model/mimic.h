// Joints that follow others: qd_f = ratio qd_l and q_f = ratio q_l + offset (Model::mimics).
//
// Each is a constraint on velocities, A qd = 0 with the row a = e_f - ratio e_l; loop_forces.h
// solves for its force.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/model/model.h"

namespace twinarm {

// Places the followers, and sets their velocities, by their leaders.
void apply_mimics(const Model<double>& model, State<double>& x);

// qd = G y, y the velocities that follow nobody. The mass matrix in y is G^T M G, a generalised
// force b becomes G^T b: what acts on a follower counts through its ratio.
Eigen::MatrixXd mimic_projection(const Model<double>& model);           // G, nv x ny
std::vector<std::size_t> independent_dofs(const Model<double>& model);  // ny indices, ascending

}  // namespace twinarm
