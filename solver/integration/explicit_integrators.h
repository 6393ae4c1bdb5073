// Explicit integrators of fixed step size: Euler, velocity Verlet, Runge-Kutta.
#pragma once

#include <array>
#include <vector>

#include "solver/integration/integration_state.h"
#include "solver/integration/integrator.h"

namespace twinarm {

// Butcher tableau of an explicit Runge-Kutta method: stage s is at t + c[s] h, from the stages j <
// s with weights a[s][j]; b: weights of the result.
struct Tableau {
  static constexpr int kMaxStages = 7;
  template <class T>
  using Row = std::array<T, kMaxStages>;
  int stages;
  Row<double> c, b;
  Row<Row<double>> a;
};
const Tableau& tableau_of(Integrator integrator);

// Runge-Kutta method on Lie groups (Munthe-Kaas 1998): with q(t) = q exp(theta(t)),
//   d theta/dt = dexpinv(theta, v),   dv/dt = a(q exp(theta), v).
class RungeKutta {
 public:
  explicit RungeKutta(std::size_t nv) : theta_(nv) {
    rate_.fill(theta_);
    qdd_.fill(theta_);
  }
  // Advances m.x by h; the caller updates time and kinematics.
  void step(IntegrationState& m, const Tableau& tableau, double h);

  // Stage 0 is at m.x, with its acceleration in m.w; later stages set m.stage and compute it.
  void first_stage(const IntegrationState& m) {
    rate_[0] = m.x.qd;  // dexpinv(0, v) = v
    qdd_[0] = m.w.qdd;
  }
  void stage(IntegrationState& m, const Tableau& tableau, int s, double h);
  // Weighted sums of the stages' rates of theta and qd.
  double rate_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const;
  double qdd_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const;

 private:
  Tableau::Row<std::vector<double>> rate_, qdd_;  // by stage, by velocity
  std::vector<double> theta_;
};

// Advance m.x by h; the caller updates time and kinematics. m.w.qdd: acceleration at m.x.
void kick(IntegrationState& m, double h);                               // v' = v + h a
void drift(IntegrationState& m, std::vector<double>& delta, double h);  // q' = q exp(h v)
void step_verlet(IntegrationState& m, std::vector<double>& delta, double h);

}  // namespace twinarm
