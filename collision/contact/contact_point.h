// Contacts as plain data: what can touch, with which surfaces; a point of contact; its work.
#pragma once

#include <string>

#include "collision/detection/collision_world.h"
#include "solver/spatial/pose.h"

namespace twinarm {

enum class ContactResponse { rigid, compliant };

struct ContactSurface {
  double friction = 0.5;   // a pair takes the geometric mean
  double restitution = 0;  // a pair takes the product
  double torsional = 0;    // radius of the patch that resists a turn about the normal [m]
  double rolling = 0;      // arm of the normal force when it rolls [m]
  double stiffness = 1e6;  // compliant: of one contact point; a pair: in_series [N/m]
  double dissipation = 1;  // compliant: c [s/m]
};

struct Compliance {
  double stiffness;    // [N/m]
  double dissipation;  // [s/m]
};
// Two springs between one force: 1/k = 1/ka + 1/kb. Each gives way by its share k/ka, k/kb of the
// depth, and so of its rate: c = ca k/ka + cb k/kb. The softer one says more.
inline Compliance in_series(const Compliance& a, const Compliance& b) {
  const double k = 1 / (1 / a.stiffness + 1 / b.stiffness);
  return {k, a.dissipation * (k / a.stiffness) + b.dissipation * (k / b.stiffness)};
}

// What holds between two geometries.
struct ContactMaterialPair {
  double friction, restitution;
  Compliance compliance;
};

struct ContactGeometry {
  std::string name;  // for messages and readings
  int body = 0;      // of the model; 0: fixed in the world
  Pose X_LG;         // in the axes of its link
  Shape shape;
  ContactSurface surface;
  int group = 0;  // CollisionWorld::set_group_filter
};

// One contact point of the last step.
struct ContactPoint {
  Contact contact;  // at the start of the step
  double friction = 0, restitution = 0;
  Compliance compliance{};
  Vector3 impulse_W = Vector3::Zero();   // on b, over the step, impacts included [N s]
  Vector3 force_W = Vector3::Zero();     // on b, without impacts [N]
  Vector3 couple_W = Vector3::Zero();    // on b: torsional and rolling friction [N m]
  Vector3 anchor_W = Vector3::Zero();    // compliant: how far the bristles are bent [m]
  Vector3 velocity_W = Vector3::Zero();  // of b against a, at the end of the step [m/s]
  bool is_held = false, opens = false;   // event_source.h
  Vector3 slip_W = Vector3::Zero();      // of what is held: at the start of the piece [m/s]
  // Within a step:
  bool has_closing_contact = false;  // takes part in the first phase, with its restitution
  double gap_after = 0;              // as the second phase leaves it [m]
};

// Of all points of two geometries, on what they belong to.
struct ContactWork {
  int a, b;
  double normal = 0, friction = 0, impact = 0;  // [J]
  Vector3 impulse_W = Vector3::Zero();          // on b [N s]
  Vector3 moment_W = Vector3::Zero();           // on b, about the world's origin [N m s]
};

// The normal and two directions across it, as columns.
inline Matrix3 contact_axes(const Vector3& n) {
  Matrix3 axes;
  axes.col(0) = n;
  axes.col(1) = n.unitOrthogonal();
  axes.col(2) = n.cross(axes.col(1));
  return axes;
}

}  // namespace twinarm
