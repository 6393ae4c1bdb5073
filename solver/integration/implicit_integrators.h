// Steps that solve an equation for the velocity: implicit Euler, implicit midpoint, trapezoid.
//
// The unknown is a velocity u, nv numbers; the coordinates follow from it on the group:
//   implicit Euler     u at the end:       q_u = q exp(h u),           r = u - v - h a(q_u, u)
//   implicit midpoint  u in the middle:    q_u = q exp(h/2 u),         r = u - v - h/2 a(q_u, u)
//   trapezoid          u at the end:       q_u = q exp(h/2 (v + u)),   r = u - v - h/2 (a + a(q_u,
//   u))
// with a at the time that u belongs to. r(u) = 0 by Newton's method from u = v, its Jacobian by
// differences and factorised once, again only where the iteration is slow; a step that would make r
// larger is halved. It ends where rounding does not let u come closer.
// Cost of a step: nv + 1 + iterations runs of ABA, and a dense nv x nv factorisation.
#pragma once

#include <vector>

#include "solver/integration/integration_state.h"
#include "solver/integration/integrator.h"
#include "solver/integration/step_report.h"

namespace twinarm {

// Dense L U factorisation with row pivoting, in place, no allocation after the constructor.
class DenseLu {
 public:
  explicit DenseLu(std::size_t n) : n_(n), A_(n * n), pivot_(n) {}
  double& operator()(std::size_t row, std::size_t column) { return A_[row * n_ + column]; }
  void factorise();
  void solve(std::vector<double>& b) const;  // b to A^-1 b

 private:
  std::size_t n_;
  std::vector<double> A_;
  std::vector<std::size_t> pivot_;
};

class ImplicitStep {
 public:
  explicit ImplicitStep(std::size_t nv);
  // Moves m.x by h; its time and kinematics are left to the caller.
  void step(IntegrationState& m, Integrator integrator, double h, StepReport& report);

 private:
  void prepare(IntegrationState& m, Integrator integrator, double h);
  // r at u, largest entry; u and r may be the members of these names.
  double residual(IntegrationState& m, const std::vector<double>& u, std::vector<double>& r);
  void form_jacobian(IntegrationState& m);
  bool iterate(IntegrationState& m, StepReport& report);
  double search(IntegrationState& m, double size, double step, double scale);
  void finish(IntegrationState& m, Integrator integrator, double h);

  double reach_ = 0;  // weight of a(q_u, u) in r, and of u in the shift [s]
  double t_u_ = 0;    // time that u belongs to
  double trust_ = 0;  // weight of the velocity at the start in the shift [s]
  std::vector<double> u_, r_, known_, shift_, trial_, r_trial_, du_;
  DenseLu lu_;
};

}  // namespace twinarm
