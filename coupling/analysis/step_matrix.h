// Step matrix of several couplings, each with its discretization, under an integrator, and the
// stability limit.
//
// With M = 1, e the error, h v its rate and f_g the accelerations by held forces, the acceleration
// times h^2 is
//   a = inertia^-1 ( - alpha e - (beta + lead) h v + sum_g f_g )
//   alpha = h^2 K, beta = h B     of all terms that are not held
//   lead = h^2 K_zero             of implicit terms
//   inertia = 1 + lead + h B      of implicit terms, with h B of implicit dampers
// K includes the geometric stiffness, K_zero does not: the added inertia depends on the latter
// only, hence the limit of an implicit point spring.
//
// Other laws (docs/understand/coupling_laws.md): as published, the rate of a held force is
// (e - e at the previous evaluation)/n, n steps apart, or one frame older, (e at the previous
// evaluation - e at the one before)/n; stable PD has `lead` and inertia = 1 + h B; a god object has
// a_u = -(e + h v)/h^2 and adds -M_r (e + h v), M_r the rows of M of its robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupling/laws/coupling_spec.h"
#include "solver/integration/integrator.h"

namespace twinarm {

struct CoupledTerm {
  Eigen::MatrixXd K, K_zero, B;                               // tangent stiffness; J^T k J; J^T b J
  Discretization discretization = Discretization::explicit_;  // of a spring-damper
  // Zero-order hold over n steps; 0: evaluated at each stage (as published: each step).
  int hold_steps = 0;
  StepLaw law = StepLaw::spring_damper;  // god object: K = M_r only
  bool older = false;                    // as published: difference one frame older
};

// Spectral radius per step of h, of terms in coordinates with M = 1.
double growth_of_modes(const std::vector<CoupledTerm>& parts, Integrator integrator, double h);

// Growth factor of the error per step of h; stable if at most 1. Not for dopri5 (adaptive step).
double spectral_radius(const Eigen::MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator, double h);

// The largest stable step of all terms together; kNoLimit if there is none, and for dopri5.
double max_stable_step(const Eigen::MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator);

}  // namespace twinarm
