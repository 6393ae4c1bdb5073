// Integration of coordinates on the joints' groups, and the integrators' names.
#pragma once

#include <string_view>
#include <vector>

#include "solver/model.h"

namespace twinarm {

enum class Integrator {
  euler,          // q' = q exp(h qd),  qd' = qd + h qdd: explicit; here to show what it costs
  semi_implicit,  // qd' = qd + h qdd,  q' = q exp(h qd')
  rk4             // classical Runge-Kutta, on the group (Munthe-Kaas 1998)
};

// q_out = q exp(shift), joint by joint; shift has one number per velocity. q_out may be q.
void integrate_coordinates(const Model<double>& model, const std::vector<double>& q,
                           const std::vector<double>& shift, std::vector<double>& q_out);

// d theta/dt for q(t) = q(0) exp(theta(t)) and velocity qd, joint by joint.
void shift_rate(const Model<double>& model, const std::vector<double>& theta,
                const std::vector<double>& qd, std::vector<double>& rate);

}  // namespace twinarm
