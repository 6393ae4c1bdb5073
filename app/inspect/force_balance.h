// Free-body diagram: all wrenches on a body about one point; their sum is zero.
//
//   gravity + joint + joints of the children + applied + inertia = 0
// The wrench through joint i is f_i = IA_i a_i + pA_i of ABA. The inertia wrench is computed from
// Newton's and Euler's equations with 3-vectors, so the sum tests the passes.
#pragma once

#include "app/inspect/inspection.h"

namespace twinarm {

struct NamedWrench {
  std::string source;
  Vector3 force, torque;  // torque about the point of the viewpoint
};

// Axes and reference point in which wrenches are expressed. A wrench (f, n about O) is
// (f, n - r x f) about P = O + r.
struct Viewpoint {
  // Axes of the world, of each body's own link, or of one link.
  enum class Axes { world, own, body } axes = Axes::world;
  std::size_t axes_of = 0;
  // Each body's own origin or centre of mass, the origin of one link, or a point of the world.
  enum class About { own_origin, own_com, body, point } about = About::own_origin;
  std::size_t about_body = 0;
  Vector3 point = Vector3::Zero();

  // For wrenches on that body.
  Matrix3 R_WV(const Inspection& in, std::size_t body) const;
  Vector3 p_WV(const Inspection& in, std::size_t body) const;
  // Converts a wrench in world axes about the body's origin.
  NamedWrench see(const Inspection& in, std::size_t body, NamedWrench wrench) const;
};

// Coupling, contact, constraint, applied wrench or joint force, with its value on each body.
struct NamedForce {
  const AppliedForce* force;  // of Inspection::actors
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
  // Of a contact: normal and tangential force [N].
  struct Parts {
    double normal, friction;
  };
  std::optional<Parts> parts;
};
// In the order of Inspection::actors.
std::vector<NamedForce> named_forces(const Inspection& in, const Viewpoint& from);

struct BodyBalance {
  std::size_t body = 0;
  std::vector<NamedWrench> wrenches;  // "inertia" last
  double largest = 0;                 // max norm of all wrenches [N, N m]
  // Max norm of the sum, relative to `largest`, to the weight of the subtree, or to
  // gyroscopic_load(), whichever is largest.
  double residual = 0;
};

BodyBalance balance_of(const Inspection& in, std::size_t body, const Viewpoint& from = {});

// Forces along one degree of freedom: applied, rotor inertia, and -S^T f; their sum is zero.
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

// max |v x* I v| [N, N m]: terms of this size cancel within the inertia wrench of a rotating body,
// and set the scale of its rounding error.
double gyroscopic_load(const Inspection& in, std::size_t i);

// Joint's name; "base" for the joint of a root link without name.
std::string joint_label(const Inspection& in, std::size_t body);

// Wrench of the parent on body i through its joint: IA a + pA, body axes.
Force<double> joint_force(const Inspection& in, std::size_t i);

}  // namespace twinarm
