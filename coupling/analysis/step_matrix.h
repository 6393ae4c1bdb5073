// Several couplings, each with its own treatment, as an integrator steps them together: the step
// matrix about a pose and its limit.
//
// In coordinates with M = 1, with e the error, h v its rate and f_g the accelerations by forces
// that are held, an acceleration is
//   a = felt^-1 ( - alpha e - (beta + ahead) h v + sum_g f_g ),     times h^2
//   alpha = h^2 K, beta = h B     of all that is not held
//   ahead = h^2 K_zero            of what is implicit
//   felt = 1 + ahead + h B        of what is implicit, with h B of a damper that is
// K has the geometric stiffness in it, K_zero has not: m* knows only the latter, which is why a
// point spring has a limit even where it is implicit.
//
// Laws that are no such spring-damper (docs/understand/coupling_laws.md): as printed, the rate that
// a held force sees is (e - e at the evaluation before)/n, n steps between the two; stable PD has
// `ahead`, and felt = 1 + h B alone; a god object has a_u = -(e + h v)/h^2, so what it adds is
// -M_r (e + h v), with M_r the rows of M that belong to its robot. As printed with a difference one
// frame older, it is (e at the evaluation before - e at the one before that)/n.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "coupling/laws/coupling_spec.h"
#include "solver/integration/integrator.h"

namespace twinarm {

struct CoupledTerm {
  Eigen::MatrixXd K, K_zero, B;  // as it is about the pose; J^T k J alone; J^T b J
  Discretization treatment = Discretization::explicit_;  // of a spring-damper
  // The force is computed every so many steps, and held; 0: at each stage (as printed: each step).
  int hold_steps = 0;
  StepLaw law = StepLaw::spring_damper;  // a god object has M_r for K, and nothing else
  bool older = false;                    // as printed: the difference is one frame older
};

// Of parts in coordinates with M = 1 that all count: the spectral radius of a step of h (of all
// steps between two evaluations, for held forces, its root).
double growth_of_modes(const std::vector<CoupledTerm>& parts, Integrator integrator, double h);

// By how much the error grows in a step of h, in the long run. At most 1: stable. Not for dopri5,
// which chooses its step.
double spectral_radius(const Eigen::MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator, double h);

// The largest stable step of all parts together; kNoLimit where there is none, and for dopri5.
double max_stable_step(const Eigen::MatrixXd& M, const std::vector<CoupledTerm>& parts,
                       Integrator integrator);

}  // namespace twinarm
