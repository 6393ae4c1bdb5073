// Free-body view: every wrench on a body, about one point, that sum to zero.
//
//   gravity + through its joint + through its children's joints + applied + inertia = 0
// The wrench through joint i is what ABA has of it, f_i = IA_i a_i + pA_i; inertia is Newton's and
// Euler's in three dimensions, from the acceleration of the centre of mass. So the sum is a test of
// the passes, and not zero by the way it is made.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/inspect/inspection.h"

namespace twinarm {

// From where wrenches are looked at: in whose axes, and about which point.
//
// A wrench (f, n about O) is about P = O + r the wrench (f, n - r x f). Any viewpoint shows the
// same balance; a point is well chosen where unknown forces pass through it.
struct NamedWrench {
  std::string source;
  Vector3 force, torque;  // the torque is about the viewpoint's point
};

struct Viewpoint {
  // Axes of the world, of each body's own link, or of one link.
  enum class Axes { world, own, body } axes = Axes::world;
  std::size_t axes_of = 0;
  // Each body's own origin or centre of mass, the origin of one link, or a point of the world.
  enum class About { own_origin, own_com, body, point } about = About::own_origin;
  std::size_t about_body = 0;
  Vector3 point = Vector3::Zero();

  // Of what acts on a body.
  Matrix3 R_WV(const Inspection& in, std::size_t body) const;
  Vector3 p_WV(const Inspection& in, std::size_t body) const;
  // A wrench in world axes about the body's origin, as it is seen from here.
  NamedWrench see(const Inspection& in, std::size_t body, NamedWrench wrench) const;
};

// A force that stands under a name of its own: coupling, contact, constraint, applied wrench.
struct NamedForce {
  std::string source;
  struct End {
    std::size_t body;
    NamedWrench wrench;  // on it
    Vector3 about;       // world
  };
  std::vector<End> ends;  // bodies that move
  struct OnJoint {
    std::size_t body, dof;  // velocity index
    double value;           // [N m, N]
  };
  std::vector<OnJoint> joints;
  std::optional<Vector3> point;   // where it acts, world
  std::optional<Vector3> normal;  // of a contact, towards its second body, world
  // Of a contact: how hard it presses, and its part in the plane [N].
  struct Parts {
    double normal, friction;
  };
  std::optional<Parts> parts;
  bool is_tie = false;  // as in Actor
};
// In the order of the list of actors.
std::vector<NamedForce> named_forces(const Inspection& in, const Viewpoint& from);

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
