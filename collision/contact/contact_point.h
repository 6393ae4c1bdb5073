// Contacts as plain data: geometries and their surface parameters, contact points, work of
// contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "collision/detection/collision_world.h"
#include "solver/spatial/pose.h"

namespace twinarm {

enum class ContactResponse { rigid, compliant };

struct ContactSurface {
  double friction = 0.5;          // mu; of a pair: geometric mean
  double restitution = 0;         // e; of a pair: product
  double torsional_friction = 0;  // moment about the normal / normal force; of a pair: maximum [m]
  double rolling_friction = 0;    // likewise [m]
  double stiffness = 1e6;         // compliant: of one contact point; of a pair: in_series [N/m]
  double dissipation = 1;         // compliant: c [s/m]
};

struct Compliance {
  double stiffness;    // [N/m]
  double dissipation;  // [s/m]
};
// Two springs in series: 1/k = 1/ka + 1/kb. Their shares of the depth and of its rate are k/ka and
// k/kb, so c = ca k/ka + cb k/kb.
inline Compliance in_series(const Compliance& a, const Compliance& b) {
  const double k = 1 / (1 / a.stiffness + 1 / b.stiffness);
  return {k, a.dissipation * (k / a.stiffness) + b.dissipation * (k / b.stiffness)};
}

// Of a pair.
inline ContactSurface combined(const ContactSurface& a, const ContactSurface& b) {
  const Compliance soft = in_series({a.stiffness, a.dissipation}, {b.stiffness, b.dissipation});
  return {std::sqrt(a.friction * b.friction),
          a.restitution * b.restitution,
          std::max(a.torsional_friction, b.torsional_friction),
          std::max(a.rolling_friction, b.rolling_friction),
          soft.stiffness,
          soft.dissipation};
}

struct ContactGeometry {
  std::string name;
  int body = 0;  // of the model; 0: the world
  Pose X_LG;     // pose in its link
  Shape shape;
  ContactSurface surface;
  int group = 0;  // as Geometry::group
};

// One contact point of the last step.
struct ContactPoint {
  Contact contact;  // at the start of the step
  double friction = 0, restitution = 0;
  Compliance compliance{};
  Vector3 impulse_W = Vector3::Zero();          // on b, over the step, with impacts [N s]
  Vector3 force_W = Vector3::Zero();            // on b, without impacts [N]
  Vector3 couple_W = Vector3::Zero();           // on b: torsional and rolling friction [N m]
  Vector3 anchor_W = Vector3::Zero();           // compliant: bristle deflection [m]
  Vector3 velocity_W = Vector3::Zero();         // of b relative to a, at the end of the step [m/s]
  bool is_held = false, is_separating = false;  // event_source.h
  bool sticks = false;  // within a segment: held without slip, as a bilateral constraint
  Vector3 slip_W = Vector3::Zero();  // if held: sliding velocity at the start of the segment [m/s]
  // Within a step:
  bool has_closing_contact = false;  // in the first phase: impact with restitution
  double gap_after = 0;              // after the second phase [m]
};

// Work and impulses of all contact points of a pair of geometries.
struct ContactWork {
  int a, b;
  double normal = 0, friction = 0, impact = 0;  // [J]
  Vector3 impulse_W = Vector3::Zero();          // on b [N s]
  Vector3 moment_W = Vector3::Zero();           // on b, about the world's origin [N m s]
};

// Contact frame as columns: normal and two tangents.
inline Matrix3 contact_axes(const Vector3& n) {
  Matrix3 axes;
  axes.col(0) = n;
  axes.col(1) = n.unitOrthogonal();
  axes.col(2) = n.cross(axes.col(1));
  return axes;
}

}  // namespace twinarm
