// Cross-checks of the ABA results by algorithms that share no pass with ABA.
//
//   v         rate of the poses along qd, by dual numbers
//   D         M_ii - M_id M_dd^-1 M_di, M of CRBA, i the rows of the joint and d those of its
//             descendants: ancestors locked, descendants free
//   U         wrench for a unit acceleration of joint i under these conditions: RNEA at rest,
//             without gravity, with qdd_d = -M_dd^-1 M_di
//   u, pA     RNEA with zero acceleration of the body and free descendants,
//             qdd_d = M_dd^-1 (tau_d - h_d): u = tau_i - h_i - M_id qdd_d, pA the wrench
//   tau, a, f RNEA with ABA's qdd
//   qdd       M qdd + h = tau, M of CRBA, h of RNEA
//   momentum  rate of momentum of each body, by central differences along the motion
//             (Richardson extrapolation to order 8), compared with the wrenches on it
//   balance   sum of the wrenches on each body, inertia included (force_balance.h)
//   loops     second difference of the constraints of loops, gears and mimic joints along the
//             motion (loop_check.cpp)
//
// Errors are relative to the largest number compared, per body or loop; a check has the largest.
// Cost O(n^4) at worst, by the Schur complements of all subtrees.
#pragma once

#include "app/inspect/inspection.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm {

struct Check {
  std::string name, meaning;
  double error = 0, tolerance = 0;
  std::string worst;  // body or constraint with the largest error
  bool pass() const { return error <= tolerance; }
};

struct CheckTolerances {
  double algebra = 1e-10;
  double momentum = 1e-9, loops = 1e-9;  // by finite differences
};

std::vector<Check> run_checks(const Inspection& in, const CheckTolerances& tolerances = {});

// Errors by body, for run_checks.
using Errors = std::vector<double>;
Errors velocity_errors(const Inspection& in);
Errors momentum_errors(const Inspection& in);
Errors balance_errors(const Inspection& in);
struct ReferenceErrors {  // by CRBA and RNEA
  Errors D, U, u, pA, tau, a, f, qdd;
};
ReferenceErrors reference_errors(const Inspection& in);
// With the name of the constraint or mimic joint.
std::vector<std::pair<std::string, double>> loop_errors(const Inspection& in);

// q exp(by qd) of every joint, prescribed motions included.
template <class S>
void move(const Model<S>& model, const std::vector<S>& qd, const S& by, State<S>& x) {
  std::vector<S> step(qd.size());
  for (std::size_t k = 0; k < qd.size(); ++k) step[k] = by * qd[k];
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    S* q = x.q.data() + model.iq[i];
    if (model.joint[i] == JointType::prescribed) {
      const S* vJ = x.prescribed.data() + model.ip[i];
      const Vec3<S> v = transpose_times(quaternion_E(q + 3), Vec3<S>{vJ[3], vJ[4], vJ[5]});
      q[0] = q[0] + by * v.x, q[1] = q[1] + by * v.y, q[2] = q[2] + by * v.z;
      const std::array<S, 3> rotation{by * vJ[0], by * vJ[1], by * vJ[2]};
      integrate_quaternion(q + 3, rotation.data(), q + 3);
    } else {
      visit_joint(model, i, [&](auto joint) { joint.integrate(q, step.data() + model.iv[i], q); });
    }
  }
}

// Richardson extrapolation of values at s, s/2, s/4, ... whose error is a series in s^2.
template <std::size_t levels, class Value>
auto extrapolated(Value value) {
  std::array<decltype(value(0)), levels> at;
  for (std::size_t level = 0; level < levels; ++level) at[level] = value(level);
  double factor = 4;
  for (std::size_t last = levels; last-- > 1; factor *= 4)
    for (std::size_t k = 0; k < last; ++k) at[k] = at[k + 1] + (at[k + 1] - at[k]) / (factor - 1);
  return at[0];
}

}  // namespace twinarm
