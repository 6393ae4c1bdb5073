// What a coupling carries: sag under a load, and what a wall feels like through it.
#pragma once

#include <Eigen/Core>

namespace twinarm {

// A point spring at lever arm r, treated implicitly with step h on an inertia I about the joint, is
// stable only while its target's radius R_K stays below this [m]:
//   h^2 k r R_K < 4 I + 2 r^2 (h^2 k + h b).
double largest_target_radius(double I, double r, double k, double b, double h);

// Where a chain rests below its target [rad, m] under the generalised forces G, small angles:
// K_q^-1 G. Coordinates that no spring holds are not a number.
Eigen::VectorXd chain_sag(const Eigen::MatrixXd& K, const Eigen::VectorXd& G);

// Two springs in series: what a wall k_e feels like through a coupling k_c (Colgate, Stanley and
// Brown 1995). Either may be infinite.
double series_stiffness(double k_c, double k_e);

}  // namespace twinarm
