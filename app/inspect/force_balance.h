// Free-body view: every wrench on a body, about one point, that sum to zero.
//
//   gravity + through its joint + through its children's joints + applied + inertia = 0
// The wrench through joint i is what ABA has of it, f_i = IA_i a_i + pA_i; inertia is Newton's and
// Euler's in three dimensions, from the acceleration of the centre of mass. So the sum is a test of
// the passes, and not zero by the way it is made.
#pragma once

#include <string>
#include <vector>

#include "app/inspect/viewpoint.h"

namespace twinarm {

struct BodyBalance {
  std::size_t body = 0;
  std::vector<NamedWrench> wrenches;  // "inertia" last
  double largest = 0;                 // of all numbers [N, N m]
  // The largest number of the sum, as a part of `largest`; of what falls or turns freely, as a
  // part of the weight that hangs on the body, or of turning_load().
  double residual = 0;
};

BodyBalance balance_of(const Inspection& in, std::size_t body, const Viewpoint& from = {});

// At one degree of freedom of a joint: what pulls at it, the rotor's inertia, and what it hands on
// to the body, S^T f with the sign that makes the sum zero.
struct JointBalance {
  std::size_t body = 0, dof = 0;
  struct Torque {
    std::string source;
    double value;  // [N m, N]
  };
  std::vector<Torque> torques;
  double largest = 0, residual = 0;
};
std::vector<JointBalance> joint_balances(const Inspection& in);

// Of the rates of momentum that a turning body has even where nothing pushes, |v x* I v| [N, N m]:
// they cancel within its inertia, and what is left is rounding of them.
double turning_load(const Inspection& in, std::size_t i);

// The wrench through joint i, as the parent exerts it: IA a + pA, body axes.
Force<double> joint_force(const Inspection& in, std::size_t i);

}  // namespace twinarm
