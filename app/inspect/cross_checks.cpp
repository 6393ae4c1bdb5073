#include "app/inspect/cross_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/inspect/force_balance.h"

namespace twinarm {
namespace {

// A NaN is no small error.
double as_error(double error) {
  return std::isfinite(error) ? error : std::numeric_limits<double>::max();
}

Check worst_of(const Inspection& in, const char* name, const char* meaning, const Errors& errors,
               double tolerance) {
  Check check{name, meaning, 0, tolerance, ""};
  for (std::size_t i = 1; i < errors.size(); ++i)
    if (const double error = as_error(errors[i]); error > check.error) {
      check.error = error;
      check.worst = in.model.body_name[i];
    }
  return check;
}

}  // namespace

Errors balance_errors(const Inspection& in) {
  Errors errors(in.body_count());
  for (std::size_t i = 1; i < in.body_count(); ++i) errors[i] = balance_of(in, i).residual;
  for (const JointBalance& joint : joint_balances(in))
    errors[joint.body] = std::max(errors[joint.body], as_error(joint.residual));
  return errors;
}

std::vector<Check> run_checks(const Inspection& in, const CheckTolerances& tolerances) {
  const SubtreeErrors subtree = subtree_errors(in);
  const WholeErrors whole = whole_errors(in);
  std::vector<Check> checks;
  const auto add = [&](const char* name, const char* meaning, const Errors& errors,
                       double tolerance) {
    checks.push_back(worst_of(in, name, meaning, errors, tolerance));
  };
  const double algebra = tolerances.algebra;
  add("v", "rate of the poses, by dual numbers", velocity_errors(in), algebra);
  add("D", "mass matrix: ancestors locked, descendants free", subtree.D, algebra);
  add("U", "wrench of a unit acceleration then (CRBA, RNEA)", subtree.U, algebra);
  add("pA", "wrench where the body does not accelerate (CRBA, RNEA)", subtree.pA, algebra);
  add("u", "force left at the joint then (CRBA, RNEA)", subtree.u, algebra);
  add("qdd", "M qdd + h = tau (CRBA, RNEA)", whole.qdd, algebra);
  add("a", "accelerations by RNEA with the qdd found", whole.a, algebra);
  add("tau", "torques back from RNEA with the qdd found", whole.tau, algebra);
  add("f", "wrenches through joints: IA a + pA, RNEA", whole.f, algebra);
  add("balance", "wrenches on each body sum to zero", balance_errors(in), algebra);
  add("momentum", "rate of each body's momentum, by differences", momentum_errors(in),
      tolerances.momentum);
  const std::vector<NamedError> loops = loop_errors(in);
  if (loops.empty()) return checks;
  Check closed{"loops", "they stay closed: g'' = 0, by differences of poses", 0, tolerances.loops,
               ""};
  for (const auto& [name, error] : loops)
    if (as_error(error) > closed.error) closed.error = as_error(error), closed.worst = name;
  checks.push_back(std::move(closed));
  return checks;
}

}  // namespace twinarm
