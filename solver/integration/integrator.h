// List of integrators with names, orders and formulas.
//
// A step of size h goes from (q, v) to (q', v'). a(q, v): forward dynamics (ABA); q exp(theta):
// solver/model/configuration.h. Runge-Kutta methods integrate theta (Munthe-Kaas 1998).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace twinarm {

enum class Integrator {
  euler,              // q' = q exp(h v),   v' = v + h a(q, v)
  semi_implicit,      // v' = v + h a(q, v),   q' = q exp(h v')
  semi_implicit_xv,   // q' = q exp(h v),   v' = v + h a(q', v)
  verlet,             // velocity Verlet: q' = q exp(h v + h^2/2 a), v' = v + h/2 (a + a'),
                      //   a' = a(q', v + h a): with the predicted velocity also second order for
                      //   velocity-dependent forces
  midpoint,           // Runge-Kutta of order 2
  heun,               // Runge-Kutta of order 2
  rk4,                // the classical Runge-Kutta method
  dopri5,             // Dormand-Prince 5(4): adaptive, to a tolerance
  implicit_euler,     // v' = v + h a(q', v'),   q' = q exp(h v')
  implicit_midpoint,  // u = v + h/2 a(q exp(h/2 u), u),   v' = 2u - v,   q' = q exp(h u)
  trapezoid           // v' = v + h/2 (a(q, v) + a(q', v')),   q' = q exp(h/2 (v + v'))
};

struct IntegratorFacts {
  Integrator integrator;
  const char* name;     // on the command line, in files and reports
  int order;            // global error O(h^order)
  bool solves;          // solves an equation in each step (StepReport::converged)
  bool implicit_force;  // supports sources that are implicit in the step (needs_semi_implicit)
};
inline constexpr std::array<IntegratorFacts, 11> all_integrators{{
    {Integrator::euler, "euler", 1, false, false},
    {Integrator::semi_implicit, "semi-implicit", 1, false, true},
    {Integrator::semi_implicit_xv, "semi-implicit-xv", 1, false, true},
    {Integrator::verlet, "verlet", 2, false, false},
    {Integrator::midpoint, "midpoint", 2, false, false},
    {Integrator::heun, "heun", 2, false, false},
    {Integrator::rk4, "rk4", 4, false, false},
    {Integrator::dopri5, "dopri5", 5, false, false},
    {Integrator::implicit_euler, "implicit-euler", 1, true, false},
    {Integrator::implicit_midpoint, "implicit-midpoint", 2, true, false},
    {Integrator::trapezoid, "trapezoid", 2, true, false},
}};
constexpr const IntegratorFacts& facts_of(Integrator integrator) {
  return all_integrators[static_cast<std::size_t>(integrator)];
}
constexpr const char* integrator_name(Integrator integrator) {
  return facts_of(integrator).name;
}
constexpr std::optional<Integrator> find_integrator(std::string_view name) {
  for (const IntegratorFacts& facts : all_integrators)
    if (name == facts.name) return facts.integrator;
  return std::nullopt;
}

}  // namespace twinarm
