// Work, impulse and angular impulse: a row of the energy and momentum balance.
//
// energy_and_momentum_of(): kinetic energy, potential energy of gravity, and linear and angular
// momentum of the bodies that forces can move (the momentum of prescribed bodies is given). Its
// difference between two states is the sum of all rows except the work of gravity, which is
// contained in the potential energy. O(n), allocates nothing.
#pragma once

#include <vector>

#include "solver/model/model.h"
#include "solver/model/workspace.h"
#include "solver/spatial/pose.h"
#include "solver/support/state_archive.h"

namespace twinarm {

struct EnergyMomentum {
  double work = 0;                    // [J]
  Vector3 impulse = Vector3::Zero();  // [N s]
  Vector3 moment = Vector3::Zero();   // about the world's origin [N m s]

  EnergyMomentum& operator+=(const EnergyMomentum& other) {
    work += other.work;
    impulse += other.impulse;
    moment += other.moment;
    return *this;
  }
  // A force at p and a couple during `duration` [s]; of impulses, duration = 1.
  void add_wrench(double duration, const Vector3& p, const Vector3& force, const Vector3& couple) {
    impulse += duration * force;
    moment += duration * (p.cross(force) + couple);
  }
  void serialize(StateArchive& archive) { archive.visit(work, impulse, moment); }
};
inline EnergyMomentum operator*(double s, const EnergyMomentum& e) {
  return {s * e.work, s * e.impulse, s * e.moment};
}
inline EnergyMomentum operator-(EnergyMomentum a, const EnergyMomentum& b) {
  return a += -1.0 * b;
}

// By body: whether it or an ancestor has a degree of freedom.
std::vector<char> bodies_with_dofs(const Model<double>& model);

// Of the bodies with of[i] != 0, e.g. bodies_with_dofs(); writes w.
EnergyMomentum energy_and_momentum_of(const Model<double>& model, const std::vector<char>& of,
                                      const State<double>& x, Workspace<double>& w);

// Without a workspace (see world_kinematics.h). Allocate, O(n).
double kinetic_energy(const Model<double>& model, const State<double>& x);  // with rotors [J]
// Potential energy of gravity, 0 at the world's origin [J].
double potential_energy(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
