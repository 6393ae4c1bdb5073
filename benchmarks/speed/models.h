// The mechanisms that are timed, described in plain numbers: no engine's types, so that every
// engine gets the same ones and converts them itself.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace twinarm::speed {

using Numbers3 = std::array<double, 3>;
using Numbers9 = std::array<double, 9>;  // a 3x3 matrix, row by row

inline constexpr double standard_gravity = 9.81;  // [m/s^2], along -z of the world

// A rigid link on a revolute joint, or, where the mechanism floats and it is the first, a free one.
struct Link {
  int parent;         // index of another link, before this one; -1: the world
  std::size_t axis;   // the joint turns about x (0), y (1) or z (2) of the link
  Numbers3 position;  // of the link's origin in the parent at q = 0 [m]
  Numbers9 rotation;  // link axes to parent axes at q = 0
  double mass;        // [kg]
  Numbers3 com;       // in link axes, from the link's origin [m]
  Numbers9 inertia;   // about the com, link axes [kg m^2]
};

struct Mechanism {
  std::string name;
  std::vector<Link> links;
  bool floating = false;  // link 0 is free

  std::size_t first_joint() const { return floating ? 1 : 0; }  // the first link on a revolute
  std::size_t joints() const { return links.size() - first_joint(); }
  std::size_t nq() const { return joints() + (floating ? 7 : 0); }
  std::size_t nv() const { return joints() + (floating ? 6 : 0); }
};

Mechanism scara3();
Mechanism puma6();       // masses and lengths of the size of a PUMA 560's
Mechanism chain(int n);  // n links with full inertia tensors, axes x, y, z in turn
Mechanism humanoid30();  // 30 revolutes on a free base

// By name: "scara3", "puma6", "humanoid30", "chainN". Throws std::invalid_argument.
Mechanism mechanism(const std::string& name);

// A state and what acts in it. Of a floating mechanism the base comes first:
//   q    position of the base's origin in the world, its quaternion w, x, y, z; then the joints
//   v    velocity of that origin in the world, angular velocity in body axes; then the joints
//   tau  force at that origin in world axes, torque in body axes; then the joints
// Accelerations (qdd) are the time derivative of v; these ones are for inverse dynamics.
struct Situation {
  std::vector<double> q, v, tau, qdd;
};

// Seeded: every run and every engine gets the same ones.
std::vector<Situation> situations(const Mechanism& mechanism, std::size_t count);

}  // namespace twinarm::speed
