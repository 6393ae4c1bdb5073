// From where wrenches are looked at: in whose axes, and about which point.
//
// A wrench (f, n about O) is about P = O + r the wrench (f, n - r x f). Any viewpoint shows the
// same balance; a point is well chosen where unknown forces pass through it.
#pragma once

#include <optional>
#include <string>

#include "app/inspect/inspection.h"

namespace twinarm {

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

}  // namespace twinarm
