// Steps of fixed size that solve no equation: the Euler methods, Verlet, Runge-Kutta.
#pragma once

#include <array>
#include <vector>

#include "solver/integration/integration_state.h"
#include "solver/integration/integrator.h"

namespace twinarm {

// Of an explicit Runge-Kutta method: stage s looks at t + c[s] h, where the stages j < s lead by
// a[s][j]; b weighs them all.
struct Tableau {
  static constexpr int kMaxStages = 7;
  template <class T>
  using Row = std::array<T, kMaxStages>;
  int stages;
  Row<double> c, b;
  Row<Row<double>> a;
};
const Tableau& tableau_of(Integrator integrator);

// Runge-Kutta on groups. With q(t) = q exp(theta(t)) the stages are those of the method for
//   d theta/dt = dexpinv(theta, v),   dv/dt = a(q exp(theta), v).
class RungeKutta {
 public:
  explicit RungeKutta(std::size_t nv);
  // Moves m.x by h; its time and kinematics are left to the caller.
  void step(IntegrationState& m, const Tableau& tableau, double h);

  // Stage 0 is at m.x, whose acceleration m.w holds; a later one sets m.stage and asks for it.
  void first_stage(const IntegrationState& m);
  void stage(IntegrationState& m, const Tableau& tableau, int s, double h);
  // Sums of the stages' rates of change, weighed: h times it is a shift, or a change of velocity.
  double rate_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const;
  double qdd_sum(const Tableau::Row<double>& weight, int stages, std::size_t i) const;

 private:
  Tableau::Row<std::vector<double>> rate_, qdd_;  // by stage, by velocity
  std::vector<double> theta_;
};

// Both move m.x by h, but for its time and kinematics; m.w.qdd is the acceleration at m.x.
void kick(IntegrationState& m, double h);                               // v' = v + h a
void drift(IntegrationState& m, std::vector<double>& shift, double h);  // q' = q exp(h v)
void step_verlet(IntegrationState& m, std::vector<double>& shift, double h);

}  // namespace twinarm
