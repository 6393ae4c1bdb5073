// Implicit integrators: implicit Euler, implicit midpoint, trapezoidal rule.
//
// The unknown is a velocity u; the coordinates follow on the Lie group:
//   implicit Euler     u at the end:     q_u = q exp(h u),          r = u - v - h a(q_u, u)
//   implicit midpoint  u at the middle:  q_u = q exp(h/2 u),        r = u - v - h/2 a(q_u, u)
//   trapezoid          u at the end:     q_u = q exp(h/2 (v + u)),  r = u - v - h/2 (a + a(q_u, u))
// with a(q_u, u) at the time of u. Newton's method from u = v to rounding; Jacobian by finite
// differences, recomputed if convergence is slow; backtracking line search.
// Cost of a step: nv + 1 + iterations evaluations of ABA, and a dense nv x nv factorisation.
#pragma once

#include <vector>

#include "solver/integration/integration_state.h"
#include "solver/integration/integrator.h"
#include "solver/integration/step_report.h"

namespace twinarm {

// Dense LU factorisation with row pivoting, in place; no allocation after the constructor.
class DenseLu {
 public:
  explicit DenseLu(std::size_t n) : n_(n), A_(n * n), pivot_(n) {}
  double& operator()(std::size_t row, std::size_t column) { return A_[row * n_ + column]; }
  void factorise();
  void solve(std::vector<double>& b) const;  // b := A^-1 b

 private:
  std::size_t n_;
  std::vector<double> A_;
  std::vector<std::size_t> pivot_;
};

class ImplicitStep {
 public:
  explicit ImplicitStep(std::size_t nv);
  // Advances m.x by h; the caller updates time and kinematics.
  void step(IntegrationState& m, Integrator integrator, double h, StepReport& report);

 private:
  void prepare(IntegrationState& m, Integrator integrator, double h);
  // r at u; returns max |r_i|. u and r may be members.
  double residual(IntegrationState& m, const std::vector<double>& u, std::vector<double>& r);
  void form_jacobian(IntegrationState& m);
  bool iterate(IntegrationState& m, StepReport& report);
  double line_search(IntegrationState& m, double size, double step, double scale);
  void finish(IntegrationState& m, Integrator integrator, double h);

  double weight_u_ = 0;  // of a(q_u, u) in r, and of u in the coordinate increment [s]
  double weight_v_ = 0;  // of the velocity at the start in the coordinate increment [s]
  double t_u_ = 0;       // time of u
  std::vector<double> u_, r_, known_, delta_, trial_, r_trial_, du_;
  DenseLu lu_;
};

}  // namespace twinarm
