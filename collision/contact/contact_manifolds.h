// The contact points of a step: found as far ahead as bodies move within it, and what those that
// were there a step before remember.
#pragma once

#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class ContactManifolds {
 public:
  explicit ContactManifolds(ContactBodies& bodies);

  void begin_step(const Kinematics& k, double h) noexcept;
  // Looks again where something moves farther than it was looked for. Of points that were there
  // already, names and what they have carried so far stay. False if nothing new was found.
  bool extend_detection(const Kinematics& k, double h) noexcept;
  void serialize(StateArchive& memory);

  std::vector<ContactPoint> points;  // sorted by (a, b, feature)

 private:
  double reach(std::size_t geometry, const Kinematics& k, double h) const;
  ContactPoint start(const Contact& contact) const;
  const ContactPoint* last_of(const Contact& contact) const;

  ContactBodies& bodies_;
  std::vector<Pose> X_WG_;
  std::vector<double> reach_;  // by geometry [m]
  std::vector<Contact> contacts_;
  std::vector<ContactPoint> last_;
};

}  // namespace twinarm
