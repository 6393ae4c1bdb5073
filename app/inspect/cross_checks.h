// Second ways to what ABA found, that share no pass with it.
//
//   v         rate of the poses along qd, by dual numbers
//   D         with M of CRBA, i the joint's rows and d those of its descendants:
//             D = M_ii - M_id M_dd^-1 M_di, the inertia felt with the ancestors locked and the
//             descendants free
//   U         the wrench that moves joint i by a unit acceleration then: RNEA at rest, without
//             gravity, with qdd_d = -M_dd^-1 M_di
//   u, pA     RNEA where the body itself does not accelerate and its descendants do as they like,
//             qdd_d = M_dd^-1 (tau_d - h_d):  u = tau_i - h_i - M_id qdd_d, pA = the wrench
//   tau, a, f RNEA with the qdd that was found
//   qdd       M qdd + h = tau, M of CRBA, h of RNEA
//   momentum  each body's rate of momentum, by central differences along the motion
//             (Richardson's extrapolation to order 8), against the wrenches on it
//   balance   the wrenches on each body and its inertia sum to zero (force_balance.h)
//   loops     what closed loops, gears and followers ask of poses, differenced twice along the
//             motion that was found: it stays closed (loop_check.cpp)
//
// Errors are parts of the largest number of what is compared, per body or loop; a check tells the
// worst.
// Cost O(n^4) at worst, by the Schur complements of all subtrees.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"
#include "solver/dynamics/dynamics.h"

namespace twinarm {

struct Check {
  std::string name, meaning;
  double error = 0, tolerance = 0;
  std::string worst;  // the body, or the constraint, where the error is
  bool pass() const { return error <= tolerance; }
};

struct CheckTolerances {
  double algebra = 1e-10;                // of all but:
  double momentum = 1e-9, loops = 1e-9;  // by differences
};

std::vector<Check> run_checks(const Inspection& in, const CheckTolerances& tolerances = {});

// The parts of run_checks: errors by body.
using Errors = std::vector<double>;
Errors velocity_errors(const Inspection& in);
Errors momentum_errors(const Inspection& in);
Errors balance_errors(const Inspection& in);
struct SubtreeErrors {
  Errors D, U, u, pA;
};
SubtreeErrors subtree_errors(const Inspection& in);
struct WholeErrors {
  Errors tau, a, f, qdd;
};
WholeErrors whole_errors(const Inspection& in);
struct NamedError {
  std::string name;  // of the constraint, or of the joint that follows
  double error;
};
std::vector<NamedError> loop_errors(const Inspection& in);

// Curves that have the velocity and the acceleration of a motion at s = 0, for rates by
// differences.

// q exp(shift) of every joint, also of those whose motion is given; shift = qd times a number.
template <class S>
void move(const Model<S>& model, const std::vector<S>& qd, const S& by, State<S>& x) {
  std::vector<S> shift(qd.size());
  for (std::size_t k = 0; k < qd.size(); ++k) shift[k] = by * qd[k];
  for (std::size_t i = 1; i < model.parent.size(); ++i) {
    S* q = x.q.data() + model.iq[i];
    if (model.joint[i] == JointType::prescribed) {
      const S* vJ = x.prescribed.data() + model.ip[i];
      const Vec3<S> v = transpose_times(quaternion_E(q + 3), Vec3<S>{vJ[3], vJ[4], vJ[5]});
      q[0] = q[0] + by * v.x, q[1] = q[1] + by * v.y, q[2] = q[2] + by * v.z;
      const std::array<S, 3> turn{by * vJ[0], by * vJ[1], by * vJ[2]};
      integrate_quaternion(q + 3, turn.data(), q + 3);
    } else {
      visit_joint(model, i, [&](auto joint) { joint.integrate(q, shift.data() + model.iv[i], q); });
    }
  }
}

// Richardson: values at s, s/2, s/4 .. whose errors are a series in s^2.
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
