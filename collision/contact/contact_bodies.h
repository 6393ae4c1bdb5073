// What can touch: geometries on the bodies of a model, their surfaces and the rules of pairs; and
// where a contact acts on two of them.
#pragma once

#include <vector>

#include "collision/contact/contact_point.h"
#include "solver/dynamics/kinematics.h"
#include "solver/model/model.h"

namespace twinarm {

class ContactBodies {
 public:
  explicit ContactBodies(const Model<double>& model);

  // Returns its id. Throws InputError for bad numbers.
  int add(const ContactGeometry& geometry);
  // In place of what their surfaces give; the last one counts.
  void set_pair(int a, int b, const ContactMaterialPair& law);
  ContactMaterialPair law_of(int a, int b) const;

  CollisionWorld& world() { return world_; }
  const ContactGeometry& geometry(int id) const {
    return geometries_[static_cast<std::size_t>(id)];
  }
  std::size_t size() const { return geometries_.size(); }
  // Whether forces or impulses move either of the two that touch.
  bool moves(const Contact& c) const { return geometry(c.a).body != 0 || geometry(c.b).body != 0; }
  // How far the geometry gets in a step, wherever it turns [m].
  double way(std::size_t geometry, const Kinematics& k, double h) const;

  // Where forces act on the body (a's or b's): midway between the surfaces, so that both have them
  // in one point; but against something that does not move on the body's own surface, for that is
  // where it will touch. (Where events are located also below it by a hair, so that the motion is
  // smooth.)
  Vector3 point_on(const Contact& contact, int body) const;
  // Velocity of b's point against a's.
  Vector3 approach(const Contact& contact, const Kinematics& k) const;
  // Of an impulse on b, about the world's origin: where the constraint's rows have it act, on what
  // moves where the other does not.
  Vector3 moment_of(const Contact& contact, const Vector3& impulse_W) const;

  bool locates = false;  // steps locate their events

 private:
  struct PairOverride {
    int a, b;
    ContactMaterialPair law;
  };
  bool is_immovable(int body) const { return is_immovable_[static_cast<std::size_t>(body)]; }

  const Model<double>* model_;
  std::vector<char> is_immovable_;  // by body: neither forces nor impulses move it
  CollisionWorld world_;
  std::vector<ContactGeometry> geometries_;
  std::vector<double> radius_;  // by geometry: of a ball about its link's origin [m]
  std::vector<PairOverride> rules_;
};

}  // namespace twinarm
