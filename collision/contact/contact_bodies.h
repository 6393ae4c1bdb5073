// Collision geometries on the bodies of a model, contact parameters of pairs, and the points at
// which contact forces act.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "collision/contact/contact_point.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"

namespace twinarm {

class ContactBodies {
 public:
  explicit ContactBodies(const Model<double>& model);

  // Returns its id. Throws InputError for invalid parameters.
  int add(const ContactGeometry& geometry);
  // Replaces the parameters combined from the two surfaces; the last call for a pair counts.
  void set_pair(int a, int b, const ContactSurface& pair) {
    overrides_.insert_or_assign(std::minmax(a, b), pair);
  }
  ContactSurface surface_of_pair(int a, int b) const {
    const auto given = overrides_.find({a, b});
    return given == overrides_.end() ? combined(geometry(a).surface, geometry(b).surface)
                                     : given->second;
  }

  CollisionWorld& world() { return world_; }
  const CollisionWorld& world() const { return world_; }
  const ContactGeometry& geometry(int id) const {
    return geometries_[static_cast<std::size_t>(id)];
  }
  std::size_t size() const { return geometries_.size(); }
  // Whether at least one of the two bodies is not the world.
  bool has_moving_body(const Contact& c) const {
    return geometry(c.a).body != 0 || geometry(c.b).body != 0;
  }
  // Upper bound of the displacement of any point of the geometry in a step of h [m].
  double max_displacement(std::size_t geometry, const Kinematics& k, double h) const {
    const auto body = static_cast<std::size_t>(geometries_[geometry].body);
    return h * (k.v_WLo[body].norm() + k.w_WL[body].norm() * radius_[geometry]);
  }

  // Point at which the contact force acts on the body (a's or b's): midway between the two
  // surfaces, so that action and reaction share it. Against an immovable body: on the moving body's
  // own surface, where it will touch. (In event-driven steps also for a slight penetration: the
  // motion is then smooth in time.)
  Vector3 application_point(const Contact& contact, int body) const;
  // Velocity of b's contact point relative to a's.
  Vector3 relative_velocity(const Contact& c, const Kinematics& k) const {
    const int a = geometry(c.a).body, b = geometry(c.b).body;
    return k.velocity(b, application_point(c, b)) - k.velocity(a, application_point(c, a));
  }
  // Moment of an impulse on b about the world's origin, with the application point of the moving
  // body.
  Vector3 impulse_moment(const Contact& c, const Vector3& impulse_W) const {
    const int a = geometry(c.a).body, b = geometry(c.b).body;
    return application_point(c, is_immovable(b) ? a : b).cross(impulse_W);
  }

  bool locates_events = false;  // set by event-driven steps

 private:
  bool is_immovable(int body) const { return is_immovable_[static_cast<std::size_t>(body)]; }

  const Model<double>* model_;
  std::vector<char> is_immovable_;  // by body: fixed to the world or prescribed
  CollisionWorld world_;
  std::vector<ContactGeometry> geometries_;
  std::vector<double> radius_;  // by geometry: bounding sphere about its link's origin [m]
  std::map<std::pair<int, int>, ContactSurface> overrides_;
};

}  // namespace twinarm
