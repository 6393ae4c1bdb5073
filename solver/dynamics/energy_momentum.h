// Energy of a mechanism, and what something does to all bodies together: joules, and momentum about
// the world's origin. The rows of the ledgers are made of it.
//
// energy_and_momentum_of() is what the bodies have: kinetic energy and potential of gravity, and
// the linear and angular momentum of all that forces can move (a body of prescribed motion has any
// momentum that its law says). Between two states its difference is the sum of all exchanges but
// gravity's work, which is in it already. O(n), allocates nothing.
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
  // A force (or an impulse) at p, and a couple, for `part` (a time, or 1).
  void add_wrench(double part, const Vector3& p, const Vector3& force, const Vector3& couple) {
    impulse += part * force;
    moment += part * (p.cross(force) + couple);
  }
  void serialize(StateArchive& memory) {
    memory.visit(work);
    memory.visit(impulse);
    memory.visit(moment);
  }
};
inline EnergyMomentum operator*(double part, const EnergyMomentum& e) {
  return {part * e.work, part * e.impulse, part * e.moment};
}
inline EnergyMomentum operator-(EnergyMomentum a, const EnergyMomentum& b) {
  return a += -1.0 * b;
}

// By body: whether forces can move it.
std::vector<char> bodies_with_dofs(const Model<double>& model);

// `of` as bodies_with_dofs(), or of a part of them; w is written.
EnergyMomentum energy_and_momentum_of(const Model<double>& model, const std::vector<char>& of,
                                      const State<double>& x, Workspace<double>& w);

// Of those who have no workspace at hand (world_kinematics.h): allocates, in O(n).
double kinetic_energy(const Model<double>& model, const State<double>& x);  // with rotors [J]
// In the field of gravity, 0 at the world's origin [J].
double potential_energy(const Model<double>& model, const State<double>& x);

}  // namespace twinarm
