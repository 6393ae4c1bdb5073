// Contact points of a step, detected with a speculative margin; forces and bristle states of
// persistent points are carried over from the step before.
#pragma once

#include <span>
#include <vector>

#include "collision/contact/contact_bodies.h"
#include "solver/support/state_archive.h"

namespace twinarm {

class ContactManifolds {
 public:
  explicit ContactManifolds(ContactBodies& bodies) : bodies_(bodies) {
    points.reserve(256);  // a step does not allocate
  }

  void begin_step(const Kinematics& k, double h) noexcept;
  // Repeats detection where a body moves farther than its margin; existing points keep their
  // states. False if there is no new point.
  bool extend_detection(const Kinematics& k, double h) noexcept;
  void serialize(StateArchive& memory);

  std::vector<ContactPoint> points;  // sorted by (a, b, feature)

 private:
  double speculative_margin(std::size_t geometry, const Kinematics& k, double h) const;
  void start_points();
  // `last`: points of the last step, those of the contact's pair first.
  ContactPoint start(const Contact& contact, const ContactSurface& surface,
                     std::span<const ContactPoint> last) const;
  static const ContactPoint* last_of(const Contact& contact, std::span<const ContactPoint> last);

  ContactBodies& bodies_;
  std::vector<Pose> X_WG_;
  std::vector<double> margins_;  // by geometry [m]
  std::vector<Contact> contacts_;
  std::vector<ContactPoint> last_;
};

}  // namespace twinarm
