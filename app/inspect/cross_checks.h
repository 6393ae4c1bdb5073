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

#include <functional>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"

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

}  // namespace twinarm
